// The command line of `gaitlab sweep`, and what it asks for.
#pragma once
#include <filesystem>
#include <string>
#include <vector>

#include "app/study/study_run.h"
#include "studies/journal/study_folder.h"
#include "studies/study/study.h"

namespace gaitlab::app {

struct SweepArguments : ScenarioArguments, StudyRunArguments {
  std::vector<std::string> grids, randoms, quantities;
  std::int64_t runs = 0, replicates = 0;
  bool sobol = false;
  std::string shard;
  bool dry_run = false;
};

/// The study: of its file, or as the options describe it (then without a name). InputError with every problem found.
studies::Study wanted_study(const SweepArguments& arguments);
/// What of it this process runs. InputError.
studies::Shard wanted_shard(const SweepArguments& arguments);
/// The command that goes on with it in a folder.
std::string goes_on(const SweepArguments& arguments, const std::filesystem::path& folder);

}  // namespace gaitlab::app
