// What another program asks and is told, a line of JSON each.
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
  std::vector<std::string> values;  ///< of the parameters, as for --set
  std::string refused;              ///< why the study has no such point; empty: it has
};

/// Reads one; `place`: of the line. InputError: it is not a question to this study: not JSON, a parameter that is missing,
/// unknown or not of its kind. A value beyond what the study allows is a point that is refused.
Question read_question(const std::string& line, const SourceLocation& place, const std::vector<Parameter>& parameters);

/// What is told of a point: runs in the order of replicates with their quantities, one row of values each by column; none: it
/// was refused. With several replicates each quantity is a list. Numbers are the shortest that give the same double; not known:
/// null.
std::string answer(const Question& question, const JournalHead& head, std::span<const Brief> runs,
                   std::span<const std::vector<std::string>> quantities);

}  // namespace gaitlab::studies
