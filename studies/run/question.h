// Protocol with a program that chooses points: each question and each answer is one line of JSON.
#pragma once
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "studies/journal/results.h"
#include "studies/study/study.h"

namespace gaitlab::studies {

/// A question such as `{"id": 7, "parameters": {"cpg.frequency": 0.5}}`.
struct Question {
  std::string id;                   ///< JSON text of the id
  std::vector<std::string> values;  ///< values of the parameters in the form of --set
  std::string refused;              ///< reason why the study excludes this point; empty if the point is valid
};

/// Reads a question from `line` at `place`. Throws InputError if the line is not JSON, or if a parameter is missing, unknown or
/// of the wrong type; The member `objectives`, which question_text() adds, is ignored. A value outside the study's range gives
/// a refused point.
Question read_question(const std::string& line, const SourceLocation& place, const std::vector<Parameter>& parameters);

/// The question for a point by its values in the form of --set, as read_question() reads it. If there are several objectives,
/// it contains their number, so that the other program need not read the study.
std::string question_text(std::uint64_t id, const Study& study, std::span<const std::string> values);

/// Answer for a point. `margins` contains, by the id of its check, each guard's margin minus the least margin that the study
/// requires: 0 or more satisfies the guard. `runs` are in the order of replicates, and `quantities` contains their values by
/// column. An empty `runs` means that the point is refused. Each quantity is a list if there are several replicates. A number
/// is the shortest text that gives the same double, and an unknown number is null.
std::string answer(const Question& question, const JournalHead& head, std::span<const MarginGuard> guards,
                   std::span<const Brief> runs, std::span<const std::vector<std::string>> quantities);

}  // namespace gaitlab::studies
