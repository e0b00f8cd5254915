#include "studies/journal/journal.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "studies/journal/journal_tables.h"
#include "studies/study/number.h"

namespace gaitlab::studies {

Journal::Journal(const std::filesystem::path& file, const JournalHead& head, Build build)
    : file_(file), head_(head), database_(file, Database::Mode::write), columns_(head) {
  const std::int64_t application = database_.integer("PRAGMA application_id");
  if (database_.integer("SELECT count(*) FROM sqlite_master") == 0 && (application == 0 || application == kApplication)) {
    // The application ID precedes the write-ahead log, so that the file's first bytes identify the journal even after kill -9.
    database_.execute(fmt::format("PRAGMA application_id = {}", kApplication));
    database_.write_ahead();
    create();
  } else {
    read_head();  // checks the file, and does not modify a file of another program
    database_.write_ahead();
    compare(head, build);
  }
  prepare();
}

Journal::Journal(const std::filesystem::path& file) : file_(file), database_(file, Database::Mode::read), columns_(head_) {
  read_head();
}

void Journal::prepare() {
  std::string marks = "?";
  for (std::size_t k = 1; k < columns_.all().size(); ++k) marks += ",?";
  insert_ = database_.prepare("INSERT OR IGNORE INTO run VALUES(" + marks + ")");
  insert_effort_ = database_.prepare("INSERT INTO effort VALUES(NULL,?,?,?,?,?,?)");
  insert_start_ = database_.prepare("INSERT INTO attempt VALUES(?,1) ON CONFLICT(run) DO UPDATE SET started = started + 1");
  remove_start_ = database_.prepare("DELETE FROM attempt WHERE run = ?");
}

Effort Journal::effort() {
  Effort all;
  Statement sum = database_.prepare("SELECT coalesce(sum(runs), 0), coalesce(sum(wall), 0) FROM effort");
  if (!sum.step()) return all;
  all.runs = static_cast<std::uint64_t>(sum.integer(0));
  all.wall = sum.number(1);
  return all;
}

std::string Journal::column_of(const std::string& quantity) const {
  const auto at = std::ranges::find(head_.quantities, quantity, &Quantity::name);
  return at == head_.quantities.end() ? "" : columns_.quantities[static_cast<std::size_t>(at - head_.quantities.begin())];
}

std::uint64_t Journal::rows() { return static_cast<std::uint64_t>(database_.integer("SELECT count(*) FROM run")); }

std::uint64_t Journal::end() {
  constexpr std::int64_t kMost = 1'000'000'000;
  const std::int64_t last = database_.integer("SELECT coalesce(max(run), -1) FROM run");
  if (last >= -1 && last < kMost) return static_cast<std::uint64_t>(last + 1);
  throw InputError(SourceLocation{file_.string()},
                   "is not a journal that this program wrote: a run has number " + std::to_string(last));
}

std::vector<bool> Journal::present(std::uint64_t runs) {
  std::vector<bool> present(runs);
  Statement all = database_.prepare("SELECT run FROM run");
  while (all.step()) {
    const auto run = static_cast<std::uint64_t>(all.integer(0));
    if (run < runs) present[run] = true;
  }
  return present;
}

void Journal::expect(std::uint64_t runs) {
  if (runs <= head_.runs) return;
  head_.runs = runs;
  database_.prepare("UPDATE study SET runs = ?").bind(0, static_cast<std::int64_t>(runs)).run();
}

void Journal::bind(Statement& insert, const Row& row) const {
  int at = 0;
  const auto add = [&](const auto& value) { insert.bind(at++, value); };
  add(static_cast<std::int64_t>(row.run));
  add(row.point);
  add(static_cast<std::int64_t>(row.replicate));
  add(row.seed);
  add(row.outcome);
  add(row.message);
  add(row.simulated);
  if (columns_.scenario) add(row.scenario);
  for (std::size_t k = 0; k < row.values.size(); ++k) {
    if (head_.parameters[k].words) {
      add(row.values[k]);
    } else {
      add(number_of(row.values[k]));
    }
  }
  for (std::size_t k = 0; k < head_.quantities.size(); ++k) add(k < row.quantities.size() ? row.quantities[k] : std::nan(""));
  add(std::string(name_of(row.verdict)));
  for (std::size_t k = 0; k < head_.objectives.size(); ++k) add(row.score ? row.score->objectives[k] : std::nan(""));
  add(row.score ? row.score->violation : std::nan(""));
  add(std::int64_t{row.score && row.score->kept()});
}

void Journal::write(std::span<const Row> rows, const Effort& effort) {
  Transaction transaction(database_);
  for (const Row& row : rows) {
    bind(*insert_, row);
    insert_->run();
    remove_start_->bind(0, static_cast<std::int64_t>(row.run)).run();
  }
  insert_effort_->bind(0, static_cast<std::int64_t>(effort.first_run)).bind(1, static_cast<std::int64_t>(effort.runs));
  insert_effort_->bind(2, effort.started).bind(3, effort.wall).bind(4, effort.host).bind(5, effort.process).run();
  transaction.commit();
}

void Journal::replace(std::span<const Row> rows) {
  Transaction transaction(database_);
  Statement drop = database_.prepare("DELETE FROM run WHERE run = ?");
  for (const Row& row : rows) {
    drop.bind(0, static_cast<std::int64_t>(row.run)).run();
    bind(*insert_, row);
    insert_->run();
  }
  transaction.commit();
}

void Journal::count_starts(std::span<const std::uint64_t> runs) {
  Transaction transaction(database_);
  for (const std::uint64_t run : runs) insert_start_->bind(0, static_cast<std::int64_t>(run)).run();
  transaction.commit();
}

void Journal::forget_starts(std::span<const std::uint64_t> runs) {
  Transaction transaction(database_);
  for (const std::uint64_t run : runs) remove_start_->bind(0, static_cast<std::int64_t>(run)).run();
  transaction.commit();
}

std::vector<std::pair<std::uint64_t, std::int64_t>> Journal::unfinished() {
  std::vector<std::pair<std::uint64_t, std::int64_t>> found;
  Statement all = database_.prepare("SELECT run, started FROM attempt ORDER BY run");
  while (all.step()) found.emplace_back(static_cast<std::uint64_t>(all.integer(0)), all.integer(1));
  return found;
}

void Journal::each_brief(const std::function<void(const Brief&)>& take) {
  std::string objectives;
  for (std::size_t k = 0; k < head_.objectives.size(); ++k) objectives += ", " + identifier(objective_column(k));
  Statement all =
      database_.prepare("SELECT run, outcome, message, simulated, violation, verdict" + objectives + " FROM run ORDER BY run");
  while (all.step()) {
    Brief brief{static_cast<std::uint64_t>(all.integer(0)), all.text(1), all.text(2), all.number(3)};
    if (!all.null(4)) {
      brief.score = Score{{}, all.number(4)};
      for (std::size_t k = 0; k < head_.objectives.size(); ++k) {
        const int at = 6 + static_cast<int>(k);
        brief.score->objectives[k] = all.null(at) ? std::nan("") : all.number(at);
      }
    }
    brief.verdict = named_cell<Word>(all.text(5), "verdict", file_);
    take(brief);
  }
}

std::vector<std::string> Journal::row(std::uint64_t run) {
  Statement one = database_.prepare("SELECT * FROM run WHERE run = ?");
  std::vector<std::string> texts;
  if (!one.bind(0, static_cast<std::int64_t>(run)).step()) return texts;
  for (int k = 0; k < one.columns(); ++k) texts.push_back(one.text(k));
  return texts;
}

std::vector<std::string> Journal::quantities(std::uint64_t run) {
  const std::vector<std::string> names = columns_.all();
  const std::vector<std::string> all = row(run);
  std::vector<std::string> texts(head_.quantities.size());
  if (all.empty() || texts.empty()) return texts;
  const auto first = std::ranges::find(names, columns_.quantities.front()) - names.begin();
  std::copy_n(all.begin() + first, texts.size(), texts.begin());
  return texts;
}

void Journal::each_row(const std::vector<std::string>& columns,
                       const std::function<void(const std::vector<std::string>&)>& take) {
  std::string list;
  for (const std::string& column : columns) list += (list.empty() ? "" : ", ") + identifier(column);
  Statement all = database_.prepare("SELECT " + list + " FROM run ORDER BY run");
  std::vector<std::string> texts(columns.size());
  while (all.step()) {
    for (std::size_t k = 0; k < columns.size(); ++k) texts[k] = all.text(static_cast<int>(k));
    take(texts);
  }
}

void Journal::each_numbers(const std::vector<std::string>& columns, const std::function<void(std::span<const double>)>& take) {
  std::string list;
  for (const std::string& column : columns) list += (list.empty() ? "" : ", ") + identifier(column);
  Statement all = database_.prepare("SELECT " + list + " FROM run WHERE outcome = 'done' ORDER BY run");
  std::vector<double> values(columns.size());
  while (all.step()) {
    for (std::size_t k = 0; k < columns.size(); ++k) {
      const int at = static_cast<int>(k);
      values[k] = all.null(at) ? std::nan("") : all.number(at);
    }
    take(values);
  }
}

std::uint64_t Journal::take(Journal& other) {
  if (other.head_.definition != head_.definition || other.head_.scenario != head_.scenario)
    throw InputError(SourceLocation{other.file_.string()}, "is a journal of another study than " + file_.string());
  if (other.head_.build != head_.build) {
    throw InputError(SourceLocation{other.file_.string()},
                     "was written by another build than " + file_.string() + ": " + other.head_.build + ", and " + head_.build);
  }
  Transaction transaction(database_);
  Statement all = other.database_.prepare("SELECT * FROM run ORDER BY run");
  while (all.step()) insert_->bind_row(all).run();
  transaction.commit();
  return rows();
}

}  // namespace gaitlab::studies
