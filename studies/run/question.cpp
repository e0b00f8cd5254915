#include "studies/run/question.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "core/settings/wording.h"
#include "studies/run/json_line.h"
#include "studies/study/number.h"

namespace gaitlab::studies {

namespace {

using Json = nlohmann::json;
constexpr const char* kExpected = R"(; expected {"id": 7, "parameters": {"KEY": VALUE}})";

/// Value of a parameter in the form of --set. A value of the wrong type is a problem. A value out of range marks the question
/// as refused.
std::string value_of(const Json& value, const Parameter& p, Question& question, const SourceLocation& place,
                     Problems& problems) {
  if (p.words ? !value.is_string() : !value.is_number()) {
    problems.add(place, fmt::format("{} is {}; expected {}", clipped(p.key), clipped(value.dump(-1, ' ', true)),
                                    p.words ? "a word, in double quotes" : "a number"));
    return {};
  }
  // + 0.0 turns -0 into 0.
  std::string text = p.words ? value.get<std::string>() : number_text(value.get<double>() + 0.0);
  const double number = p.words ? 0 : value.get<double>();
  const bool listed = std::ranges::find(p.values, text) != p.values.end();
  if (p.values.empty() ? number >= p.low && number <= p.high : listed) return text;
  const std::string allowed =
      p.values.empty() ? fmt::format("{} to {}", number_text(p.low), number_text(p.high)) : joined(p.values);
  if (question.refused.empty()) question.refused = fmt::format("{} is {}; expected {}", p.key, clipped(text), allowed);
  return text;
}

/// Value of a column minus `least`; for a point with several runs, a list of these values.
std::string of_runs(std::span<const std::vector<std::string>> quantities, std::size_t column, double least, bool several) {
  std::string values;
  for (const std::vector<std::string>& row : quantities) {
    if (!values.empty()) values += ',';
    values += row[column].empty() ? "null" : json_number(number_of(row[column]) - least);
  }
  return several ? "[" + values + "]" : values;
}

}  // namespace

Question read_question(const std::string& line, const SourceLocation& place, const std::vector<Parameter>& parameters) {
  const Json root = json_object(line, place, kExpected);
  Problems problems;
  Question question;
  for (const auto& [key, value] : root.items()) {
    if (key != "id" && key != "parameters" && key != "objectives")
      problems.add(place, "unknown key " + in_quotes(key) + kExpected);
  }
  const auto id = root.find("id");
  if (id == root.end() || !(id->is_number_integer() || id->is_string())) {
    problems.add(place, std::string(id == root.end() ? "has no id" : "its id is not a whole number or a text") + kExpected);
  } else {
    question.id = id->dump(-1, ' ', false, Json::error_handler_t::replace);
  }
  const auto given = root.find("parameters");
  if (given == root.end() || !given->is_object()) {
    problems.add(place,
                 std::string(given == root.end() ? "has no parameters" : "its parameters are not an object") + kExpected);
    problems.raise();
  }
  std::vector<std::string> known;
  for (const Parameter& p : parameters) {
    known.push_back(p.key);
    if (const auto value = given->find(p.key); value != given->end()) {
      question.values.push_back(value_of(*value, p, question, place, problems));
    } else {
      problems.add(place, "has no value for the parameter " + in_quotes(p.key));
    }
  }
  for (const auto& [key, value] : given->items()) {
    if (std::ranges::find(known, key) == known.end())
      problems.add(place, "unknown parameter " + in_quotes(key) + offer(key, known, "parameters"));
  }
  problems.raise();
  return question;
}

std::string question_text(std::uint64_t id, const Study& study, std::span<const std::string> values) {
  const std::vector<Parameter>& parameters = study.parameters;
  const std::size_t objectives = study.objectives.size();
  const std::string count = objectives > 1 ? fmt::format(R"("objectives":{},)", objectives) : "";
  std::string text = fmt::format(R"({{"id":{},{}"parameters":{{)", id, count);
  for (std::size_t k = 0; k < parameters.size(); ++k) {
    text += (k == 0 ? "" : ",") + json_text(parameters[k].key) + ":";
    text += parameters[k].words ? json_text(values[k]) : json_number(number_of(values[k]));
  }
  return text + "}}";
}

std::string answer(const Question& question, const JournalHead& head, std::span<const MarginGuard> guards,
                   std::span<const Brief> runs, std::span<const std::vector<std::string>> quantities) {
  std::string text = fmt::format(R"({{"id":{})", question.id);
  const auto early = std::ranges::find_if(runs, [](const Brief& run) { return run.outcome != "done"; });
  const PointResult point = runs.empty() ? PointResult{} : point_result(head, runs);
  const bool scored = !runs.empty() && point.failed == 0;  // `share` tolerates some failed replicates
  const bool done = scored && point.stopped == 0;
  if (runs.empty()) {
    text += R"(,"run":null,"outcome":"refused","message":)" + json_text(question.refused);
  } else {
    text += fmt::format(R"(,"run":{},"outcome":{})", runs.front().run, json_text(done ? "done" : early->outcome));
    if (!done) text += R"(,"message":)" + json_text(early->message);
    double simulated = runs.front().simulated;
    for (const Brief& run : runs) simulated = std::min(simulated, run.simulated);
    text += R"(,"simulated":)" + json_number(simulated);
    if (runs.size() == 1) text += R"(,"verdict":)" + json_text(name_of(runs.front().verdict));
  }
  text += R"(,"figures":{)";
  for (std::size_t k = 0; scored && k < head.quantities.size(); ++k)
    text += (k == 0 ? "" : ",") + json_text(head.quantities[k].name) + ":" + of_runs(quantities, k, 0, head.replicates > 1);
  text += R"(},"margins":{)";
  for (std::size_t k = 0; scored && k < guards.size(); ++k) {
    text += (k == 0 ? "" : ",") + json_text(guards[k].check) + ":" +
            of_runs(quantities, guards[k].column, guards[k].least, head.replicates > 1);
  }
  text += R"(},"objective":[)";
  for (std::size_t k = 0; k < head.objectives.size(); ++k)
    text += (k == 0 ? "" : ",") + (scored ? json_number(point.score.objectives[k]) : "null");
  text += fmt::format(R"(],"violation":{},"kept":{},"feasible":{})", scored ? json_number(point.score.violation) : "null",
                      scored && point.kept(), scored && point.feasible());
  if (head.replicates > 1) text += R"(,"feasible_share":)" + (runs.empty() ? "null" : json_number(point.feasible_share()));
  text += "}";
  return text;
}

}  // namespace gaitlab::studies
