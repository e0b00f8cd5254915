#include "app/new/skeletons.h"

namespace gaitlab::app {

namespace {

constexpr const char* kCpg =
    R"(// CPG @NAME@: a chain of phase oscillators, as a starting point. Purpose of every function: core/plugin/cpg.h.
#include <cmath>
#include <numbers>

#include "core/plugin/oscillators.h"
#include "core/plugin/plugin.h"

namespace {

class @CLASS@ final : public gaitlab::Cpg {
 public:
  // The initial values are the defaults. One list of fields serves the reading of the scenario with its errors, `explain`, the
  // editor's schema and the resolved scenario.
  struct Model {
    double coupling = 4;
    void fields(gaitlab::Fields& f) {
      f.number("coupling", coupling, {"1/s", 0, 1000, "Strength with which a joint is pulled to its lag."});
    }
  };
  // The keys that all oscillators share, frequency, amplitude, offset, phase_lag and couplings, and under `model` those above.
  using Settings = gaitlab::OscillatorSettings<Model>;

  // Once per run. If the settings do not fit the robot, throw std::invalid_argument: it is reported as an error of the scenario.
  @CLASS@(const gaitlab::RobotInfo& robot, const Settings& settings)
      : joints_(robot.joints.size()), s_(settings), network_(robot, settings, settings.model.coupling) {}

  // The state belongs to the simulation: here one phase per joint, rad.
  std::size_t states() const override { return joints_; }
  std::string state_name(std::size_t joint) const override { return "phi." + std::to_string(joint); }
  void start(gaitlab::Out phi) const override {
    for (std::size_t i = 0; i < joints_; ++i) phi[i] = network_.phases[i];
  }

  // phi_i' = 2 pi f_i + sum over the couplings of w sin(phi_j - phi_i + L)
  void derivative(const gaitlab::Measured&, gaitlab::In phi, gaitlab::Out rate) const override {
    for (std::size_t i = 0; i < joints_; ++i) rate[i] = 2 * std::numbers::pi * s_.frequency[i];
    for (const gaitlab::Coupling& c : network_.couplings) {
      const auto from = static_cast<std::size_t>(c.from);
      const auto to = static_cast<std::size_t>(c.to);
      rate[to] += c.weight * std::sin(phi[from] - phi[to] + c.phase_lag);
    }
  }

  // Set points, rad, once per control tick.
  void output(double, gaitlab::In phi, gaitlab::Out setpoint) const override {
    for (std::size_t i = 0; i < joints_; ++i) setpoint[i] = s_.offset[i] + s_.amplitude[i] * std::sin(phi[i]);
  }

  std::string note() const override { return network_.note(); }

 private:
  std::size_t joints_;
  Settings s_;
  gaitlab::OscillatorNetwork network_;
};

constexpr const char* kManual = R"text(A chain of phase oscillators.

    phi_i' = 2 pi f_i + sum_j w sin(phi_j - phi_i + L_ij)
    theta_i = X_i + R_i sin(phi_i)

Source: say where your equations come from.

    cpg: {type: @NAME@, frequency: 0.5, amplitude: 0.5, phase_lag: 1.2, model: {coupling: 4}})text";

}  // namespace

GAITLAB_PLUGIN(registry) { gaitlab::add_cpg<@CLASS@>(registry, "@NAME@", kManual); }
)";

constexpr const char* kCpgScenario = R"(# A short caterpillar that walks with the CPG @NAME@.
gaitlab: 1
name: @NAME@
plugins: [build/@NAME@.so]      # relative to this file

robot:
  modules: mtran
  docks: [[1, 1, 4, 0, 0], [1, 2, 4, 1, 0], [1, 3, 4, 2, 0], [1, 4, 4, 3, 0]]   # five in a row

contact: {on: all}
cpg: {type: @NAME@, frequency: 0.5, amplitude: 0.5, phase_lag: 1.2}
physics: {engine: articulated}  # the fast engine; without this line engine bullet, two to four times slower
duration: 4                     # s
)";

constexpr const char* kCpgTest = R"(# The robot goes 0.16 m; a robot that does not walk stays within millimetres.
get(distance distance)
expect(distance GREATER 0.05 "m: it does not walk")
)";

constexpr const char* kController =
    R"(// Controller @NAME@: a spring and a damper between joint and set point, as a starting point. Purpose of every function:
// core/plugin/controller.h.
#include "core/plugin/plugin.h"

namespace {

class @CLASS@ final : public gaitlab::Controller {
 public:
  // The initial values are the defaults. One list of fields serves the reading of the scenario with its errors, `explain`, the
  // editor's schema and the resolved scenario. PerJoint: one number, or one for each joint.
  struct Settings {
    gaitlab::PerJoint stiffness{60}, damping{0.6};
    void fields(gaitlab::Fields& f) {
      f.per_joint("stiffness", stiffness, {"V/rad", 0, 1e6, "Voltage per angle to the set point."});
      f.per_joint("damping", damping, {"V s/rad", 0, 1e6, "Voltage per speed of the joint."});
    }
  };

  // Once per run. If the settings do not fit the robot, throw std::invalid_argument: it is reported as an error of the scenario.
  @CLASS@(const gaitlab::RobotInfo& robot, const Settings& settings) : joints_(robot.joints.size()), s_(settings) {}

  // "V" or "N m", as the actuator takes; another unit is an error of the scenario.
  std::string_view command_unit() const override { return "V"; }

  // Once per control period; the command is held until the next. The state of a controller (an integral,
  // a filter) is kept by the simulation, in the `states()` numbers of x; the object itself is constant.
  void update(const gaitlab::Measured& m, gaitlab::In setpoint, gaitlab::In, gaitlab::Out, gaitlab::Out command) const override {
    for (std::size_t j = 0; j < joints_; ++j) {
      command[j] = s_.stiffness[j] * (setpoint[j] - m.angle[j]) - s_.damping[j] * m.speed[j];
    }
  }

 private:
  std::size_t joints_;
  Settings s_;
};

constexpr const char* kManual = R"text(A spring and a damper, once per control period.

    u = k (set point - angle) - d speed

Source: say where your equations come from. Commands volts.

    controller: {type: @NAME@, stiffness: 60, damping: 0.6})text";

}  // namespace

GAITLAB_PLUGIN(registry) { gaitlab::add_controller<@CLASS@>(registry, "@NAME@", kManual); }
)";

constexpr const char* kControllerScenario =
    R"(# A module held at its active block; the controller @NAME@ holds its other half up in the air.
gaitlab: 1
name: @NAME@
plugins: [build/@NAME@.so]      # relative to this file

robot:
  modules: mtran
  base: fixed
  position: [0, 0, 0.5]         # m

ground: {type: none}
contact: {on: none}
initial: {angles: {m0/active: 0.2, m0/passive: -0.3}}   # rad; without a cpg these are the set points
controller: {type: @NAME@}
physics: {engine: articulated}  # the fast engine; without this line engine bullet, two to four times slower
duration: 2                     # s
)";

constexpr const char* kControllerTest =
    R"(# The free half loads the joint with 0.13 N m. The spring, 60 V/rad times 0.38 N m/V, yields by 0.006 rad. Without it,
# the joint falls to its stop, 1.6 rad.
foreach(joint m0/active m0/passive)
  get(error per_joint ${joint} tracking_error rms)
  expect(error LESS 0.01 "rad: it does not hold ${joint}")
endforeach()
)";

constexpr const char* kActuator =
    R"(// Actuator @NAME@: a motor whose torque falls linearly with its speed, as a starting point. Purpose of every function:
// core/plugin/actuator.h.
#include <algorithm>
#include <vector>

#include "core/plugin/plugin.h"

namespace {

class @CLASS@ final : public gaitlab::Actuator {
 public:
  // The initial values are the defaults. One list of fields serves the reading of the scenario with its errors, `explain`, the
  // editor's schema and the resolved scenario. PerJoint: one number, or one for each joint.
  struct Settings {
    gaitlab::PerJoint torque_constant{0.38}, drag{0.9}, u_max{7.4};
    void fields(gaitlab::Fields& f) {
      f.per_joint("torque_constant", torque_constant, {"N m/V", 0, 1e3, "Torque at rest per volt."});
      f.per_joint("drag", drag, {"N m s/rad", 0, 1e3, "Torque lost per speed of the joint."});
      f.per_joint("u_max", u_max, {"V", 0, 1e6, "The command is cut to +- this."});
    }
  };

  // Once per run. `lanes` has the settings of every rollout that is simulated side by side. All spans below are joint * lanes + lane.
  @CLASS@(const gaitlab::RobotInfo& robot, const std::vector<const Settings*>& lanes) {
    for (std::size_t j = 0; j < robot.joints.size(); ++j) {
      for (const Settings* s : lanes) {
        motors_.push_back({s->torque_constant[j], s->drag[j]});
        limit_.push_back(s->u_max[j]);
      }
    }
  }

  // "V" or "N m", as the controller commands; another unit is an error of the scenario.
  std::string_view command_unit() const override { return "V"; }
  gaitlab::In command_limit() const override { return limit_; }

  // T = k u - d w. The slope d = -dT/dw is also required, because the length of the step depends on it.
  void effort(gaitlab::In command, gaitlab::In speed, gaitlab::Out torque, gaitlab::Out slope) const override {
    for (std::size_t i = 0; i < motors_.size(); ++i) {
      torque[i] = motors_[i].k * cut(command, i) - motors_[i].d * speed[i];
      slope[i] = motors_[i].d;
    }
  }

  // Only for the trace and the energy balance: the power drawn, and the power lost before the joint.
  void electrical(gaitlab::In command, gaitlab::In speed, Electrical out) const override {
    for (std::size_t i = 0; i < motors_.size(); ++i) {
      out.voltage[i] = cut(command, i);
      out.current[i] = 0;
      out.saturation[i] = out.voltage[i] != command[i] ? 1 : 0;
      out.power_in[i] = motors_[i].k * out.voltage[i] * speed[i];
      out.copper[i] = 0;
      out.gear[i] = motors_[i].d * speed[i] * speed[i];
    }
  }

 private:
  double cut(gaitlab::In command, std::size_t i) const { return std::clamp(command[i], -limit_[i], limit_[i]); }

  struct Motor {
    double k, d;
  };
  std::vector<Motor> motors_;
  std::vector<double> limit_;
};

constexpr const char* kManual = R"text(A motor whose torque falls linearly with its speed.

    T = k u - d w      |u| <= u_max

Source: say where your equations come from. Takes commands in V.

    actuator: {type: @NAME@, torque_constant: 0.38, drag: 0.9})text";

}  // namespace

GAITLAB_PLUGIN(registry) { gaitlab::add_actuator<@CLASS@>(registry, "@NAME@", kManual); }
)";

constexpr const char* kActuatorScenario =
    R"(# A module held at its active block; the actuator @NAME@ swings its other half in the air.
gaitlab: 1
name: @NAME@
plugins: [build/@NAME@.so]      # relative to this file

robot:
  modules: mtran
  base: fixed
  position: [0, 0, 0.5]         # m

ground: {type: none}
contact: {on: none}
actuator: {type: @NAME@}
controller: {type: pid, Kp: 100, Kd: 0}
cpg: {type: sine, frequency: 0.5, amplitude: 0.5, phase_lag: 0}
physics: {engine: articulated}  # the fast engine; without this line engine bullet, two to four times slower
duration: 4                     # s
)";

constexpr const char* kActuatorTest =
    R"(# The joint lags by 0.02 rad; without torque its error would be the whole set point, 0.35 rad.
foreach(joint m0/active m0/passive)
  get(error per_joint ${joint} tracking_error rms)
  expect(error LESS 0.05 "rad: it does not drive ${joint}")
endforeach()
)";

}  // namespace

const std::array<Skeleton, 3> kSkeletons{{{Kind::cpg, kCpg, kCpgScenario, kCpgTest},
                                          {Kind::controller, kController, kControllerScenario, kControllerTest},
                                          {Kind::actuator, kActuator, kActuatorScenario, kActuatorTest}}};

const char* const kSkeletonBuild =
    R"(# cmake -B build -DCMAKE_PREFIX_PATH=<where gaitlab is installed> && cmake --build build && ctest --test-dir build
cmake_minimum_required(VERSION 3.25)
project(@NAME@ CXX)
find_package(gaitlab REQUIRED)
gaitlab_add_plugin(@NAME@ @NAME@.cpp)   # build/@NAME@.so

enable_testing()
add_test(NAME @NAME@ COMMAND ${CMAKE_COMMAND} -DPROGRAM=$<TARGET_FILE:gaitlab::gaitlab> -DPLUGIN=$<TARGET_FILE:@NAME@>
  -P ${CMAKE_CURRENT_SOURCE_DIR}/test.cmake)
)";

const char* const kSkeletonTest =
    R"(# Runs scenario.yaml with the plugin just built and looks at its summary. Called by ctest with PROGRAM and PLUGIN.
set(run "${CMAKE_CURRENT_BINARY_DIR}/run")
file(REMOVE_RECURSE "${run}")
execute_process(COMMAND "${PROGRAM}" run "${CMAKE_CURRENT_LIST_DIR}/scenario.yaml" --set "plugins=[\"${PLUGIN}\"]" --out "${run}"
  --quiet COMMAND_ERROR_IS_FATAL ANY)
file(READ "${run}/summary.json" summary)

# get(VARIABLE KEY...): a number of the summary
macro(get variable)
  string(JSON ${variable} GET "${summary}" ${ARGN})
endmacro()
# expect(VARIABLE GREATER|LESS NUMBER REASON)
macro(expect variable relation number reason)
  if(NOT ${variable} ${relation} ${number})
    message(FATAL_ERROR "${variable} is ${${variable}}, not ${relation} ${number} ${reason}")
  endif()
endmacro()

@TEST@)";

}  // namespace gaitlab::app
