// The program: one function a subcommand, each returning the exit code (docs/conventions.md: 0 ok, 1 failed run, 2 bad input,
// 4 regression).
#pragma once
#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "core/plugin/catalog.h"
#include "core/scenario/scenario.h"

namespace gaitlab::app {

/// Everything built in, and what these libraries register.
Catalog standard_catalog(const std::vector<std::string>& plugins = {});

/// Module types or robots (`kind`: module, robot) that come with the program: name -> file.
std::map<std::string, std::string> shipped_files(const std::string& kind);

/// What every command that reads a scenario takes.
struct ScenarioArguments {
  std::string file;
  std::vector<std::string> sets;
  std::optional<std::string> seed;
  bool quiet = false;
};

/// Reads it with --set and --seed applied; prints its notes on stderr unless quiet.
Scenario read(const ScenarioArguments& arguments, Catalog& catalog);
/// Prints on stderr that part of the robot starts below the ground, where it does.
void warn_of_start(const Scenario& scenario);

struct RunArguments : ScenarioArguments {
  std::optional<std::string> out;
  std::string format = "h5";
};
int run(const RunArguments& arguments);
/// The same for a scenario that is already read.
int run(const Scenario& scenario, const RunArguments& arguments);
int check(const ScenarioArguments& arguments);
struct ManualArguments {
  std::string kind, name;            ///< empty: all kinds; the scenario file
  std::vector<std::string> plugins;  ///< libraries to load first
};
int list(const ManualArguments& arguments);
int explain(const ManualArguments& arguments);
/// The JSON Schema of scenario files.
int schema(const ManualArguments& arguments);
/// A page of docs/reference: `kind` is scenario or plugins.
int reference(const ManualArguments& arguments);

struct ConvergeArguments : ScenarioArguments {
  int halvings = 2;
  std::vector<std::string> columns;  ///< patterns; none: the torques, or without motors the angles
  int jobs = 1;                      ///< threads
};
int converge(const ConvergeArguments& arguments);

struct SwapArguments : ScenarioArguments {
  std::string cpgs;                ///< types, with commas between
  std::optional<std::string> out;  ///< folder of the figure
  int jobs = 1;                    ///< threads
};
int swap_cpgs(const SwapArguments& arguments);

struct DynamicsArguments : ScenarioArguments {
  std::string state;     ///< JSON file
  bool inverse = false;  ///< torques and reactions of given accelerations
};
int dynamics(const DynamicsArguments& arguments);

struct CompareArguments {
  std::string a, b;                  ///< run folders or trace files
  std::vector<std::string> columns;  ///< patterns; none: all
};
int compare(const CompareArguments& arguments);

struct ExportArguments {
  ScenarioArguments source;  ///< file: run folder or trace file (csv), scenario (mjcf, urdf)
  std::string format;        ///< csv, mjcf, urdf
  std::string file;          ///< to write; must not exist
};
int export_to(const ExportArguments& arguments);

struct RerunArguments {
  std::string run;                 ///< run folder, or trace.h5
  bool verify = false;             ///< compare with the recorded trace instead of writing
  std::optional<std::string> out;  ///< as for run
  bool quiet = false;
};
int rerun(const RerunArguments& arguments);

struct ApproveArguments {
  std::string file;
  std::optional<std::string> reason;
  bool calibrate = false;  ///< make new bands; without a golden, and for a run that has left its bands, they are made anyway
  bool replace = false;    ///< begin a new history, whatever golden is there
  int jobs = 1;            ///< threads
};
int approve(const ApproveArguments& arguments);

struct TestArguments {
  std::vector<std::string> scenarios;     ///< files and folders; none: `scenarios`
  std::optional<std::string> golden;      ///< folder: of another scenario than the one that is run
  std::optional<std::string> engine;      ///< instead of the scenario's, with its own step and integrator
  std::optional<std::string> junit, out;  ///< file; folder for figures
  bool strict = false;                    ///< in a folder, too, every scenario must have a golden
  int jobs = 1;                           ///< threads
};
int test_goldens(const TestArguments& arguments);

struct NewPluginArguments {
  std::string kind, name;          ///< cpg, controller or actuator; what the scenario will call it
  std::optional<std::string> out;  ///< folder to make (default: the name)
};
int new_plugin(const NewPluginArguments& arguments);

/// `version, build id, Bullet version and precision`
std::string version();

}  // namespace gaitlab::app
