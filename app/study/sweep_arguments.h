// Arguments of `gaitlab sweep`, and the study that they describe.
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

/// The study that the arguments describe: read from its file, or built from the options and then without a name. Throws
/// InputError with every problem found.
studies::Study wanted_study(const SweepArguments& arguments);
/// Shard of the study that this process simulates. Throws InputError for a bad --shard.
studies::Shard wanted_shard(const SweepArguments& arguments);
/// Command line that continues the study in a folder.
std::string goes_on(const SweepArguments& arguments, const std::filesystem::path& folder);

}  // namespace gaitlab::app
