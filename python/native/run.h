// Runs as Python holds them: simulated, or read from a folder.
#pragma once
#include <pybind11/pybind11.h>

#include <filesystem>
#include <memory>
#include <mutex>
#include <optional>
#include <string>

#include "core/recording/recording.h"
#include "python/native/scenario.h"
#include "report/analysis/collisions.h"
#include "report/verdict/verdict.h"

namespace gaitlab::python {

struct PyRun {
  std::shared_ptr<ReadFile> file;  ///< destroyed after the scenario
  Scenario scenario;               ///< as it was run
  Scenario seen;                   ///< with the trace period of the kept rows
  Recording recording;             ///< with the kept rows
  std::optional<AllRows> all;      ///< all rows, if some are not kept
  report::Summary summary;
  report::Overlaps overlaps;
  report::Verdict verdict;
  std::vector<std::string> missing = {};  ///< sentences on missing parts of the folder
  std::filesystem::path folder = {};      ///< folder that the run was read from; empty if it was simulated here
  std::mutex one_at_a_time = {};          ///< locked while a file is written, because that needs all rows

  [[nodiscard]] const Trace& trace() const { return all ? all->trace : recording.trace; }
};

/// Simulates the scenario as `gaitlab run` does, and judges the run. `progress` is None or is called with the share that is
/// done.
std::shared_ptr<PyRun> simulate_run(const PyScenario& scenario, const pybind11::object& progress, bool loads);
std::shared_ptr<PyRun> read_run_folder(const std::string& folder, const Trusted& trusted);

/// A table of the run as a dict of names, units, definitions and values. The values are an array that shares the run's memory
/// and keeps the run alive.
pybind11::dict table_of(const std::shared_ptr<PyRun>& run, const std::string& table);
Texts warnings_of_run(const PyRun& run);
std::string page_of(PyRun& run);
std::string figure_of(PyRun& run);
/// Writes the files of `gaitlab run` into `folder`, or into runs/NAME. Returns the folder.
std::string save_run(PyRun& run, const std::optional<std::string>& folder);

}  // namespace gaitlab::python
