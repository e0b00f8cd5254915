// What is printed and written of a study, while it runs and at its end.
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

/// `speed` in m/s and so on: the objective, with the unit where it is one figure.
std::string objective_text(const studies::JournalHead& head);
/// ` m/s`, or nothing.
std::string objective_unit(const studies::JournalHead& head);

/// State, best and worst points, what failed, how to repeat a run. `folder`: as the user would type it. `most` points at either
/// end.
std::string study_summary(studies::Journal& journal, const studies::Results& results, const std::filesystem::path& folder,
                          std::size_t most);

/// A table of these points.
std::string points_table(studies::Journal& journal, const studies::Results& results, const std::vector<std::size_t>& order,
                         std::size_t most);

/// All runs, a line each, in their order: the columns of table `run`. Appears whole or not at all.
void write_table(studies::Journal& journal, const std::filesystem::path& file, Existing existing = Existing::replaced);

/// table.csv, and the figures with the data they draw. Returns the names of the files.
std::vector<std::string> write_study_files(studies::Journal& journal, const studies::Results& results,
                                           const std::filesystem::path& folder);

/// convergence.svg of a search, front.svg of several objectives, each with the data it draws. Returns the names of the figures.
std::vector<std::string> write_search_files(studies::Journal& journal, const studies::Results& results,
                                            const std::filesystem::path& folder);

/// A line below a figure: how many runs, which guards, which build.
std::string study_note(const studies::JournalHead& head, std::uint64_t runs);

/// Which of the best points stood, and why the others did not; empty: nothing was verified.
std::string verification_text(studies::Journal& journal);

/// A bar on a terminal, a line every 30 s elsewhere.
class StudyProgress {
 public:
  StudyProgress(bool quiet, std::string unit);
  ~StudyProgress();
  StudyProgress(const StudyProgress&) = delete;
  StudyProgress& operator=(const StudyProgress&) = delete;
  void operator()(const studies::Standing& standing);
  /// Before each generation of a search.
  void operator()(const studies::SearchPlace& place);

 private:
  using Time = std::chrono::steady_clock::time_point;
  /// Runs per s over the last minute, 0: not known yet.
  double rate(Time now, std::uint64_t ended);

  bool shown_, terminal_;
  std::string unit_, place_;
  std::deque<std::pair<Time, std::uint64_t>> minute_;  ///< when so many runs had ended
  Time last_{};
};

/// Of a table: in quotes where it holds commas, quotes or line ends.
std::string csv_cell(const std::string& text);

/// A figure's name as that of a file: letters, digits, `.`, `_` and `-`.
std::string file_name(const std::string& figure);

/// One argument of a command line, in quotes where a shell would need them.
std::string shell_word(const std::string& word);

}  // namespace gaitlab::app
