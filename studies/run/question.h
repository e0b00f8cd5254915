// Protocol for a program that chooses points: questions and answers, one line of JSON each.
#pragma once
#include <span>
#include <string>
#include <vector>

#include "studies/journal/results.h"
#include "studies/study/study.h"

namespace gaitlab::studies {

/// `{"id": 7, "parameters": {"cpg.frequency": 0.5}}`
struct Question {
  std::string id;                   ///< as JSON
  std::vector<std::string> values;  ///< of the parameters, in the form of --set
  std::string refused;              ///< reason why the study does not have such a point; empty: it has
};

/// Reads a question; `place`: of the line. Throws InputError if it is not a question to this study: not JSON, or a parameter
/// that is missing, unknown or of the wrong type. A value outside the study's range gives a refused point.
Question read_question(const std::string& line, const SourceLocation& place, const std::vector<Parameter>& parameters);

/// Answer for a point: runs in the order of replicates with their quantities, one row of values each by column; without rows:
/// refused. With several replicates each quantity is a list. Numbers are the shortest that give the same double; unknown ones
/// are null.
std::string answer(const Question& question, const JournalHead& head, std::span<const Brief> runs,
                   std::span<const std::vector<std::string>> quantities);

}  // namespace gaitlab::studies
