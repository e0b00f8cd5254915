// Common part of the commands that run studies: the executor of the runs, stopping, continuing an earlier study.
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

/// Arguments of every command that does runs of a study.
struct StudyRunArguments {
  std::optional<std::string> out;
  std::vector<std::string> answers;
  int jobs = 0, lanes = 0;
  bool accept_build = false;
};
void add_study_run(CLI::App& command, StudyRunArguments& arguments, const char* folder);

/// Makes the executor of a team from that of this process.
using Team =
    std::function<studies::Executor(const studies::Plan& plan, const BatchSettings& settings, studies::Measure measure)>;
/// Set by a program whose processes cooperate (gaitlab-mpi); empty: this process works alone.
Team& team();

/// Executor of a study's runs: every command calls this before it opens the study's folder, which belongs to one process.
/// Throws InputError if other processes of the team read another study.
studies::Executor study_executor(const studies::Plan& plan, const StudyRunArguments& arguments);

/// Head of a journal for the plan and this program.
studies::JournalHead study_head(const studies::Plan& plan);

/// The journals of --answers. `build`: of this program. Throws InputError if one cannot answer this study.
std::vector<studies::Answers> other_answers(const studies::Plan& plan, const StudyRunArguments& arguments,
                                            const std::string& build);

/// Prints the runs of the plan and their duration, estimated by timing a few of them.
void print_plan(const studies::Plan& plan, const StudyRunArguments& arguments);

/// Prints old names with the new ones, parameters whose slowest gait does not fit the duration, and limits of parameters that
/// the scenario refuses.
void print_notes(const studies::Plan& plan, bool quiet);

/// Builds whose rows are accepted.
studies::Journal::Build taken_build(const StudyRunArguments& arguments);

/// Raises the budget to the runs in the journal, if it is smaller, with a note on `folder` unless `quiet`.
void keep_runs(studies::Plan& plan, studies::Journal& journal, const std::filesystem::path& folder, bool quiet);

/// Throws InputError if several independent copies of the program, as mpirun starts them, would write one journal, unless they
/// are a team. `command`: `gaitlab sweep`.
void refuse_copies(const char* command);

/// Number of threads from -j; 0: one per processor, in a team one.
int study_threads(int jobs);

/// Whether a folder contains the study of this head.
std::function<bool(const std::filesystem::path&)> holds_study(const studies::JournalHead& head);

}  // namespace gaitlab::app
