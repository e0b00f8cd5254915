// Texts and files of a study, printed and written during its runs and at its end.
#pragma once
#include <filesystem>
#include <string>

#include "core/files/atomic_file.h"
#include "studies/journal/results.h"

namespace gaitlab::app {

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

}  // namespace gaitlab::app
