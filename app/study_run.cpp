#include "app/study_run.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstdlib>
#include <thread>

#include "core/scenario/wording.h"

namespace gaitlab::app {

void add_study_run(CLI::App& command, StudyRunArguments& a, const char* folder) {
  command.add_option("--out", a.out, std::string("folder of the study (default ") + folder + "); one that holds it goes on");
  command.add_option("-j,--jobs", a.jobs, "threads (default: one per processor)")->check(CLI::Range(1, 1024));
  command.add_option("--lanes", a.lanes, "runs side by side in a thread (default: what engine and processor allow)")
      ->check(CLI::Range(1, 64));
  command.add_flag("--accept-build", a.accept_build, "go on with a study that another build of the program began");
}

Team& team() {
  static Team made;
  return made;
}

studies::Executor study_executor(const studies::Plan& plan, const BatchSettings& settings, studies::Measure measure) {
  return team() ? team()(plan, settings, std::move(measure)) : local_executor(plan, settings, std::move(measure));
}

void refuse_copies(const char* command) {
  if (team()) return;
  for (const char* name : {"OMPI_COMM_WORLD_SIZE", "PMI_SIZE", "SLURM_STEP_NUM_TASKS"}) {
    const char* text = std::getenv(name);
    if (text != nullptr && std::strtoll(text, nullptr, 10) > 1)
      throw InputError(
          SourceLocation{command},
          fmt::format("was started {} times side by side ({}); expected once, as gaitlab-mpi under mpirun, or once "
                      "per shard with sweep --shard",
                      clipped(text), name));
  }
}

int study_threads(int jobs) {
  if (jobs > 0) return jobs;
  return team() ? 1 : std::max(1, static_cast<int>(std::thread::hardware_concurrency()));
}

std::function<bool(const std::filesystem::path&)> holds_study(const studies::JournalHead& head) {
  return [&head](const std::filesystem::path& folder) {
    try {
      const studies::Journal there(folder / studies::kJournalFile);
      return there.head().definition == head.definition && there.head().scenario == head.scenario;
    } catch (const InputError&) {
      return false;
    }
  };
}

}  // namespace gaitlab::app
