// What the commands that do the runs of studies share: who does the runs, how they are stopped, where they go on.
#pragma once
#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "app/commands.h"
#include "app/stop_on_signal.h"
#include "studies/run/answers.h"

namespace gaitlab::app {

/// What every command that does runs of a study takes.
struct StudyRunArguments {
  std::optional<std::string> out;
  std::vector<std::string> answers;
  int jobs = 0, lanes = 0;
  bool accept_build = false;
};
void add_study_run(CLI::App& command, StudyRunArguments& arguments, const char* folder);

/// Makes what does the runs, of what does them in this process.
using Team =
    std::function<studies::Executor(const studies::Plan& plan, const BatchSettings& settings, studies::Measure measure)>;
/// Set by a program whose processes work together (gaitlab-mpi); empty: this process works alone.
Team& team();

/// What does the runs of a study: every command asks here, before it touches the study's folder, which belongs to one process.
/// InputError: other processes of the team read another study.
studies::Executor study_executor(const studies::Plan& plan, const StudyRunArguments& arguments);

/// What a journal says of the plan, and of this program.
studies::JournalHead study_head(const studies::Plan& plan);

/// The journals of --answers. `build`: of this program. InputError: one does not answer this study.
std::vector<studies::Answers> other_answers(const studies::Plan& plan, const StudyRunArguments& arguments,
                                            const std::string& build);

/// Prints what of the plan would be run, and how long it takes: a few of its runs are timed.
void print_plan(const studies::Plan& plan, const StudyRunArguments& arguments);

/// Prints old names with the new ones, parameters whose slowest gait does not fit the duration, and ends of parameters that the
/// scenario refuses.
void print_notes(const studies::Plan& plan, bool quiet);

/// Which build's rows are taken.
studies::Journal::Build taken_build(const StudyRunArguments& arguments);

/// A budget never leaves out runs that the journal has: raises it to them, and says so in a note on `folder` unless `quiet`.
void keep_runs(studies::Plan& plan, studies::Journal& journal, const std::filesystem::path& folder, bool quiet);

/// Several copies of the program that do not know of one another, as mpirun starts them, would write one journal: InputError,
/// unless they are a team. `command`: `gaitlab sweep`.
void refuse_copies(const char* command);

/// Threads, of -j; 0: one per processor, in a team one.
int study_threads(int jobs);

/// Whether a folder holds the study of this head.
std::function<bool(const std::filesystem::path&)> holds_study(const studies::JournalHead& head);

}  // namespace gaitlab::app
