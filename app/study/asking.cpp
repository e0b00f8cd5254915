#include "app/study/asking.h"

#include <fmt/format.h>

#include <cerrno>
#include <cmath>
#include <cstdio>
#include <map>
#include <system_error>

#include "core/settings/wording.h"
#include "studies/run/question.h"
#include "studies/run/told.h"

namespace gaitlab::app {

namespace {

using studies::Row;
using studies::Told;

/// Row of a run with the result of the other program.
Row with_result(Row row, Told&& told, const std::vector<studies::Quantity>& columns) {
  row.outcome = std::move(told.outcome);
  row.message = std::move(told.message);
  row.simulated = told.simulated;
  row.verdict = std::move(told.verdict);
  if (row.outcome != "done") return row;
  row.score = told.score;
  for (const studies::Quantity& column : columns) {
    const auto known = told.quantities.find(column.name);
    row.quantities.push_back(known == told.quantities.end() ? std::nan("") : known->second);
  }
  return row;
}

/// The questions of one batch, by number.
using Open = std::map<std::uint64_t, Row>;

/// Prints the questions. The results that arrive meanwhile are read into `lines`: a program that answers each question at once
/// would wait for ever if neither its results nor the next questions found room in their pipes.
Open ask(const studies::Plan& plan, const studies::Work& work, Lines& lines) {
  Open open;
  while (const std::optional<studies::Job> job = work.next()) {
    print_line(question_text(job->row.run, plan.study().parameters, job->row.values), "all results are in the journal");
    open.emplace(job->row.run, job->row);
    lines.take();
  }
  if (!open.empty()) print_line("", "all results are in the journal");
  return open;
}

/// Takes the question of a result from `open`.
Row asked_row(Open& open, const Told& told, const SourceLocation& place) {
  const auto at = open.find(told.point);
  if (at == open.end()) {
    throw InputError(place, fmt::format("no open question has the id {}; expected {}", told.point,
                                        open.size() == 1 ? fmt::format("{}", open.begin()->first)
                                                         : fmt::format("one of {} from {} to {}", open.size(),
                                                                       open.begin()->first, open.rbegin()->first)));
  }
  Row row = std::move(at->second);
  open.erase(at);
  return row;
}

}  // namespace

void print_line(const std::string& line, const std::string& kept) {
  const std::string text = line + "\n";
  if (std::fwrite(text.data(), 1, text.size(), stdout) == text.size() && std::fflush(stdout) == 0) return;
  const int error = errno;
  throw RunError(fmt::format("standard output cannot be written: {}; {}",
                             error == EPIPE ? "its reader has closed it" : std::generic_category().message(error), kept));
}

studies::Executor asking_executor(const studies::Plan& plan, Lines& lines) {
  return [&plan, &lines](const studies::Work& work, std::atomic<bool>& stop) {
    Open open = ask(plan, work, lines);
    while (!open.empty()) {
      const std::optional<std::string> line = lines.next(stop);
      if (!line) return false;
      if (line->find_first_not_of(" \t\r") == std::string::npos) continue;
      const SourceLocation place{"stdin", lines.number(), 1};
      Told told = studies::read_told(*line, place, plan.study().objectives.size());
      Row row = asked_row(open, told, place);
      std::vector<Row> rows;
      rows.push_back(with_result(std::move(row), std::move(told), plan.columns()));
      work.end(std::move(rows));
    }
    return true;
  };
}

}  // namespace gaitlab::app
