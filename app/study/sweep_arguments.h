// The command line of `gaitlab sweep`, and the study that it describes.
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

/// The study: from its file, or from the options (then without a name). Throws InputError with every problem found.
studies::Study wanted_study(const SweepArguments& arguments);
/// Shard of the study for this process. Throws InputError.
studies::Shard wanted_shard(const SweepArguments& arguments);
/// Command that continues the study in a folder.
std::string goes_on(const SweepArguments& arguments, const std::filesystem::path& folder);

}  // namespace gaitlab::app
