// The journal of a study, study.db: a row for each run that has ended. An SQLite database, which many programs can read.
#pragma once
#include <cstdint>
#include <filesystem>
#include <functional>
#include <limits>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "studies/journal/database.h"
#include "studies/study/judge.h"

namespace gaitlab::studies {

/// Result of a run. Its quantities are known only if the outcome is `done`.
struct Row {
  std::uint64_t run = 0;
  std::string point;     ///< name derived from its values, the same in every study of the scenario
  std::string scenario;  ///< its name; empty: the study has only one
  std::uint64_t replicate = 0;
  std::int64_t seed = 0;
  std::string outcome;              ///< done, diverged, refused, plugin
  std::string message;              ///< reason why it is not `done`, or its verdict not `feasible`
  double simulated = 0;             ///< s
  std::vector<std::string> values;  ///< of the parameters, then of the draws
  std::vector<double> quantities;   ///< by column; empty: not known
  std::string verdict;
  std::optional<Score> score = {};
};

/// A parameter, or a key that is drawn for every replicate, as stored in the journal.
struct JournalParameter {
  std::string key;
  bool words = false;
  bool drawn = false;
  double low = 0, high = 0;
  bool log = false;
  std::vector<std::string> values;
};

struct JournalObjective {
  std::string expression;
  bool maximize = true;
};

/// Description of the study in its journal.
struct JournalHead {
  std::string name, build, definition, command;
  std::string scenario;                ///< resolved; for several as in scenario_texts
  std::vector<std::string> scenarios;  ///< names; empty: there is one
  std::vector<JournalObjective> objectives;
  std::string combine = "worst";
  double quantile = 0.5;
  std::uint64_t runs = 0;        ///< 0: number stored in the journal
  std::uint64_t replicates = 1;  ///< runs per point, in all scenarios
  std::int64_t seed = 1;
  std::vector<JournalParameter> parameters;
  std::vector<Quantity> quantities;
  std::vector<std::string> shown;  ///< names of quantities
  std::vector<Limit> limits;
  bool guarded = true;
};

/// A generation of a search whose points have all ended.
struct Generation {
  std::uint64_t search = 0, generation = 0, restart = 0;
  std::uint64_t first_run = 0, runs = 0;  ///< runs of points that had not been requested before
  std::uint64_t points = 0, kept = 0;
  double best = std::numeric_limits<double>::quiet_NaN(), median = best;  ///< of the kept points, by the first objective
  double spread = 0;  ///< largest deviation of a coordinate, as a share of the box
};

/// A run of one of the best points with another step or engine.
struct Verification {
  std::uint64_t run = 0;  ///< first run of the point
  std::string what;       ///< half step, bullet
  std::vector<double> objectives;
  double violation = 0;
  std::string verdict;  ///< of the first infeasible replicate, or of the first one
  std::string reason;   ///< reason why it is not verified, or ""
};

/// Effort of packs of runs: the only data that differ from machine to machine.
struct Effort {
  std::uint64_t first_run = 0, runs = 0;
  std::string started;  ///< UTC
  double wall = 0;      ///< s
  std::string host;
  std::int64_t process = 0;
};

/// `objective.1` for the first.
std::string objective_column(std::size_t number);

/// The columns of table `run` in their order, under their names in SQL.
struct RunColumns {
  explicit RunColumns(const JournalHead& head);
  std::vector<std::string> parameters, quantities, objectives;
  bool scenario = false;  ///< whether there is a column `scenario`
  /// Column for whether a run is kept: `kept`; `feasible` in journals of programs without a quantity of that name.
  std::string kept;
  std::string sql;  ///< statement that creates the table
  [[nodiscard]] std::vector<std::string> all() const;
};

/// A run without its quantities.
struct Brief {
  std::uint64_t run = 0;
  std::string outcome, message;
  double simulated = 0;
  std::optional<Score> score = {};
  std::string verdict = {};
};

/// The time now, in UTC: 2026-01-31T23:59:59Z.
std::string utc_now();

class Journal {
 public:
  enum class Build { same, any };
  /// Opens it for writing, or creates it. Throws InputError if the file is not a journal, or belongs to another study (with the
  /// differences), or to another build, unless `any` is given, which is then noted in the journal. Throws RunError if it cannot
  /// be written.
  Journal(const std::filesystem::path& file, const JournalHead& head, Build build);
  /// Opens it for reading, also while another process writes. Throws InputError as above.
  explicit Journal(const std::filesystem::path& file);

  [[nodiscard]] const std::filesystem::path& file() const { return file_; }
  [[nodiscard]] const JournalHead& head() const { return head_; }
  [[nodiscard]] const RunColumns& columns() const { return columns_; }
  /// Column of a quantity by its name, or "".
  [[nodiscard]] std::string column_of(const std::string& quantity) const;
  /// Whether each run has a row.
  [[nodiscard]] std::vector<bool> present(std::uint64_t runs);
  /// Notes that the study has at least this number of runs.
  void expect(std::uint64_t runs);
  /// Writes all rows of a pack, or none. Throws RunError if it cannot be written; earlier rows remain.
  void write(std::span<const Row> rows, const Effort& effort);
  /// Replaces the rows of these runs.
  void replace(std::span<const Row> rows);
  /// Adds generations; existing ones remain.
  void write(std::span<const Generation> generations);
  /// Replaces all verifications.
  void write(std::span<const Verification> verifications);
  /// Ordered by search, then generation.
  [[nodiscard]] std::vector<Generation> generations();
  [[nodiscard]] std::vector<Verification> verifications();
  /// Counts a start of each run; the end of a run resets its count.
  void count_starts(std::span<const std::uint64_t> runs);
  /// Undoes these counts: the runs were stopped.
  void forget_starts(std::span<const std::uint64_t> runs);
  /// Number of starts of each run that never ended.
  [[nodiscard]] std::vector<std::pair<std::uint64_t, std::int64_t>> unfinished();

  /// Visits all runs in order.
  void each_brief(const std::function<void(const Brief&)>& take);
  /// Columns of one run as text, NULL as ""; empty: no row.
  [[nodiscard]] std::vector<std::string> row(std::uint64_t run);
  /// Quantities of one run as text, by column, NULL as "".
  [[nodiscard]] std::vector<std::string> quantities(std::uint64_t run);
  /// Visits columns of all runs in order, numbers as the shortest text that gives the same double, NULL as "".
  void each_row(const std::vector<std::string>& columns, const std::function<void(const std::vector<std::string>&)>& take);
  /// Visits columns of the runs that ended as numbers, NaN for unknown ones.
  void each_numbers(const std::vector<std::string>& columns, const std::function<void(std::span<const double>)>& take);
  /// Copies the rows of another journal of the same study that are missing here. Returns their number. Throws InputError if it
  /// belongs to another study.
  std::uint64_t take(Journal& other);
  [[nodiscard]] std::uint64_t rows();
  /// One more than the largest run number with a row.
  [[nodiscard]] std::uint64_t end();
  /// Total of all packs: runs and wall.
  [[nodiscard]] Effort effort();

 private:
  void create();
  void read_head();
  void compare(const JournalHead& head, Build build);
  void prepare();
  void bind(Statement& insert, const Row& row) const;

  std::filesystem::path file_;
  JournalHead head_;
  Database database_;
  RunColumns columns_;
  std::optional<Statement> insert_, insert_effort_, insert_start_, remove_start_;
};

/// File name of a journal in the folder of a study.
inline constexpr const char* kJournalFile = "study.db";

}  // namespace gaitlab::studies
