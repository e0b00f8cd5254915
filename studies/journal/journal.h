// The journal of a study, study.db: a row for each run that has ended. SQLite, which many programs read.
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

/// How a run ended. Where it did not end well, its quantities are not known.
struct Row {
  std::uint64_t run = 0;
  std::string point;     ///< name of its values, the same in every study of the scenario
  std::string scenario;  ///< its name; empty: the study has one
  std::uint64_t replicate = 0;
  std::int64_t seed = 0;
  std::string outcome;              ///< done, diverged, refused, plugin
  std::string message;              ///< why it is not `done`, or its verdict not `feasible`
  double simulated = 0;             ///< s
  std::vector<std::string> values;  ///< of the parameters, then what is drawn
  std::vector<double> quantities;   ///< by column; none: not known
  std::string verdict;
  std::optional<Score> score = {};
};

/// A parameter, or a key that is drawn for every replicate, as the journal knows it.
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

/// What a journal says of its study.
struct JournalHead {
  std::string name, build, definition, command;
  std::string scenario;                ///< resolved; of several as in scenario_texts
  std::vector<std::string> scenarios;  ///< names; none: there is one
  std::vector<JournalObjective> objectives;
  std::string combine = "worst";
  double quantile = 0.5;
  std::uint64_t runs = 0;        ///< 0: as many as the journal says
  std::uint64_t replicates = 1;  ///< runs of a point, in all scenarios
  std::int64_t seed = 1;
  std::vector<JournalParameter> parameters;
  std::vector<Quantity> quantities;
  std::vector<std::string> shown;  ///< names of quantities
  std::vector<Limit> limits;
  bool guarded = true;
};

/// A generation of a search, all of whose points have come to their end.
struct Generation {
  std::uint64_t search = 0, generation = 0, restart = 0;
  std::uint64_t first_run = 0, runs = 0;  ///< of points that were not asked for before
  std::uint64_t points = 0, kept = 0;
  double best = std::numeric_limits<double>::quiet_NaN(), median = best;  ///< of the kept points, by the first objective
  double spread = 0;  ///< largest deviation of a coordinate, as a share of the box
};

/// A point of the best, tried again in another way.
struct Verification {
  std::uint64_t run = 0;  ///< first of the point
  std::string what;       ///< half step, bullet
  std::vector<double> objectives;
  double violation = 0;
  std::string verdict;  ///< of the first replicate that is infeasible, or of the first
  std::string reason;   ///< why it is not verified, or ""
};

/// Of the packs that ran: all that differs from machine to machine.
struct Effort {
  std::uint64_t first_run = 0, runs = 0;
  std::string started;  ///< UTC
  double wall = 0;      ///< s
  std::string host;
  std::int64_t process = 0;
};

/// `objective.1` of the first.
std::string objective_column(std::size_t number);

/// The columns of table `run` in their order, as SQL knows them.
struct RunColumns {
  explicit RunColumns(const JournalHead& head);
  std::vector<std::string> parameters, quantities, objectives;
  bool scenario = false;  ///< whether there is a column of that name
  /// Whether a run is kept: `kept`; `feasible` in journals of programs that had no quantity of that name.
  std::string kept;
  std::string sql;  ///< that makes the table
  [[nodiscard]] std::vector<std::string> all() const;
};

/// What is known of a run without its quantities.
struct Brief {
  std::uint64_t run = 0;
  std::string outcome, message;
  double simulated = 0;
  std::optional<Score> score = {};
  std::string verdict = {};
};

class Journal {
 public:
  enum class Build { same, any };
  /// Opens it for writing, or makes it. InputError: the file is not a journal, or that of another study (the message tells what
  /// has changed); of another build, unless `any` is taken, which the journal then notes. RunError: it cannot be written.
  Journal(const std::filesystem::path& file, const JournalHead& head, Build build);
  /// Opens it to be read: also while another process writes. InputError as above.
  explicit Journal(const std::filesystem::path& file);

  [[nodiscard]] const std::filesystem::path& file() const { return file_; }
  [[nodiscard]] const JournalHead& head() const { return head_; }
  [[nodiscard]] const RunColumns& columns() const { return columns_; }
  /// Whether each run has a row.
  [[nodiscard]] std::vector<bool> present(std::uint64_t runs);
  /// Says that the study has at least so many runs.
  void expect(std::uint64_t runs);
  /// All of a pack, or nothing. RunError: it cannot be written; what was written before stays.
  void write(std::span<const Row> rows, const Effort& effort);
  /// Those that it has stay.
  void write(std::span<const Generation> generations);
  /// Takes the place of what was verified before.
  void write(std::span<const Verification> verifications);
  /// By search, then generation.
  [[nodiscard]] std::vector<Generation> generations();
  [[nodiscard]] std::vector<Verification> verifications();
  /// Counts a start of each run; an end takes the count away.
  void count_starts(std::span<const std::uint64_t> runs);
  /// Takes these counts away: the runs were stopped.
  void forget_starts(std::span<const std::uint64_t> runs);
  /// How often each run was begun that never ended.
  [[nodiscard]] std::vector<std::pair<std::uint64_t, std::int64_t>> unfinished();

  /// In the order of runs.
  void each_brief(const std::function<void(const Brief&)>& take);
  /// Columns of one run as text, NULL as ""; empty: it has no row.
  [[nodiscard]] std::vector<std::string> row(std::uint64_t run);
  /// Quantities of one run as text, by column, NULL as "".
  [[nodiscard]] std::vector<std::string> quantities(std::uint64_t run);
  /// Columns of all runs in their order, numbers as the shortest text that gives the same double, NULL as "".
  void each_row(const std::vector<std::string>& columns, const std::function<void(const std::vector<std::string>&)>& take);
  /// Of the runs that came to their end, as numbers, not a number where one is not known.
  void each_numbers(const std::vector<std::string>& columns, const std::function<void(std::span<const double>)>& take);
  /// Takes the rows of another journal of the same study that are not here. Returns how many there are. InputError: another
  /// study.
  std::uint64_t take(Journal& other);
  [[nodiscard]] std::uint64_t rows();
  /// One more than the largest number of a run that has a row.
  [[nodiscard]] std::uint64_t end();
  /// Of all packs together: runs and wall.
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

/// What a journal is called in the folder of a study.
inline constexpr const char* kJournalFile = "study.db";

}  // namespace gaitlab::studies
