// Texts and files of a study, during its runs and at its end.
#pragma once
#include <chrono>
#include <deque>
#include <filesystem>
#include <string>

#include "core/files/atomic_file.h"
#include "studies/journal/results.h"
#include "studies/run/runner.h"
#include "studies/search/optimizer.h"

namespace gaitlab::app {

/// `speed` in m/s and so on: the objective, with the unit if it is a single quantity.
std::string objective_text(const studies::JournalHead& head);
/// ` m/s`, or nothing.
std::string objective_unit(const studies::JournalHead& head);

/// State, best and worst points, failures, and the command that repeats a run. `folder`: as the user would type it. `most`
/// points at either end.
std::string study_summary(studies::Journal& journal, const studies::Results& results, const std::filesystem::path& folder,
                          std::size_t most);

/// A table of these points.
std::string points_table(studies::Journal& journal, const studies::Results& results, const std::vector<std::size_t>& order,
                         std::size_t most);

/// Writes all runs, a line each, in order: the columns of table `run`. The file appears whole or not at all.
void write_table(studies::Journal& journal, const std::filesystem::path& file, Existing existing = Existing::replaced);

/// Writes table.csv, and the figures with their data. Returns the names of the files.
std::vector<std::string> write_study_files(studies::Journal& journal, const studies::Results& results,
                                           const std::filesystem::path& folder);

/// Writes convergence.svg of a search and front.svg of several objectives, each with its data. Returns the names of the
/// figures.
std::vector<std::string> write_search_files(studies::Journal& journal, const studies::Results& results,
                                            const std::filesystem::path& folder);

/// A line below a figure: number of runs, guards, build.
std::string study_note(const studies::JournalHead& head, std::uint64_t runs);

/// The verified ones among the best points, and the reasons against the others; empty: nothing was verified.
std::string verification_text(studies::Journal& journal);

/// A bar on a terminal, a line every 30 s elsewhere.
class StudyProgress {
 public:
  StudyProgress(bool quiet, std::string unit);
  ~StudyProgress();
  StudyProgress(const StudyProgress&) = delete;
  StudyProgress& operator=(const StudyProgress&) = delete;
  void operator()(const studies::Standing& standing);
  /// Called before each generation of a search.
  void operator()(const studies::SearchPlace& place);

 private:
  using Time = std::chrono::steady_clock::time_point;
  /// Runs per s over the last minute, 0: not known yet.
  double rate(Time now, std::uint64_t ended);

  bool shown_, terminal_;
  std::string unit_, place_;
  std::deque<std::pair<Time, std::uint64_t>> minute_;  ///< number of ended runs at these times
  Time last_{};
};

/// Progress of repeated runs, in a line of a terminal.
class AgainProgress {
 public:
  explicit AgainProgress(bool quiet);
  void operator()(std::size_t done, std::size_t of) const;

 private:
  bool shown_;
};

/// Cell of a table: in quotes if it contains commas, quotes or line ends.
std::string csv_cell(const std::string& text);

/// File name from the name of a quantity: letters, digits, `.`, `_` and `-`.
std::string file_name(const std::string& figure);

/// One argument of a command line, in quotes if a shell needs them.
std::string shell_word(const std::string& word);

}  // namespace gaitlab::app
