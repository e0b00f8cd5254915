// Searches in a journal: generations, and verification of the best points.
#include <array>
#include <cmath>

#include "studies/journal/journal.h"

namespace gaitlab::studies {

namespace {

std::uint64_t count_at(const Statement& row, int at) { return static_cast<std::uint64_t>(row.integer(at)); }

double number_at(const Statement& row, int at) { return row.null(at) ? std::nan("") : row.number(at); }

}  // namespace

void Journal::write(std::span<const Generation> generations) {
  Transaction transaction(database_);
  Statement insert = database_.prepare("INSERT OR IGNORE INTO search VALUES(?,?,?,?,?,?,?,?,?,?)");
  for (const Generation& g : generations) {
    int at = 0;
    for (const std::uint64_t count : {g.search, g.generation, g.restart, g.first_run, g.runs, g.points, g.kept})
      insert.bind(at++, static_cast<std::int64_t>(count));
    for (const double number : {g.best, g.median, g.spread}) insert.bind(at++, number);
    insert.run();
  }
  transaction.commit();
}

std::vector<Generation> Journal::generations() {
  std::vector<Generation> all;
  Statement rows = database_.prepare("SELECT * FROM search ORDER BY search, generation");
  while (rows.step()) {
    all.push_back({count_at(rows, 0), count_at(rows, 1), count_at(rows, 2), count_at(rows, 3), count_at(rows, 4),
                   count_at(rows, 5), count_at(rows, 6), number_at(rows, 7), number_at(rows, 8), number_at(rows, 9)});
  }
  return all;
}

std::string Verification::what() const {
  switch (kind) {
    case TrialKind::other_engine:
      return name;
    case TrialKind::quarter_step:
      return name + " at a quarter of its step";
    case TrialKind::dead_joint:
      return name + " dead";
    case TrialKind::world:
    case TrialKind::drawn_world:
      return "world " + name;
    default:
      return name_of(kind);
  }
}

void Journal::write(std::span<const Verification> verifications) {
  Transaction transaction(database_);
  database_.execute("DELETE FROM verification");
  Statement insert = database_.prepare("INSERT INTO verification VALUES(NULL,?,?,?,?,?,?,?,?,?,?,?)");
  for (const Verification& v : verifications) {
    insert.bind(0, static_cast<std::int64_t>(v.run)).bind(1, std::string(name_of(v.kind))).bind(2, v.name);
    for (std::size_t k = 0; k < kMostObjectives; ++k)
      insert.bind(3 + static_cast<int>(k), k < v.objectives.size() ? v.objectives[k] : std::nan(""));
    insert.bind(6, v.violation)
        .bind(7, std::string(name_of(v.verdict)))
        .bind(8, std::int64_t{v.reason.empty()})
        .bind(9, v.reason)
        .bind(10, v.check);
    insert.run();
  }
  transaction.commit();
}

std::vector<Verification> Journal::verifications() {
  std::vector<Verification> all;
  Statement rows = database_.prepare("SELECT * FROM verification ORDER BY number");
  while (rows.step()) {
    Verification v{count_at(rows, 1),  named_cell<TrialKind>(rows.text(2), "kind of verification", file_),
                   rows.text(3),       {},
                   number_at(rows, 7), named_cell<Word>(rows.text(8), "verdict", file_),
                   rows.text(10),      rows.text(11)};
    for (std::size_t k = 0; k < head_.objectives.size(); ++k) v.objectives.push_back(number_at(rows, 4 + static_cast<int>(k)));
    if (rows.integer(9) == 0 && v.reason.empty()) v.reason = "not verified";
    all.push_back(std::move(v));
  }
  return all;
}

}  // namespace gaitlab::studies
