// The module _native, which the package gaitlab calls. Its stub is python/gaitlab/_native.pyi.
#include <pybind11/pybind11.h>
#include <pybind11/stl.h>

#include <exception>
#include <utility>

#include "core/build_id.h"
#include "core/errors.h"
#include "core/scenario/resolved.h"
#include "core/scenario/sensor_section.h"
#include "core/simulation/batch_limits.h"
#include "python/native/apart.h"
#include "python/native/episodes.h"
#include "python/native/python_plugins.h"
#include "python/native/rollouts.h"
#include "python/native/run.h"
#include "python/native/scenario.h"
#include "report/verdict/numbers/summary_text.h"

namespace py = pybind11;

namespace gaitlab::python {

namespace {

void add_errors(py::module_& m) {
  static const py::exception<InputError> input_error(m, "InputError", PyExc_ValueError);
  static const py::exception<RunError> run_error(m, "RunError", PyExc_RuntimeError);
  // NOLINTNEXTLINE(performance-unnecessary-value-param): the type that pybind11 takes
  py::register_exception_translator([](std::exception_ptr thrown) {
    try {
      if (thrown) std::rethrow_exception(thrown);
    } catch (const InputError& error) {
      const py::object raised = py::reinterpret_borrow<py::object>(input_error)(error.what());
      py::list problems;
      for (const Problem& one : error.problems())
        problems.append(py::make_tuple(one.place.file, one.place.line, one.place.column, one.text));
      raised.attr("problems") = problems;
      PyErr_SetObject(input_error.ptr(), raised.ptr());
    } catch (const RunError& error) {
      PyErr_SetString(run_error.ptr(), error.what());
    }
  });
}

py::list legs_of_scenario(const PyScenario& s) {
  py::list legs;
  for (const Leg& leg : plugin_info(s.scenario).legs) {
    py::list joints;
    for (const std::int64_t joint : leg.joints) joints.append(s.scenario.robot->joints[static_cast<std::size_t>(joint)].name);
    legs.append(py::make_tuple(leg.name, joints, leg.side, py::make_tuple(leg.hip[0], leg.hip[1], leg.hip[2]),
                               py::make_tuple(leg.foot[0], leg.foot[1], leg.foot[2])));
  }
  return legs;
}

void add_scenario_class(py::module_& m) {
  py::class_<PyScenario, std::shared_ptr<PyScenario>>(m, "Scenario")
      .def_property_readonly("name", [](const PyScenario& s) { return s.scenario.name; })
      .def_property_readonly("joints",
                             [](const PyScenario& s) {
                               py::list joints;
                               for (const Joint& joint : s.scenario.robot->joints) joints.append(joint.name);
                               return joints;
                             })
      .def("legs", &legs_of_scenario)
      .def("resolved", [](const PyScenario& s) { return resolved(s.scenario); })
      .def("warnings", &warnings_of, py::arg("severe"))
      .def("check", &check_of)
      .def("with_", &with_sets, py::arg("settings"));
  m.def(
      "read",
      [](const std::string& file, const Texts& settings, bool all, const Texts& plugins) {
        return read_python(file, settings, {all, plugins});
      },
      py::arg("path"), py::arg("settings"), py::arg("all_plugins"), py::arg("plugins"));
}

void add_run_class(py::module_& m) {
  py::class_<PyRun, std::shared_ptr<PyRun>>(m, "Run")
      .def_property_readonly("outcome", [](const PyRun& r) { return r.recording.outcome.text(); })
      .def_property_readonly("ended", [](const PyRun& r) { return std::string(name_of(r.recording.outcome.ended)); })
      .def_property_readonly("name", [](const PyRun& r) { return r.scenario.name; })
      .def("resolved", [](const PyRun& r) { return resolved(r.scenario); })
      .def("summary", [](const PyRun& r) { return report::to_json(r.summary, r.seen, r.recording); })
      .def("verdict", [](const PyRun& r) { return report::to_json(r.verdict); })
      .def("warnings", &warnings_of_run)
      .def("table", &table_of, py::arg("name"))
      .def("page", &page_of)
      .def("figure", &figure_of)
      .def("save", &save_run, py::arg("folder"));
  m.def("simulate", &simulate_run, py::arg("scenario"), py::arg("progress"), py::arg("loads"));
  m.def(
      "read_run",
      [](const std::string& folder, bool all, const Texts& plugins) {
        return read_run_folder(folder, {all, plugins});
      },
      py::arg("folder"), py::arg("all_plugins"), py::arg("plugins"));
}

void add_functions(py::module_& m) {
  m.def(
      "rollouts",
      [](const PyScenario& scenario, const std::vector<Texts>& overrides, const Texts& quantities, int threads,
         std::size_t lanes, std::size_t estimate_every, const py::object& progress) {
        return roll_out(scenario, overrides, quantities, {threads, lanes, estimate_every}, progress);
      },
      py::arg("scenario"), py::arg("overrides"), py::arg("quantities"), py::arg("threads"), py::arg("lanes"),
      py::arg("estimate_every"), py::arg("progress"));
  m.def("quantities", &quantity_texts, py::arg("of_joints"));
  m.def(
      "add_class",
      [](const std::string& kind, const std::string& name, const std::string& unit, const py::object& type,
         const std::vector<std::tuple<std::string, double, std::string, double, double, std::string>>& settings) {
        std::vector<NumberSetting> numbers;
        for (const auto& [key, value, unit, low, high, about] : settings)
          numbers.push_back({key, unit, about, value, low, high});
        add_class(kind == "cpg" ? Kind::cpg : Kind::controller, name, unit, type, std::move(numbers));
      },
      py::arg("kind"), py::arg("name"), py::arg("unit"), py::arg("type"), py::arg("settings"));
  m.def("take_said", &take_said);
}

}  // namespace

}  // namespace gaitlab::python

PYBIND11_MODULE(_native, m) {
  namespace native = gaitlab::python;
  m.attr("build") = gaitlab::build_id();
  m.attr("most_threads") = gaitlab::kMostThreads;
  m.attr("most_lanes") = gaitlab::kMostLanesAsked;
  native::end_with_interpreter();
  native::gather_said();
  native::share_h5();
  native::add_errors(m);
  native::add_scenario_class(m);
  native::add_run_class(m);
  native::add_episodes(m);
  native::add_functions(m);
}
