// The program: one function a subcommand, each returning the exit code (docs/conventions: 0 ok, 1 failed run, 2 bad input,
// 3 gait infeasible, 4 regression).
#pragma once
#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "core/plugin/catalog.h"
#include "core/scenario/scenario.h"

namespace gaitlab::app {

/// Everything built in.
Catalog standard_catalog();

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

struct RunArguments : ScenarioArguments {
  std::optional<std::string> out;
  std::string format = "csv";
};
int run(const RunArguments& arguments);
int check(const ScenarioArguments& arguments);
int list(const std::string& kind);
int explain(const std::string& kind, const std::string& name);
int converge(const ScenarioArguments& arguments, int halvings);

/// `version, build id, Bullet version and precision`
std::string version();

}  // namespace gaitlab::app
