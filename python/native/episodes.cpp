#include "python/native/episodes.h"

#include <fmt/format.h>
#include <pybind11/numpy.h>
#include <pybind11/stl.h>

#include <algorithm>
#include <cfenv>
#include <memory>
#include <mutex>
#include <utility>

#include "core/errors.h"
#include "core/scenario/other_engine.h"
#include "core/scenario/sections.h"
#include "kit/episodes.h"
#include "kit/recorded_settings.h"
#include "python/native/apart.h"
#include "python/native/run.h"
#include "python/native/scenario.h"

namespace py = pybind11;

namespace gaitlab::python {

namespace {

using Numbers = py::array_t<double, py::array::c_style | py::array::forcecast>;

/// The floating-point environment that a program starts with, because some Python packages make the processor flush subnormal
/// numbers to zero. Threads that start meanwhile have it too.
class UsualArithmetic {
 public:
  UsualArithmetic() {
    std::fegetenv(&before_);
    std::fesetenv(FE_DFL_ENV);
  }
  ~UsualArithmetic() { std::fesetenv(&before_); }
  UsualArithmetic(const UsualArithmetic&) = delete;
  UsualArithmetic& operator=(const UsualArithmetic&) = delete;

 private:
  std::fenv_t before_{};
};

struct PyEpisodes {
  std::shared_ptr<ReadFile> file;  ///< destroyed after the scenarios
  std::vector<Texts> own;          ///< settings of each environment in addition to those of `file`, without those of `fast`
  bool fast = false;
  std::unique_ptr<kit::Episodes> all;
  std::mutex one_at_a_time = {};  ///< guards `all` against other threads of Python; taken without the interpreter's lock
};

/// Works on the environments without the interpreter's lock.
template <class Work>
auto apart_from_python(PyEpisodes& episodes, Work work) {
  const py::gil_scoped_release released;
  const std::lock_guard lock(episodes.one_at_a_time);
  const UsualArithmetic usual;
  return work(*episodes.all);
}

/// Settings that make a scenario fast to step: engine articulated with implicit steps of at most 2.5 ms that fill a control
/// period.
Texts fast_settings(const Scenario& s, const Catalog& catalog) {
  constexpr double kLongest = 2.5e-3;  // s; docs/python.md has the errors of a gait at this step
  const Engine& engine = *catalog.engine("articulated");
  const double step = s.control_period / std::ceil(s.control_period / kLongest - 1e-9);
  Texts sets = engine_settings(s, engine.name, *engine.integrator("implicit"), fmt::format("{}", step));
  // A given step must divide the period of the trace, although nothing is recorded, and the duration.
  sets.push_back(fmt::format("trace.period={}", step));
  sets.push_back(fmt::format("duration={}", s.control_period * std::ceil(s.duration / s.control_period - 1e-9)));
  return sets;
}

std::shared_ptr<PyEpisodes> start(const PyScenario& scenario, const std::vector<Texts>& overrides, const Texts& action,
                                  std::int64_t every, int threads, std::size_t lanes, bool fast, bool record) {
  auto made = std::make_shared<PyEpisodes>();
  made->file = scenario.file;
  made->fast = fast;
  kit::EpisodeSettings settings{{}, every, threads, lanes, record};
  for (const std::string& part : action) settings.action.push_back(*named<kit::ActionPart>(part));
  apart([&] {
    std::vector<Scenario> scenarios;
    Problems problems;
    for (std::size_t i = 0; i < overrides.size(); ++i) {
      Texts own = scenario.own;
      own.insert(own.end(), overrides[i].begin(), overrides[i].end());
      made->own.push_back(own);
      try {
        Scenario one = made->file->with(own);
        if (fast) {
          const Texts quick = fast_settings(one, made->file->catalog);
          own.insert(own.end(), quick.begin(), quick.end());
          one = made->file->with(own);
        }
        scenarios.push_back(std::move(one));
      } catch (const InputError& error) {
        for (const Problem& one : error.problems()) problems.add(one.place, fmt::format("overrides[{}]: {}", i, one.text));
      }
    }
    problems.raise();
    made->all = std::make_unique<kit::Episodes>(std::move(scenarios), std::move(settings));
  });
  return made;
}

/// A read-only view of numbers that belong to `owner`.
py::array_t<double> view(In numbers, std::size_t rows, const py::object& owner) {
  const auto width = static_cast<py::ssize_t>(rows == 0 ? 0 : numbers.size() / rows);
  py::array_t<double> made({static_cast<py::ssize_t>(rows), width}, numbers.data(), owner);
  made.attr("setflags")(py::arg("write") = false);
  return made;
}

std::vector<std::pair<std::string, std::string>> texts_of(const std::vector<kit::EpisodeColumn>& columns) {
  std::vector<std::pair<std::string, std::string>> all;
  for (const kit::EpisodeColumn& one : columns) all.emplace_back(one.name, one.unit);
  return all;
}

/// Steps, and returns true if an environment has not ended.
bool step(PyEpisodes& episodes, const Numbers& action) {
  const In actions(action.data(), static_cast<std::size_t>(action.size()));
  if (const std::string wrong = episodes.all->problem_of(actions); !wrong.empty())
    throw InputError(SourceLocation{"step"}, wrong);
  return apart_from_python(episodes, [&](kit::Episodes& all) {
    all.step(actions);
    return all.running();
  });
}

/// Restarts environments. The arrays have a row per environment of `which`. The scenario replaces an array that is None.
void restart(PyEpisodes& episodes, const std::vector<std::size_t>& which, const py::object& angles, const py::object& speeds,
             const py::object& velocity, const py::object& angular_velocity) {
  std::vector<Initial> starts;
  if (!(angles.is_none() && speeds.is_none() && velocity.is_none() && angular_velocity.is_none())) {
    for (const std::size_t i : which) starts.push_back(episodes.all->scenario(i).initial);
  }
  const auto set = [&](const py::object& given, std::size_t width, const auto& put) {
    if (given.is_none()) return;
    const auto numbers = given.cast<Numbers>();
    for (std::size_t k = 0; k < starts.size(); ++k) put(starts[k], numbers.data() + k * width);
  };
  const std::size_t joints = episodes.all->scenario(0).robot->joints.size();
  set(angles, joints, [&](Initial& start, const double* row) { start.angles.each.assign(row, row + joints); });
  set(speeds, joints, [&](Initial& start, const double* row) { start.speeds.each.assign(row, row + joints); });
  for (std::size_t k = 0; k < starts.size(); ++k) {
    for (std::size_t j = 0; j < joints; ++j) {
      const double angle = starts[k].angles[j];
      const Joint& joint = episodes.all->scenario(which[k]).robot->joints[j];
      if (angle >= joint.lo && angle <= joint.hi) continue;
      throw InputError(SourceLocation{"reset"},
                       fmt::format("angles: joint {} of environment {} is at {:.6g} rad; expected {:.4g} to {:.4g}", joint.name,
                                   which[k], angle, joint.lo, joint.hi));
    }
  }
  if (episodes.all->scenario(0).base == Base::fixed && !(velocity.is_none() && angular_velocity.is_none()))
    throw InputError(SourceLocation{"reset"}, "a velocity of the base is given, but the base is fixed");
  set(velocity, 3, [](Initial& start, const double* row) { start.base_velocity = Vec3(row); });
  set(angular_velocity, 3, [](Initial& start, const double* row) { start.base_angular_velocity = Vec3(row); });
  apart_from_python(episodes, [&](kit::Episodes& all) { all.restart(which, starts); });
}

/// A scenario with the set points of an environment since its start.
std::shared_ptr<PyScenario> recorded(const PyEpisodes& episodes, std::size_t i, double period) {
  const kit::Episodes& all = *episodes.all;
  const kit::Recorded episode{all.set_points(i), all.steering(), all.steered(i), all.start(i)};
  Texts sets = kit::recorded_settings(all.scenario(i), episode, period);
  const PyScenario before{episodes.file, episodes.own[i], {}};
  return with_sets(before, sets);
}

/// Throws RunError if the run does not end as the environment does: with the same pose, or early.
void check_end(const PyEpisodes& episodes, std::size_t i, const PyRun& run) {
  const bool failed = episodes.all->ended(i) == name_of(Ended::diverged);
  if (failed != (run.recording.outcome.ended == Ended::diverged)) {
    throw RunError(fmt::format("the run of the recorded set points is {}, the episode is {}", run.recording.outcome.text(),
                               failed ? episodes.all->message(i) : "not"));
  }
  if (failed) return;
  const RobotState& state = episodes.all->state(i);
  std::vector<double> pose(state.position.data(), state.position.data() + 3);
  for (const double x : {state.orientation.w(), state.orientation.x(), state.orientation.y(), state.orientation.z()})
    pose.push_back(x);
  pose.insert(pose.end(), state.q.begin(), state.q.end());
  const Trace& poses = run.recording.poses;
  const std::size_t width = poses.columns.size();
  const In last = In(poses.values).subspan((poses.rows() - 1) * width + 1, pose.size());
  const auto differs = std::ranges::mismatch(pose, last).in1;
  if (differs == pose.end()) return;
  const auto k = static_cast<std::size_t>(differs - pose.begin());
  throw RunError(fmt::format(
      "the run of the recorded set points ends with {} = {:.17g}, the episode with {:.17g}; a plugin keeps something "
      "outside its states",
      poses.columns[k + 1].name, last[k], pose[k]));
}

}  // namespace

void add_episodes(py::module_& m) {
  py::class_<PyEpisodes, std::shared_ptr<PyEpisodes>>(m, "Episodes")
      .def_property_readonly("fast", [](const PyEpisodes& e) { return e.fast; })
      .def_property_readonly("running", [](const PyEpisodes& e) { return e.all->running(); })
      .def_property_readonly("driven",
                             [](const PyEpisodes& e) {
                               Texts names;
                               for (const std::size_t j : e.all->driven())
                                 names.push_back(e.all->scenario(0).robot->joints[j].name);
                               return names;
                             })
      .def_property_readonly("action_columns", [](const PyEpisodes& e) { return e.all->action_columns(); })
      .def_property_readonly("all_joints", [](const PyEpisodes& e) { return joint_names(*e.all->scenario(0).robot); })
      .def_property_readonly("parts",
                             [](const PyEpisodes& e) {
                               Texts names;
                               for (const kit::ActionPart part : e.all->parts()) names.emplace_back(name_of(part));
                               return names;
                             })
      .def_property_readonly("tilt", [](const PyEpisodes& e) { return e.all->scenario(0).limits.tilt; })
      .def("observed", [](const PyEpisodes& e) { return texts_of(e.all->observed()); })
      .def("true_columns", [](const PyEpisodes& e) { return texts_of(e.all->true_columns()); })
      .def("observations",
           [](const std::shared_ptr<PyEpisodes>& e) { return view(e->all->observations(), e->all->size(), py::cast(e)); })
      .def("truth", [](const std::shared_ptr<PyEpisodes>& e) { return view(e->all->truth(), e->all->size(), py::cast(e)); })
      .def("step", &step, py::arg("action"))
      .def(
          "stop",
          [](PyEpisodes& e, std::size_t i, const std::string& reason) {
            apart_from_python(e, [&](kit::Episodes& all) { all.stop(i, reason); });
          },
          py::arg("which"), py::arg("reason"))
      .def("restart", &restart, py::arg("which"), py::arg("angles"), py::arg("speeds"), py::arg("base_velocity"),
           py::arg("base_angular_velocity"))
      .def("ended",
           [](const PyEpisodes& e) {
             Texts all;
             for (std::size_t i = 0; i < e.all->size(); ++i) all.push_back(e.all->ended(i));
             return all;
           })
      .def(
          "message", [](const PyEpisodes& e, std::size_t i) { return e.all->message(i); }, py::arg("which"))
      .def(
          "set_points",
          [](const PyEpisodes& e, std::size_t i) {
            const std::vector<double>& all = e.all->set_points(i);
            const auto joints = static_cast<py::ssize_t>(e.all->scenario(i).robot->joints.size());
            return py::array_t<double>({static_cast<py::ssize_t>(all.size()) / std::max<py::ssize_t>(1, joints), joints},
                                       all.data());
          },
          py::arg("which"))
      .def("snapshot",
           [](PyEpisodes& e) { return py::bytes(apart_from_python(e, [](kit::Episodes& all) { return all.snapshot(); })); })
      .def(
          "restore",
          [](PyEpisodes& e, const std::string& bytes) {
            apart_from_python(e, [&](kit::Episodes& all) { all.restore(bytes); });
          },
          py::arg("snapshot"))
      .def("recorded", &recorded, py::arg("which"), py::arg("period"))
      .def("check_end", &check_end, py::arg("which"), py::arg("run"));
  m.def("start", &start, py::arg("scenario"), py::arg("overrides"), py::arg("action"), py::arg("every"), py::arg("threads"),
        py::arg("lanes"), py::arg("fast"), py::arg("record"));
}

}  // namespace gaitlab::python
