#include "python/native/scenario.h"

#include <filesystem>
#include <system_error>
#include <utility>

#include "core/errors.h"
#include "core/scenario/resolved.h"
#include "core/simulation/simulation.h"
#include "core/simulation/start.h"
#include "kit/catalog.h"
#include "kit/run_time.h"
#include "kit/run_warnings.h"
#include "kit/shipped.h"
#include "python/native/apart.h"
#include "python/native/python_plugins.h"

namespace py = pybind11;

namespace gaitlab::python {

PluginTrust trust_of(const Trusted& trusted, const std::string& call) {
  PluginTrust trust{.all = trusted.all, .files = {}, .remedy = "if you trust it: " + call + "(..., plugins=\"trust\")"};
  for (const std::string& file : trusted.files) {
    std::error_code failure;
    trust.files.insert(std::filesystem::canonical(file, failure).string());
    if (failure) throw InputError(SourceLocation{"plugins: " + file}, "cannot be loaded: " + failure.message());
  }
  return trust;
}

std::shared_ptr<PyScenario> read_python(const std::string& file, const Texts& sets, const Trusted& trusted) {
  auto made = std::make_shared<PyScenario>();
  apart([&] {
    made->file = std::make_shared<ReadFile>(kit::standard_catalog());
    ReadFile& read = *made->file;
    read.path = kit::named_file(file);
    read.sets = sets;
    read.trusted = trusted;
    read.classes = register_classes(read.catalog);
    read.catalog.set_trust(trust_of(trusted, "Scenario"));
    read.common = std::make_unique<ScenarioTemplate>(read.path, sets, read.catalog);
    made->scenario = read.with({});
  });
  return made;
}

namespace {

/// All of a scenario but its CPG and controller, as text.
std::string without_classes(Scenario scenario) {
  scenario.cpg = {};
  scenario.controller = {};
  return resolved(scenario);
}

/// The file read again, with the classes that were registered meanwhile. Throws InputError if anything but its CPG or
/// controller has changed.
std::shared_ptr<ReadFile> read_again(ReadFile& before) {
  std::shared_ptr<ReadFile> read = read_python(before.path, before.sets, before.trusted)->file;
  apart([&] {
    if (without_classes(read->with({})) != without_classes(before.with({}))) {
      throw InputError(SourceLocation{before.path},
                       "has changed since the scenario was read, or a file that it names has changed; read the scenario again: "
                       "gaitlab.Scenario");
    }
  });
  return read;
}

}  // namespace

std::shared_ptr<PyScenario> with_sets(const PyScenario& scenario, const Texts& sets) {
  auto made = std::make_shared<PyScenario>(PyScenario{scenario.file, scenario.own, {}});
  made->own.insert(made->own.end(), sets.begin(), sets.end());
  if (made->file->classes != classes_added()) made->file = read_again(*scenario.file);
  apart([&] { made->scenario = made->file->with(made->own); });
  return made;
}

Texts warnings_of(const PyScenario& scenario, bool severe) {
  Texts all;
  apart([&] {
    if (!severe) {
      for (const Note& note : scenario.scenario.notes) all.push_back(to_string(note.place) + ": note: " + note.text);
    }
    for (const report::Warning& one : kit::start_warnings(scenario.scenario)) {
      if (one.severe == severe) all.push_back(to_string(one.place) + (severe ? ": warning: " : ": note: ") + one.text);
    }
  });
  return all;
}

py::dict check_of(const PyScenario& scenario) {
  const Scenario& s = scenario.scenario;
  const Robot& robot = *s.robot;
  RowsNeeded rows;
  double damping = 0;
  double seconds = 0;
  Vec3 start = Vec3::Zero();
  std::string fails;
  apart([&] {
    Simulation simulation({&s, 1});
    rows = simulation.rows_needed(0);
    damping = s.physics.step * simulation.standing().rate;
    start = start_state(s).position;
    seconds = kit::estimated_seconds(s, rows);
    fails = kit::early_failure(simulation, s);
  });
  py::dict masses;
  for (const Body& body : robot.bodies) masses[body.name.c_str()] = body.mass;
  py::dict ranges;
  for (const Joint& joint : robot.joints) ranges[joint.name.c_str()] = py::make_tuple(joint.lo, joint.hi);
  return py::dict(py::arg("name") = s.name, py::arg("mass") = robot.mass, py::arg("masses") = masses,
                  py::arg("ranges") = ranges, py::arg("modules") = robot.modules.size(), py::arg("links") = robot.links.size(),
                  py::arg("degrees_of_freedom") = robot.dof(s.base), py::arg("engine") = s.physics.engine->name,
                  py::arg("integrator") = s.physics.integrator->name, py::arg("step") = s.physics.step,
                  py::arg("damping") = damping, py::arg("start") = py::make_tuple(start.x(), start.y(), start.z()),
                  py::arg("contacts") = contact_elements(robot, s.contact.on).size(), py::arg("rows") = rows.rows,
                  py::arg("columns") = rows.columns, py::arg("megabytes") = rows.bytes() / 1e6, py::arg("seconds") = seconds,
                  py::arg("fails") = fails);
}

}  // namespace gaitlab::python
