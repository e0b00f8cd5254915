// Executor whose runs are done by another program, which reads questions and writes results as lines of JSON.
#pragma once
#include "app/study/lines.h"
#include "studies/run/executor.h"

namespace gaitlab::app {

/// Executor that prints the points of its jobs on standard output, each as a question of one line, with an empty line after the
/// last one. It reads a result for each question from `lines`, in any order (studies/run/told.h). Results are processed as they
/// arrive and are not stored. It returns false if it was stopped, the lines end early, or the output is closed. It throws
/// InputError if a line is not the result of an open question, and RunError if the output cannot be written for another reason.
/// Each point must have one run. Plan and lines must outlive the executor.
studies::Executor asking_executor(const studies::Plan& plan, Lines& lines);

/// Writes a line to standard output immediately. Returns false if its reader has closed it, or if `stop` is set while the
/// reader takes nothing. Throws RunError for any other failure; `kept` ends the message.
bool print_line(const std::string& line, const std::string& kept, const std::atomic<bool>& stop);

}  // namespace gaitlab::app
