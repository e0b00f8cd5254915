#include "app/study/asking.h"

#include <fmt/format.h>
#include <unistd.h>

#include <cerrno>
#include <cmath>
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
  row.verdict = told.verdict;
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

/// Removes from `open` the question that a result answers, and returns its row.
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

/// The questions and results of one batch.
class Batch {
 public:
  Batch(const studies::Plan& plan, const studies::Work& work, Lines& lines) : plan_(plan), work_(work), lines_(lines) {}

  /// Prints the questions. Results that arrive meanwhile are taken immediately: a program that answers each question at once
  /// would wait for ever if neither its results nor the next questions found room in their pipes. If their reader has gone, a
  /// question stays open, and wait() ends.
  void ask(const std::atomic<bool>& stop) {
    bool asked = false;
    while (const std::optional<studies::Job> job = stop ? std::nullopt : work_.next()) {
      asked = true;
      open_.emplace(job->row.run, job->row);
      if (!print_line(question_text(job->row.run, plan_.study(), job->row.values), kKept, stop)) return;
      while (const std::optional<std::string> line = stop ? std::nullopt : lines_.arrived()) take(*line);
    }
    if (asked) (void)print_line("", kKept, stop);  // if it fails, wait() ends
  }

  /// Waits for the missing results. Returns false if they do not come.
  bool wait(const std::atomic<bool>& stop) {
    while (!open_.empty()) {
      const std::optional<std::string> line = lines_.next(stop);
      if (!line) return false;
      take(*line);
    }
    return true;
  }

 private:
  static constexpr const char* kKept = "all results are in the journal";

  void take(const std::string& line) {
    if (is_blank(line)) return;
    const SourceLocation place{"stdin", lines_.number(), 1};
    Told told = studies::read_told(line, place, plan_.study().objectives.size());
    Row row = asked_row(open_, told, place);
    std::vector<Row> rows;
    rows.push_back(with_result(std::move(row), std::move(told), plan_.columns()));
    work_.end(std::move(rows));
  }

  const studies::Plan& plan_;
  const studies::Work& work_;
  Lines& lines_;
  Open open_ = {};
};

}  // namespace

bool print_line(const std::string& line, const std::string& kept, const std::atomic<bool>& stop) {
  const std::string text = line + "\n";
  // Not written by stdio, because stdio would try again at the end of the program.
  for (std::size_t at = 0; at < text.size();) {
    const ssize_t size = ::write(STDOUT_FILENO, text.data() + at, text.size() - at);
    if (size >= 0) {
      at += static_cast<std::size_t>(size);
    } else if (errno == EPIPE || (errno == EINTR && stop)) {
      return false;
    } else if (errno != EINTR) {
      throw RunError(fmt::format("standard output cannot be written: {}; {}", std::generic_category().message(errno), kept));
    }
  }
  return true;
}

studies::Executor asking_executor(const studies::Plan& plan, Lines& lines) {
  return [&plan, &lines](const studies::Work& work, std::atomic<bool>& stop) {
    Batch batch(plan, work, lines);
    batch.ask(stop);
    return batch.wait(stop);
  };
}

}  // namespace gaitlab::app
