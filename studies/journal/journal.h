// The journal of a study, study.db: an SQLite database with a row for each run that has ended.
#pragma once
#include <fmt/format.h>

#include <cstdint>
#include <filesystem>
#include <functional>
#include <limits>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "core/names.h"
#include "core/recording/word.h"
#include "core/settings/wording.h"
#include "studies/journal/database.h"
#include "studies/study/scorer.h"

namespace gaitlab::studies {

/// Result of a run. Its quantities are known only if the outcome is `done`.
struct Row {
  std::uint64_t run = 0;
  std::string point;     ///< name derived from the parameter values; a point has the same name in every study of the scenario
  std::string scenario;  ///< name of the scenario; empty if the study has a single scenario
  std::uint64_t replicate = 0;
  std::int64_t seed = 0;
  std::string outcome;              ///< one of done, diverged, stopped, refused, plugin, crashed
  std::string message;              ///< reason why the outcome is not `done`, or why the verdict is not `feasible`
  double simulated = 0;             ///< simulated time, s
  std::vector<std::string> values;  ///< values of the parameters, then of the random draws
  std::vector<double> quantities;   ///< quantities by column; empty if not known
  Word verdict = Word::failed;
  std::optional<Score> score = {};
  Cause cause = {};  ///< the check that decided the verdict; not stored in the journal
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
  std::string scenario;  ///< resolved text of the scenario; for several scenarios in the format of scenarios_text()
  std::vector<std::string> scenarios;  ///< names of the scenarios; empty if the study has a single scenario
  std::vector<JournalObjective> objectives;
  std::string combine = "worst";
  double quantile = 0.5;
  std::uint64_t runs = 0;        ///< number of runs of the study; 0 selects the number stored in the journal
  std::uint64_t replicates = 1;  ///< runs per point: replicates times scenarios
  std::int64_t seed = 1;
  std::vector<JournalParameter> parameters;
  std::vector<Quantity> quantities;
  std::vector<std::string> shown;  ///< names of the quantities that tables and figures show
  std::vector<Limit> limits;
  bool guarded = true;
  std::string method;                                  ///< name of the method, or `asked`
  bool told = false;                                   ///< true if another program gives the results
  double torque_error = Limits().most_torque_error();  ///< least Limits::most_torque_error() of the scenarios
  std::vector<std::string> worlds;  ///< names of the worlds of a robust study, one for each replicate from 1 on
};
/// Unit of a quantity of the study. Empty without a unit, and for other names, such as the expression of an objective.
std::string unit_of(const JournalHead& head, const std::string& name);

/// A generation of a search whose points have all ended.
struct Generation {
  std::uint64_t search = 0, generation = 0, restart = 0;
  std::uint64_t first_run = 0, runs = 0;  ///< first run and number of runs of the newly requested points
  std::uint64_t points = 0, kept = 0;
  /// Best and median of the kept points, by the first objective.
  double best = std::numeric_limits<double>::quiet_NaN(), median = best;
  double spread = 0;  ///< largest deviation of a coordinate, as a share of the range of its parameter
};

/// Kind of a further run of one of the best points.
enum class TrialKind { as_run, half_step, other_engine, quarter_step, limit, dead_joint, world, drawn_world, worlds };

}  // namespace gaitlab::studies

namespace gaitlab {

template <>
struct EnumNames<studies::TrialKind> {
  using enum studies::TrialKind;
  static constexpr EnumName<studies::TrialKind> kTable[] = {{as_run, "as run"},
                                                            {half_step, "half step"},
                                                            {other_engine, "other engine"},
                                                            {quarter_step, "quarter step"},
                                                            {limit, "limit"},
                                                            {dead_joint, "dead joint"},
                                                            {world, "world"},
                                                            {drawn_world, "drawn world"},
                                                            {worlds, "worlds"}};
};

}  // namespace gaitlab

namespace gaitlab::studies {

/// Result of another run of one of the best points, such as a run with half the step or in another engine.
struct Verification {
  std::uint64_t run = 0;  ///< first run of the point
  TrialKind kind = TrialKind::as_run;
  std::string name;  ///< the engine, joint or world; empty for the other kinds
  std::vector<double> objectives;
  double violation = 0;
  Word verdict = Word::failed;  ///< verdict of an infeasible replicate if there is one, else of the first replicate
  std::string reason;           ///< reason why the run does not verify the point; "" if the point is verified
  std::string check = {};       ///< id of the check that decided the verdict in a world where the point falls; "" if none did
  /// Kind and name: `half step`, `bullet at a quarter of its step`, `m3/active dead`, `world supply -10 % (6.66 V)`.
  [[nodiscard]] std::string what() const;
};

/// Effort of packs of runs. Only these data of a journal differ from machine to machine.
struct Effort {
  std::uint64_t first_run = 0, runs = 0;
  std::string started;  ///< start of the pack in UTC
  double wall = 0;      ///< elapsed time, s
  std::string host;
  std::int64_t process = 0;
};

/// Value of an enum by its name in a cell of the journal `file`. Messages call the value `what`. Throws InputError for other
/// texts.
template <NamedEnum Enum>
Enum named_cell(const std::string& text, const char* what, const std::filesystem::path& file) {
  if (const std::optional<Enum> found = named<Enum>(text)) return *found;
  const auto names = enum_names<Enum>();
  throw InputError(SourceLocation{file.string()},
                   fmt::format("has the {} '{}'{}", what, clipped(text),
                               offer(text, {names.begin(), names.end()}, what + std::string("s"))));
}

/// Name of the column of an objective: `objective.1` for number 0.
std::string objective_column(std::size_t number);
/// Index of a name, such as a column; the number of names if the list lacks it.
std::size_t place_in(const std::vector<std::string>& names, const std::string& name);

/// The SQL names of the columns of table `run`, in order.
struct RunColumns {
  explicit RunColumns(const JournalHead& head);
  std::vector<std::string> parameters, quantities, objectives;
  bool scenario = false;  ///< true if the table has a column `scenario`
  std::string sql;        ///< statement that creates the table
  [[nodiscard]] std::vector<std::string> all() const;
};

/// A run without its quantities.
struct Brief {
  std::uint64_t run = 0;
  std::string outcome = {}, message = {};
  double simulated = 0;
  std::optional<Score> score = {};
  Word verdict = Word::failed;
};

/// The present time in UTC, as in 2026-01-31T23:59:59Z.
std::string utc_now();

class Journal {
 public:
  enum class Build { same, any };
  /// Opens the journal for writing, or creates it. Throws InputError if the file is not a journal, or if it belongs to another
  /// study (the message lists the differences). Throws InputError also if another build wrote the journal, unless `build` is
  /// `any`; the journal then records both builds. Throws RunError if the file cannot be written.
  Journal(const std::filesystem::path& file, const JournalHead& head, Build build);
  /// Opens the journal for reading, also while another process writes. Throws InputError if the file is not a journal.
  explicit Journal(const std::filesystem::path& file);

  [[nodiscard]] const std::filesystem::path& file() const { return file_; }
  [[nodiscard]] const JournalHead& head() const { return head_; }
  [[nodiscard]] const RunColumns& columns() const { return columns_; }
  /// SQL column of a quantity, or "" if the journal lacks the quantity.
  [[nodiscard]] std::string column_of(const std::string& quantity) const;
  /// Flag for each run number below `runs`: true if the run has a row.
  [[nodiscard]] std::vector<bool> present(std::uint64_t runs);
  /// Raises the number of runs in the journal to at least `runs`.
  void expect(std::uint64_t runs);
  /// Writes all rows of a pack, or none of them. Throws RunError if the journal cannot be written; earlier rows remain.
  void write(std::span<const Row> rows, const Effort& effort);
  /// Replaces the rows of these runs by the given ones.
  void replace(std::span<const Row> rows);
  /// Adds the generations that the journal does not contain yet.
  void write(std::span<const Generation> generations);
  /// Replaces all verifications in the journal.
  void write(std::span<const Verification> verifications);
  /// All generations, ordered by search, then by generation.
  [[nodiscard]] std::vector<Generation> generations();
  [[nodiscard]] std::vector<Verification> verifications();
  /// Adds 1 to the number of starts of each run. When a run ends, its number returns to 0.
  void count_starts(std::span<const std::uint64_t> runs);
  /// Removes the counted starts of runs that were stopped on purpose.
  void forget_starts(std::span<const std::uint64_t> runs);
  /// Runs that started but never ended, with their number of starts.
  [[nodiscard]] std::vector<std::pair<std::uint64_t, std::int64_t>> unfinished();

  /// Visits all runs in the order of their numbers.
  void each_brief(const std::function<void(const Brief&)>& take);
  /// Columns of one run as text, with NULL as "". Empty if the run has no row.
  [[nodiscard]] std::vector<std::string> row(std::uint64_t run);
  /// Quantities of one run as text by column, with NULL as "".
  [[nodiscard]] std::vector<std::string> quantities(std::uint64_t run);
  /// Visits the given columns of all runs in order. Numbers are the shortest text that gives the same double; NULL is "".
  void each_row(const std::vector<std::string>& columns, const std::function<void(const std::vector<std::string>&)>& take);
  /// Visits the given columns of the runs with outcome `done`, as numbers. An unknown number is NaN.
  void each_numbers(const std::vector<std::string>& columns, const std::function<void(std::span<const double>)>& take);
  /// Copies from another journal of the same study the rows that this journal lacks. Returns the number of copied rows. Throws
  /// InputError if the other journal belongs to another study.
  std::uint64_t take(Journal& other);
  [[nodiscard]] std::uint64_t rows();
  /// Largest run number with a row, plus 1.
  [[nodiscard]] std::uint64_t end();
  /// Total number of runs, and total elapsed time, of all packs.
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
