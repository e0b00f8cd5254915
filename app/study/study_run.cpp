#include "app/study/study_run.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstdlib>
#include <thread>

#include "app/study/study_quantities.h"
#include "core/build_id.h"
#include "core/errors.h"
#include "core/files/atomic_file.h"
#include "core/scenario/height_file.h"
#include "core/settings/shell_word.h"
#include "core/settings/shipped_files.h"
#include "core/settings/wording.h"
#include "core/simulation/batch_limits.h"
#include "studies/plan/definition.h"

namespace gaitlab::app {

void add_study_run(CLI::App& command, StudyRunArguments& a, const char* folder) {
  command.add_option("--out", a.out, std::string("folder of the study (default ") + folder + "); an existing one is continued");
  command
      .add_option("--answers", a.answers, "study.db of another study: runs that it contains are not run again; may be repeated")
      ->expected(1)
      ->allow_extra_args(false)
      ->multi_option_policy(CLI::MultiOptionPolicy::TakeAll);
  command.add_option("-j,--jobs", a.jobs, "threads (default: one per processor)")->check(CLI::Range(1, kMostThreads));
  command.add_option("--lanes", a.lanes, "runs side by side in a thread (default: what engine and processor allow)")
      ->check(CLI::Range(1, kMostLanesAsked));
  command.add_flag("--accept-build", a.accept_build, "continue a study that another build of the program began");
}

void add_study_sets(CLI::App& command, std::vector<std::string>& sets) {
  offering(command.add_option("--set", sets),
           "override a key of the scenario in all runs, as {}, after those of the study; may be repeated", {.settings = true})
      ->expected(1)
      ->allow_extra_args(false)
      ->multi_option_policy(CLI::MultiOptionPolicy::TakeAll);
}

void add_sets(studies::Study& study, const std::vector<std::string>& sets) {
  Problems problems;
  for (const std::string& set : sets) {
    const std::string key = set.substr(0, set.find('='));
    for (const studies::Parameter& p : study.parameters) {
      const bool follows = std::ranges::find(p.sets, key, &studies::Follower::key) != p.sets.end();
      if (p.key != key && !follows) continue;
      problems.add(SourceLocation{"--set " + clipped(set)},
                   fmt::format("{} {} of the study, which sets it in every run; expected another key, or a study without "
                               "this parameter",
                               clipped(key), follows ? "is computed from the parameter " + clipped(p.key) : "is a parameter"));
    }
  }
  problems.raise();
  study.sets.insert(study.sets.end(), sets.begin(), sets.end());
}

std::string set_words(const std::vector<std::string>& sets) {
  std::string words;
  for (const std::string& set : sets) words += " --set " + shell_word(set);
  return words;
}

std::string told_path(const std::string& path) {
  const std::filesystem::path file = path;
  for (const char* kind : {"study", "scenario"}) {
    const std::map<std::string, std::string> shipped = shipped_files(kind);
    const auto named = shipped.find(file.stem().string());
    if (named != shipped.end() && named->second == path) return named->first;
  }
  if (!file.is_absolute()) return path;
  std::error_code failure;
  const std::filesystem::path here = std::filesystem::proximate(file, failure);
  return failure ? path : here.string();
}

Team& team() {
  static Team made;
  return made;
}

studies::Executor study_executor(const studies::Plan& plan, const StudyRunArguments& a) {
  const BatchSettings settings{study_threads(a.jobs), static_cast<std::size_t>(a.lanes)};
  studies::Measure measure = quantity_measure(plan.columns(), plan.scenario());
  return team() ? team()(plan, settings, std::move(measure)) : local_executor(plan, settings, std::move(measure));
}

studies::JournalHead study_head(const studies::Plan& plan) {
  studies::JournalHead head = studies::journal_head(plan);
  head.build = build_id();
  return head;
}

studies::Journal::Build taken_build(const StudyRunArguments& a) {
  return a.accept_build ? studies::Journal::Build::any : studies::Journal::Build::same;
}

std::vector<studies::Answers> other_answers(const studies::Plan& plan, const StudyRunArguments& a, const std::string& build) {
  std::vector<studies::Answers> answers;
  for (const std::string& other : a.answers) answers.emplace_back(plan, other, build, taken_build(a));
  return answers;
}

void write_heights(const studies::Plan& plan, const std::filesystem::path& folder) {
  for (const studies::StudyScenario& one : plan.scenarios()) {
    const Heightfield* relief = one.nominal.ground.relief();
    if (!needs_height_file(relief)) continue;
    const std::filesystem::path file = folder / heights_name(*relief);
    std::error_code none;
    // An existing file has the same content, because the name contains a hash of it.
    if (!std::filesystem::exists(file, none)) write_file(file, packed_heights(*relief));
  }
}

void keep_runs(studies::Plan& plan, studies::Journal& journal, const std::filesystem::path& folder, bool quiet) {
  const std::uint64_t there = journal.end();
  const std::uint64_t wanted = plan.most_runs();
  if (there <= wanted || !plan.raise_budget(there)) return;
  journal.expect(plan.most_runs());
  if (!quiet) {
    say(folder.string(), "note",
        fmt::format("has runs up to number {}, beyond the budget of {}; all of them count", there - 1, wanted));
  }
}

void refuse_copies(const char* command) {
  if (team()) return;
  for (const char* name : {"OMPI_COMM_WORLD_SIZE", "PMI_SIZE", "SLURM_STEP_NUM_TASKS"}) {
    const char* text = std::getenv(name);
    if (text != nullptr && std::strtoll(text, nullptr, 10) > 1) {
      throw InputError(
          SourceLocation{command},
          fmt::format("was started {} times side by side ({}); expected once, as gaitlab-mpi under mpirun, or once "
                      "per shard with sweep --shard",
                      clipped(text), name));
    }
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
