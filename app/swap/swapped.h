// Runs of scenarios under several CPGs, as `gaitlab swap` compares them.
#pragma once
#include <optional>
#include <string>
#include <vector>

#include "app/shell/commands.h"
#include "core/recording/recording.h"
#include "report/verdict/verdict.h"

namespace gaitlab::app {

struct SwapArguments : ScenarioArguments {
  std::vector<std::string> files;  ///< scenario files; `file` is the one that is being read
  std::string cpgs;                ///< CPG types, separated by commas
  std::optional<std::string> out;  ///< folder for figures and numbers
  int jobs = 1;                    ///< threads
  bool report = false;             ///< also write a page for every run, and one page for all runs
};

/// A scenario under one CPG, with its run.
struct Swapped {
  std::string cpg;
  std::optional<Scenario> scenario = {};
  std::vector<Note> notes = {};
  Recording record = {};
  report::Summary summary = {};
  report::Verdict verdict = {};
};

/// The scenario `arguments.file` under each CPG, without runs. Errors of all CPGs are reported together. Throws InputError.
std::vector<Swapped> read_swapped(const SwapArguments& arguments, Catalog& catalog);

/// Each scenario of `arguments.files` under each CPG, without runs. Errors of all of them are reported together. Throws
/// InputError, also if two scenarios have the same name.
std::vector<std::vector<Swapped>> read_matrix(const SwapArguments& arguments, Catalog& catalog);

/// Runs all scenarios in `jobs` threads. Returns false if the program was stopped. Throws InputError for the first scenario
/// that is refused.
bool run_swapped(const std::vector<Swapped*>& all, int jobs, bool quiet);

}  // namespace gaitlab::app
