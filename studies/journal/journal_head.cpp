// Description of the study in a journal: writing, reading and comparison of its tables.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <ctime>
#include <set>

#include "core/settings/changed_lines.h"
#include "studies/journal/journal.h"
#include "studies/journal/journal_tables.h"
#include "studies/study/scenarios.h"

namespace gaitlab::studies {

namespace {

constexpr std::array kBefore{"run", "point", "replicate", "seed", "outcome", "message", "simulated"};
constexpr const char* kScenario = "scenario";
constexpr const char* kViolation = "violation";
constexpr const char* kKept = "kept";
constexpr std::uint64_t kMostRuns = 4'000'000'000;  // a journal with more was not written by this program

std::string lower(std::string text) {
  for (char& c : text) c = c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c;  // SQLite compares names without case
  return text;
}

std::string split_values(const std::vector<std::string>& values) { return fmt::format("{}", fmt::join(values, "\n")); }

std::vector<std::string> joined_values(const std::string& text) {
  std::vector<std::string> values;
  for (std::size_t at = 0; at < text.size();) {
    const std::size_t end = std::min(text.find('\n', at), text.size());
    values.push_back(text.substr(at, end - at));
    at = end + 1;
  }
  return values;
}

[[noreturn]] void refuse(const std::filesystem::path& file, const std::string& what) {
  throw InputError(SourceLocation{file.string()}, what);
}

}  // namespace

std::string unit_of(const JournalHead& head, const std::string& name) {
  const auto quantity = std::ranges::find(head.quantities, name, &Quantity::name);
  return quantity == head.quantities.end() ? "" : quantity->unit;
}

std::string objective_column(std::size_t number) { return fmt::format("objective.{}", number + 1); }

std::size_t place_in(const std::vector<std::string>& names, const std::string& name) {
  return static_cast<std::size_t>(std::ranges::find(names, name) - names.begin());
}

RunColumns::RunColumns(const JournalHead& head) : scenario(!head.scenarios.empty()) {
  std::set<std::string> taken(kBefore.begin(), kBefore.end());
  taken.insert({kViolation, kKept});
  taken.insert("verdict");
  if (scenario) taken.insert(kScenario);
  for (std::size_t k = 0; k < head.objectives.size(); ++k) objectives.push_back(*taken.insert(objective_column(k)).first);
  const auto unique = [&](const std::string& name, const char* kind) {
    std::string column = name;
    for (int k = 1; !taken.insert(lower(column)).second; ++k)
      column = k == 1 ? fmt::format("{}.{}", kind, name) : fmt::format("{}.{}-{}", kind, name, k);
    return column;
  };
  sql =
      "CREATE TABLE run(run INTEGER PRIMARY KEY, point TEXT NOT NULL, replicate INTEGER NOT NULL, seed INTEGER NOT NULL, "
      "outcome TEXT NOT NULL, message TEXT NOT NULL, simulated REAL NOT NULL";
  if (scenario) sql += fmt::format(", {} TEXT NOT NULL", kScenario);
  for (const JournalParameter& p : head.parameters) {
    parameters.push_back(unique(p.key, "parameter"));
    sql += ", " + identifier(parameters.back()) + (p.words ? " TEXT NOT NULL" : " REAL NOT NULL");
  }
  for (const Quantity& quantity : head.quantities) {
    quantities.push_back(unique(quantity.name, "figure"));
    sql += ", " + identifier(quantities.back()) + " REAL";
  }
  sql += ", verdict TEXT NOT NULL";
  for (const std::string& objective : objectives) sql += ", " + identifier(objective) + " REAL";
  sql += fmt::format(", {} REAL, {} INTEGER NOT NULL) STRICT", kViolation, kKept);
}

std::vector<std::string> RunColumns::all() const {
  std::vector<std::string> names(kBefore.begin(), kBefore.end());
  if (scenario) names.emplace_back(kScenario);
  names.insert(names.end(), parameters.begin(), parameters.end());
  names.insert(names.end(), quantities.begin(), quantities.end());
  names.emplace_back("verdict");
  names.insert(names.end(), objectives.begin(), objectives.end());
  names.insert(names.end(), {kViolation, kKept});
  return names;
}

std::string utc_now() {
  const std::time_t now = std::time(nullptr);
  std::tm utc{};
  gmtime_r(&now, &utc);
  return fmt::format("{:04}-{:02}-{:02}T{:02}:{:02}:{:02}Z", utc.tm_year + 1900, utc.tm_mon + 1, utc.tm_mday, utc.tm_hour,
                     utc.tm_min, utc.tm_sec);
}

namespace {

void insert_parameters(Database& database, const JournalHead& head, const RunColumns& columns) {
  Statement parameter = database.prepare("INSERT INTO parameter VALUES(?,?,?,?,?,?,?,?)");
  for (std::size_t k = 0; k < head.parameters.size(); ++k) {
    const JournalParameter& p = head.parameters[k];
    parameter.bind(0, static_cast<std::int64_t>(k + 1)).bind(1, columns.parameters[k]).bind(2, p.key);
    parameter.bind(3, std::string(p.drawn ? "drawn " : "") + (p.words ? "word" : "real"));
    const bool listed = !p.values.empty() || p.drawn;
    parameter.bind(4, listed ? std::nan("") : p.low).bind(5, listed ? std::nan("") : p.high);
    parameter.bind(6, std::string(p.log ? "log" : "linear")).bind(7, split_values(p.values)).run();
  }
}

void insert_quantities(Database& database, const JournalHead& head, const RunColumns& columns) {
  Statement quantity = database.prepare("INSERT INTO quantity VALUES(?,?,?,?,?,?)");
  for (std::size_t k = 0; k < head.quantities.size(); ++k) {
    const Quantity& f = head.quantities[k];
    const auto shown = std::ranges::find(head.shown, f.name) - head.shown.begin();
    const bool is_shown = shown < static_cast<std::ptrdiff_t>(head.shown.size());
    quantity.bind(0, static_cast<std::int64_t>(k + 1)).bind(1, columns.quantities[k]).bind(2, f.name).bind(3, f.unit);
    quantity.bind(4, f.meaning).bind(5, std::int64_t{is_shown ? shown + 1 : 0}).run();
  }
}

void insert_aims(Database& database, const JournalHead& head) {
  Statement objective = database.prepare("INSERT INTO objective VALUES(?,?,?)");
  for (std::size_t k = 0; k < head.objectives.size(); ++k) {
    const JournalObjective& o = head.objectives[k];
    objective.bind(0, static_cast<std::int64_t>(k + 1)).bind(1, o.expression);
    objective.bind(2, std::string(o.maximize ? "maximize" : "minimize")).run();
  }
  Statement limit = database.prepare("INSERT INTO \"constraint\" VALUES(?,?,?)");
  for (std::size_t k = 0; k < head.limits.size(); ++k) {
    const Limit& l = head.limits[k];
    limit.bind(0, static_cast<std::int64_t>(k + 1)).bind(1, l.text).bind(2, std::int64_t{l.guard}).run();
  }
}

}  // namespace

void Journal::create() {
  Transaction transaction(database_);
  database_.execute(fmt::format("PRAGMA user_version = {}", kSchema));
  for (const JournalTable& table : kTables) database_.execute(table.sql);
  database_.execute(columns_.sql);
  database_.execute("CREATE VIEW best AS SELECT * FROM run WHERE kept = 1 ORDER BY \"objective.1\" " +
                    std::string(head_.objectives.front().maximize ? "DESC" : "ASC") + ", run");
  database_.execute(
      fmt::format("CREATE VIEW point AS SELECT run / {0} * {0} AS first_run, count(*) AS runs, avg(verdict = 'feasible') AS "
                  "feasible_share FROM run "
                  "GROUP BY run / {0}",
                  head_.replicates));
  database_.prepare("INSERT INTO study VALUES(?,?,?,?,?,?,?,?,?,?,?,?,?,?,?,?)")
      .bind(0, head_.name)
      .bind(1, utc_now())
      .bind(2, head_.build)
      .bind(3, head_.definition)
      .bind(4, head_.scenario)
      .bind(5, head_.command)
      .bind(6, head_.seed)
      .bind(7, static_cast<std::int64_t>(head_.runs))
      .bind(8, static_cast<std::int64_t>(head_.replicates))
      .bind(9, head_.combine)
      .bind(10, head_.quantile)
      .bind(11, std::int64_t{head_.guarded})
      .bind(12, head_.method)
      .bind(13, std::int64_t{head_.told})
      .bind(14, head_.torque_error)
      .bind(15, split_values(head_.worlds))
      .run();
  insert_parameters(database_, head_, columns_);
  insert_quantities(database_, head_, columns_);
  insert_aims(database_, head_);
  transaction.commit();
}

namespace {

constexpr const char* kForeign = "is not a journal that this program wrote: ";

/// Reads the row of table `study`. Throws InputError if the row is missing or damaged.
JournalHead read_study(Database& database, const std::filesystem::path& file) {
  JournalHead head;
  Statement study = database.prepare("SELECT * FROM study");
  if (!study.step()) refuse(file, std::string(kForeign) + "it names no study");
  head.name = study.text(0);
  head.build = study.text(2);
  head.definition = study.text(3);
  head.scenario = study.text(4);
  for (ScenarioText& one : scenario_texts(head.scenario)) head.scenarios.push_back(std::move(one.name));
  head.command = study.text(5);
  head.seed = study.integer(6);
  head.runs = static_cast<std::uint64_t>(study.integer(7));
  head.replicates = static_cast<std::uint64_t>(study.integer(8));
  head.combine = study.text(9);
  head.quantile = study.number(10);
  head.guarded = study.integer(11) != 0;
  head.method = study.text(12);
  head.told = study.integer(13) != 0;
  head.torque_error = study.number(14);
  head.worlds = joined_values(study.text(15));
  const bool even = head.scenarios.empty() || head.replicates % head.scenarios.size() == 0;
  if (head.runs > kMostRuns || head.replicates == 0 || head.replicates > kMostRuns || !even)
    refuse(file, std::string(kForeign) + "its numbers of runs are out of range");
  return head;
}

/// Reads parameters, quantities, objectives and limits, each in the order of their numbers.
void read_lists(Database& database, const std::filesystem::path& file, JournalHead& head) {
  Statement parameter = database.prepare("SELECT * FROM parameter ORDER BY number");
  while (parameter.step()) {
    const std::string kind = parameter.text(3);
    head.parameters.push_back({parameter.text(2), kind.ends_with("word"), kind.starts_with("drawn"), parameter.number(4),
                               parameter.number(5), parameter.text(6) == "log", joined_values(parameter.text(7))});
  }
  Statement quantity = database.prepare("SELECT * FROM quantity ORDER BY number");
  std::vector<std::pair<std::int64_t, std::string>> shown;
  while (quantity.step()) {
    head.quantities.push_back({quantity.text(2), quantity.text(3), quantity.text(4)});
    if (quantity.integer(5) > 0) shown.emplace_back(quantity.integer(5), quantity.text(2));
  }
  std::ranges::sort(shown);
  for (auto& [rank, name] : shown) head.shown.push_back(std::move(name));
  Statement objective = database.prepare("SELECT * FROM objective ORDER BY number");
  while (objective.step()) head.objectives.push_back({objective.text(1), objective.text(2) != "minimize"});
  if (head.objectives.empty() || head.objectives.size() > kMostObjectives)
    refuse(file, std::string(kForeign) + "its number of objectives is out of range");
  Statement limit = database.prepare("SELECT * FROM \"constraint\" ORDER BY number");
  while (limit.step()) head.limits.push_back({limit.text(1), limit.integer(2) != 0});
}

}  // namespace

void Journal::read_head() {
  if (database_.integer("PRAGMA application_id") != kApplication)
    refuse(file_, "is a database of SQLite, and not the journal of a study");
  if (const std::int64_t version = database_.integer("PRAGMA user_version"); version != kSchema)
    refuse(file_, fmt::format("is a journal of format {}; this program reads format {}", version, kSchema));
  Statement table = database_.prepare("SELECT sql FROM sqlite_master WHERE type = 'table' AND name = ?");
  const auto check = [&](const std::string& name, const std::string& sql) {
    const bool same = table.bind(0, name).step() && table.text(0) == sql;
    while (table.step()) {
    }
    if (!same) refuse(file_, kForeign + ("its table " + name) + " is another");
  };
  for (const JournalTable& known : kTables) check(known.name, known.sql);
  JournalHead head = read_study(database_, file_);
  read_lists(database_, file_, head);
  RunColumns columns(head);
  check("run", columns.sql);
  head_ = std::move(head);
  columns_ = std::move(columns);
}

void Journal::compare(const JournalHead& head, Build build) {
  std::vector<std::string> changes;
  for (const auto& [what, then, now] :
       {std::tuple{"study", &head_.definition, &head.definition}, {"scenario", &head_.scenario, &head.scenario}}) {
    if (*then == *now) continue;
    for (const std::string& line : changed_lines(*then, *now)) changes.push_back(fmt::format("{}, {}", what, line));
  }
  std::string text;
  for (const std::string& change : changes) text += "\n  " + change;
  if (!changes.empty()) {
    refuse(file_,
           "belongs to another study; choose another folder (--out), or continue it as it was begun: " + head_.command + text);
  }
  const bool noted = head_.build == head.build || head_.build.ends_with("; " + head.build);
  if (!noted && build == Build::same) {
    refuse(file_, "was begun by another build, which may give other numbers: then " + head_.build + ", now " + head.build +
                      "; continue nevertheless with --accept-build");
  }
  if (!noted) {
    head_.build += "; " + head.build;
    database_.prepare("UPDATE study SET build = ?").bind(0, head_.build).run();
  }
  if (head.runs != 0 && head_.runs != head.runs) {
    head_.runs = head.runs;
    database_.prepare("UPDATE study SET runs = ?").bind(0, static_cast<std::int64_t>(head.runs)).run();
  }
}

}  // namespace gaitlab::studies
