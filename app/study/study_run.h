// Common part of the commands that run studies: execution of the runs, stopping, and continuation of an earlier study.
#pragma once
#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "app/shell/commands.h"
#include "app/shell/stop_on_signal.h"
#include "studies/run/answers.h"

namespace gaitlab::app {

/// Arguments of every command that executes runs of a study.
struct StudyRunArguments {
  std::optional<std::string> out;
  std::vector<std::string> answers;
  int jobs = 0, lanes = 0;
  bool accept_build = false;
};
void add_study_run(CLI::App& command, StudyRunArguments& arguments, const char* folder);

/// Adds the repeatable option --set of a command whose input is a study file.
void add_study_sets(CLI::App& command, std::vector<std::string>& sets);
/// Adds settings of the command line to those that a study applies to all runs. Throws InputError if one sets a parameter, or a
/// key that is computed from a parameter, because the study sets this key in every run.
void add_sets(studies::Study& study, const std::vector<std::string>& sets);
/// The options --set of a command line, with a space before each.
std::string set_words(const std::vector<std::string>& sets);
/// A path for a command line that a journal keeps. It contains no folder of this machine: it is the name of a shipped file, or
/// relative to the current folder.
std::string told_path(const std::string& path);

/// Function that returns an executor for a team of processes.
using Team =
    std::function<studies::Executor(const studies::Plan& plan, const BatchSettings& settings, studies::Measure measure)>;
/// Executor function of a program whose processes cooperate (gaitlab-mpi). Empty if this process works alone.
Team& team();

/// Executor of a study's runs. Every command calls this before it opens the study's folder, because only one process may own
/// the folder. Throws InputError if other processes of the team read another study.
studies::Executor study_executor(const studies::Plan& plan, const StudyRunArguments& arguments);

/// Head of the journal for this plan and this build of the program.
studies::JournalHead study_head(const studies::Plan& plan);

/// Journals given by --answers, whose runs are not simulated again. `build` is the build id of this program. Throws InputError
/// if a journal belongs to a different study.
std::vector<studies::Answers> other_answers(const studies::Plan& plan, const StudyRunArguments& arguments,
                                            const std::string& build);

/// Prints the number of runs of the plan and their duration, estimated by timing a few of them.
void print_plan(const studies::Plan& plan, const StudyRunArguments& arguments);

/// Prints the warnings on the scenarios of a plan before they run (report/verdict/warnings.h), each once, without the warnings
/// on the scenarios' own gaits.
void warn_of_scenarios(const studies::Plan& plan);

/// Prints the warnings on the scenarios, and notes on a plan: files that hide shipped scenarios, parameters whose slowest gait
/// does not fit into the duration, and parameter limits that the scenario refuses.
void print_notes(const studies::Plan& plan, bool quiet);

/// Prints the estimated time of all runs of a study if engine articulated is faster. `arguments` give the number of threads.
void note_engine(const studies::Plan& plan, const StudyRunArguments& arguments, bool quiet);

/// Builds of the program whose journal rows are accepted.
studies::Journal::Build taken_build(const StudyRunArguments& arguments);

/// Writes the heights of the scenarios' ground into the folder of a study, from which `study rerun` reads them, unless the
/// resolved scenario in its journal contains them.
void write_heights(const studies::Plan& plan, const std::filesystem::path& folder);

/// Raises the budget to the number of runs in the journal if the budget is smaller. Prints a note with the place `folder`
/// unless `quiet`.
void keep_runs(studies::Plan& plan, studies::Journal& journal, const std::filesystem::path& folder, bool quiet);

/// Throws InputError if mpirun or a scheduler started several independent copies of the program, which would write one journal;
/// processes of a team are allowed. `command` is for example `gaitlab sweep`.
void refuse_copies(const char* command);

/// Number of threads. If `jobs` (option -j) is 0, it is one per processor, or one in a team.
int study_threads(int jobs);

/// Predicate that is true for a folder with the study of this head.
std::function<bool(const std::filesystem::path&)> holds_study(const studies::JournalHead& head);

}  // namespace gaitlab::app
