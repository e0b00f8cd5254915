// Executor whose runs are done by another program, which reads questions and writes results as lines of JSON.
#pragma once
#include "app/study/lines.h"
#include "studies/run/executor.h"

namespace gaitlab::app {

/// Executor that prints the points of its jobs on standard output, each as a question of one line, with an empty line after the
/// last one, and reads a result for each from `lines`, in any order (studies/run/told.h). It returns false if the lines end
/// before. It throws InputError if a line is not the result of an open question, and RunError if the output cannot be written.
/// Each point must have one run. Plan and lines must outlive the executor.
studies::Executor asking_executor(const studies::Plan& plan, Lines& lines);

/// Writes a line to standard output at once. Throws RunError if that fails; `kept` ends the message.
void print_line(const std::string& line, const std::string& kept);

}  // namespace gaitlab::app
