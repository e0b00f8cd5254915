// Texts and files of a study, printed and written during its runs and at its end.
#pragma once
#include <chrono>
#include <deque>
#include <filesystem>
#include <memory>
#include <string>
#include <utility>

#include "app/progress.h"
#include "core/files/atomic_file.h"
#include "studies/journal/results.h"
#include "studies/run/runner.h"
#include "studies/search/optimizer.h"

namespace gaitlab::app {

/// First objective with its unit, if it is a single quantity: `speed, m/s`.
std::string objective_text(const studies::JournalHead& head);
/// Unit of the first objective after a space: ` m/s`. Empty if it has none.
std::string objective_unit(const studies::JournalHead& head);

/// Summary of a study: counts of runs, best and worst points, failures, and the command that repeats a run. `folder` is the
/// path as the user would type it. `most` is the number of best points and of worst points.
std::string study_summary(studies::Journal& journal, const studies::Results& results, const std::filesystem::path& folder,
                          std::size_t most);

/// A table of the first `most` points in `order`.
std::string points_table(studies::Journal& journal, const studies::Results& results, const std::vector<std::size_t>& order,
                         std::size_t most);

/// Writes all columns of table `run` as CSV, with one line per run, in the order of the runs. The file appears complete or not
/// at all.
void write_table(studies::Journal& journal, const std::filesystem::path& file, Existing existing = Existing::replaced);

/// Writes table.csv, and the figures with their data. Returns the file names.
std::vector<std::string> write_study_files(studies::Journal& journal, const studies::Results& results,
                                           const std::filesystem::path& folder);

/// Writes convergence.svg for a search and front.svg for several objectives, each with a file of its data. Returns the names of
/// the figures.
std::vector<std::string> write_search_files(studies::Journal& journal, const studies::Results& results,
                                            const std::filesystem::path& folder);

/// Text below a figure: number of runs, guards, build.
std::string study_note(const studies::JournalHead& head, std::uint64_t runs);

/// Progress of a study.
class StudyProgress {
 public:
  StudyProgress(bool quiet, std::string unit) : line_(quiet), unit_(std::move(unit)) {}
  void operator()(const studies::Standing& standing);
  /// Called before each generation of a search.
  void operator()(const studies::SearchPlace& place);

 private:
  using Time = std::chrono::steady_clock::time_point;
  /// Rate in runs per s over the last minute. 0 if not known yet.
  double rate(Time now, std::uint64_t ended);

  ProgressLine line_;
  std::string unit_, place_;
  std::deque<std::pair<Time, std::uint64_t>> minute_;  ///< number of completed runs at these times
};

/// Progress of a known number of runs. Calls from several threads at once are allowed. Copies continue the same line, because
/// functions that execute runs take their progress by value.
class AgainProgress {
 public:
  /// `what` states the purpose of the runs, as in `verification`.
  AgainProgress(bool quiet, std::string what);
  /// With `done` 0 a line states the purpose and the number of the runs.
  void operator()(std::size_t done, std::size_t of);
  /// Counts further runs that have ended.
  void add(std::size_t runs, std::size_t of);

 private:
  struct Line;
  void show(std::size_t done, std::size_t of);

  std::shared_ptr<Line> line_;
  std::string what_;
};

/// Text as a cell of a CSV table, in quotes if it contains commas, quotes or line ends.
std::string csv_cell(const std::string& text);

/// Name of a quantity as a file name: characters other than letters, digits, `.`, `_` and `-` become `-`.
std::string file_name(const std::string& figure);

/// A word as one argument of a command line, in quotes if the shell requires them.
std::string shell_word(const std::string& word);

}  // namespace gaitlab::app
