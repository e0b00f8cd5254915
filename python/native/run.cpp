#include "python/native/run.h"

#include <pybind11/numpy.h>

#include <atomic>
#include <chrono>
#include <functional>
#include <new>
#include <utility>

#include "core/errors.h"
#include "core/recording/run_folder.h"
#include "core/simulation/simulation.h"
#include "kit/catalog.h"
#include "kit/judged_run.h"
#include "kit/run_warnings.h"
#include "kit/run_writer.h"
#include "python/native/apart.h"
#include "python/native/python_plugins.h"
#include "report/analysis/cpg_alone.h"
#include "report/figures/paper/run_figure.h"
#include "report/page/page.h"
#include "report/verdict/spread.h"

namespace py = pybind11;

namespace gaitlab::python {

namespace {

/// Simulates the rollouts that show the spread of a motion that is not predictable. If memory is short or a plugin throws, the
/// run is left without them, as in the program.
void add_spread(PyRun& run, std::atomic<bool>& stop) try {
  if (!kit::needs_spread(run.scenario, run.recording)) return;
  const report::Verdict own =
      report::verdict(run.scenario, run.recording, run.summary, report::overlaps(run.scenario, run.recording));
  run.recording.spread = report::spread(run.scenario, run.recording, run.summary, own, stop);
} catch (const std::bad_alloc&) {  // NOLINT(bugprone-empty-catch)
} catch (const PluginError&) {     // NOLINT(bugprone-empty-catch)
}

void judge_run(PyRun& run, double wall, std::atomic<bool>& stop) {
  const report::StopsCpgAlone stops(stop);  // a stopped run is not returned
  try {
    run.all = thin_rows(run.recording);
  } catch (const std::bad_alloc&) {  // NOLINT(bugprone-empty-catch): the rows stay as they are
  }
  run.seen = kit::with_row_stride(run.scenario, run.all ? run.all->stride : 1);
  run.summary = report::summarise(run.seen, run.recording, wall);
  if (!stop) add_spread(run, stop);
  run.overlaps = report::overlaps(run.seen, run.recording);
  run.verdict = report::verdict(run.seen, run.recording, run.summary, run.overlaps);
}

/// Moves an error of the folder from an option of the program to the argument of save().
[[noreturn]] void raise_of_save(const InputError& error) {
  constexpr std::string_view kOption = "--out ";
  std::vector<Problem> problems = error.problems();
  for (Problem& one : problems) {
    if (one.place.file.starts_with(kOption)) one.place.file = "save: " + one.place.file.substr(kOption.size());
  }
  throw InputError(std::move(problems));
}

}  // namespace

std::shared_ptr<PyRun> simulate_run(const PyScenario& scenario, const py::object& progress, bool loads) {
  auto run = std::make_shared<PyRun>();
  run->file = scenario.file;
  run->scenario = scenario.scenario;
  std::atomic<bool> stop = false;
  std::atomic<double> share = 0;
  std::function<void()> told;
  if (!progress.is_none()) told = [&] { progress(share.load()); };
  apart(stop, told, [&] {
    const auto start = std::chrono::steady_clock::now();
    Simulation simulation({&run->scenario, 1}, loads ? Loads::recorded : Loads::judged);
    std::optional<Outcome> early;
    try {
      simulation.run([&](double done) { share = done; }, &stop);
    } catch (const SimulationError& error) {
      early = error.outcome();
    }
    const std::chrono::duration<double> wall = std::chrono::steady_clock::now() - start;
    if (stop) return;
    run->recording = simulation.take_recording(0);
    if (early) run->recording.outcome = std::move(*early);
    judge_run(*run, wall.count(), stop);
  });
  if (told) told();
  return run;
}

std::shared_ptr<PyRun> read_run_folder(const std::string& folder, const Trusted& trusted) {
  auto run = std::make_shared<PyRun>();
  apart([&] {
    run->file = std::make_shared<ReadFile>(kit::standard_catalog());
    register_classes(run->file->catalog);
    run->file->catalog.set_trust(trust_of(trusted, "read"));
    kit::JudgedRun read = kit::read_judged(folder, run->file->catalog);
    read.keep_second_runs();
    read.keep_remedy();
    run->seen = read.read.scenario;
    run->scenario = std::move(read.read.scenario);
    run->scenario.trace.period = read.period;
    run->recording = std::move(read.read.stored.recording);
    run->missing = std::move(read.read.stored.missing);
    run->all = std::move(read.all);
    run->summary = std::move(read.summary);
    run->overlaps = read.overlaps;
    run->verdict = std::move(read.verdict);
    run->folder = folder;
  });
  return run;
}

py::dict table_of(const std::shared_ptr<PyRun>& run, const std::string& name) {
  const Trace& table = name == "trace"   ? run->trace()
                       : name == "ticks" ? run->recording.ticks
                       : name == "loads" ? run->recording.loads
                                         : run->recording.poses;
  const auto rows = static_cast<py::ssize_t>(table.rows());
  const auto columns = static_cast<py::ssize_t>(table.columns.size());
  constexpr py::ssize_t kDouble = sizeof(double);
  const py::capsule owner(new std::shared_ptr<PyRun>(run),
                          [](void* held) { delete static_cast<std::shared_ptr<PyRun>*>(held); });
  py::array_t<double> values({rows, columns}, {kDouble * columns, kDouble}, table.values.data(), owner);
  values.attr("setflags")(py::arg("write") = false);
  py::list names;
  py::list units;
  py::list definitions;
  for (std::size_t k = 0; k < table.columns.size(); ++k) {
    const Column& column = table.columns[k];
    names.append(column.name);
    units.append(column.unit);
    definitions.append(column.definition);
  }
  return py::dict(py::arg("values") = values, py::arg("names") = names, py::arg("units") = units,
                  py::arg("definitions") = definitions);
}

Texts warnings_of_run(const PyRun& run) {
  Texts all;
  apart([&] {
    for (const std::string& sentence : run.missing) all.push_back(run.folder.string() + ": note: " + sentence);
    for (const report::Warning& one : kit::run_warnings(run.seen, run.recording, run.verdict))
      all.push_back(to_string(one.place) + ": warning: " + one.text);
  });
  return all;
}

std::string page_of(PyRun& run) {
  std::string text;
  apart([&] {
    const std::lock_guard lock(run.one_at_a_time);
    text = report::page(report::page_data(run.seen, run.recording, run.summary, run.verdict, run.missing));
  });
  return text;
}

std::string figure_of(PyRun& run) {
  std::string text;
  apart([&] {
    const std::lock_guard lock(run.one_at_a_time);
    text = report::run_figure(run.seen, run.recording, run.summary);
  });
  return text;
}

std::string save_run(PyRun& run, const std::optional<std::string>& out) {
  if (!run.folder.empty()) throw RunError("the run was read from " + run.folder.string() + "; copy that folder");
  Texts lost;
  std::string path;
  apart([&] {
    const std::lock_guard lock(run.one_at_a_time);
    try {
      RunFolder folder(out ? std::optional<std::filesystem::path>(*out) : std::nullopt, run.scenario.name);
      path = folder.path().string();
      kit::RunWriter files(folder.path(), [&](const std::string& why) { lost.push_back(why); });
      if (run.all) run.all->swap(run.recording);
      files.write_run("h5", run.scenario, run.recording);
      if (run.all) run.all->swap(run.recording);
      files.write_report(run.seen, run.recording, run.summary, run.verdict, true);
      if (files.wrote_any()) folder.keep();
    } catch (const InputError& error) {
      raise_of_save(error);
    }
  });
  std::string all;
  for (const std::string& why : lost) all += (all.empty() ? "" : "; ") + why;
  if (!all.empty()) throw RunError(all);
  return path;
}

}  // namespace gaitlab::python
