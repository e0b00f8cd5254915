// Data of one rollout in a simulation, without arrays over all lanes.
#pragma once
#include <algorithm>
#include <array>
#include <memory>
#include <string>
#include <vector>

#include "core/math/periods.h"
#include "core/plugin/plugin_instance.h"
#include "core/scenario/sensor_section.h"
#include "core/simulation/action.h"
#include "core/simulation/cpg_integrator.h"
#include "core/simulation/lane_changes.h"
#include "core/simulation/lane_clock.h"
#include "core/simulation/lane_sensors.h"
#include "core/simulation/recorder.h"
#include "core/simulation/simulation.h"
#include "core/simulation/supply.h"

namespace gaitlab {

/// CPG, controller, sensors and trace row of a rollout.
struct Simulation::Lane {
  Lane(const Scenario& s, std::size_t lane_index, bool rows)
      : Lane(s, lane_index, rows, plugin_info(s), contact_elements(*s.robot, s.contact.on)) {}
  Lane(const Scenario& s, std::size_t lane_index, bool rows, const RobotInfo& info, std::vector<ContactElement> elements)
      : scenario(s),
        robot(*s.robot),
        index(lane_index),
        clock(s, rows),
        contacts(std::move(elements)),
        changes(s, info),
        cpg(changes.cpg()),
        controller(changes.controller()),
        sample(*s.robot, contacts.size(), cpg == nullptr ? 0 : cpg->states()),
        integrator(sample.cpg.size()),
        sensors(s) {
    const std::size_t n = info.joints.size();
    for (auto* values :
         {&angle, &speed, &torque, &load, &asked, &setpoint, &command, &limit, &bound, &angle_now, &speed_now, &fastest})
      values->assign(n, 0.0);
    for (std::size_t j = 0; j < n; ++j) {
      if (!robot.joints[j].driven()) passive.push_back(j);
    }
    touching.assign(info.modules.size(), 0.0);
    channels.assign(sensors.channels(), 0.0);
    sample.sensed.assign(sensors.readings(), 0.0);
  }

  [[nodiscard]] Measured measured(double t) const {
    return {t, scenario.control_period, angle, speed, torque, touching, channels, load};
  }

  /// Measured values and set points, as parts of a snapshot of SteppedLanes.
  [[nodiscard]] std::array<std::vector<double>*, 7> values() {
    return {&angle, &speed, &torque, &touching, &channels, &load, &asked};
  }

  /// Takes the values of steering sensors from the action, if it has them.
  void steer() {
    for (std::size_t k = 0; k < action.steering.size(); ++k) channels[sensors.steering()[k]] = action.steering[k];
  }

  /// Fills `touching` and `load` from the contacts of the sample.
  void take_contacts() {
    std::fill(touching.begin(), touching.end(), 0.0);
    std::fill(load.begin(), load.end(), 0.0);
    for (std::size_t c = 0; c < contacts.size(); ++c) {
      const double fn = sample.contacts[c].fn;
      if (fn > 0) touching[robot.bodies[contacts[c].body].module] = 1;
      if (const int joint = robot.links[contacts[c].link].joint; joint >= 0) load[static_cast<std::size_t>(joint)] += fn;
    }
  }

  /// Advances the CPG states from t to t + Ts with constant inputs. Ts is the control period.
  void integrate_cpg(double t) {
    integrator.advance(*cpg, cpg_state, t, math::steps_in(scenario.control_period, scenario.cpg_step), scenario.cpg_step,
                       [&](double at) { return measured(at); });
  }

  /// Begins the segment of a control tick.
  void begin_tick(std::int64_t tick, In state, const StateLayout& layout) {
    if (scenario.changes.empty()) return;
    for (std::size_t j = 0; j < layout.joints; ++j) angle_now[j] = state[layout.angles() + j * layout.lanes + index];
    changes.begin(tick, angle_now);
    cpg = changes.cpg();
    controller = changes.controller();
  }

  /// True if a joint may meet a stop during a step of h seconds from this state of the plant.
  [[nodiscard]] bool near_stop(const StateLayout& layout, In plant_state, std::size_t lanes, double h) const;

  /// See met_stops.cpp.
  bool counts(std::size_t joint, double speed, std::int64_t step);

  /// Writes segment and faults into a sample whose time is already set.
  void read_changes(Sample& to) const {
    if (scenario.changes.empty()) return;
    to.segment = static_cast<double>(changes.segment());
    for (std::size_t j = 0; j < to.fault.size(); ++j) {
      to.fault[j] = static_cast<double>(changes.fault(j).kind);
      to.hold[j] = changes.hold(j);
      to.stuck_for[j] = changes.stuck_for(j, to.t);
    }
  }

  const Scenario& scenario;
  const Robot& robot;
  std::size_t index;
  LaneClock clock;
  std::int64_t begun = 0;  ///< step of the simulation at which the lane started; not 0 only in SteppedLanes
  bool closed = false;     ///< the lane has ended, and its recording is complete
  bool sensed = false;     ///< the measured values belong to the present control tick
  Action action;           ///< values given by SteppedLanes
  bool divided = false;    ///< scratch: the integrator divided the last step of the lane at the present eighth
  Outcome outcome;
  std::vector<ContactElement> contacts;
  std::vector<std::size_t> passive = {};  ///< joints without a motor
  LaneChanges changes;
  Cpg* cpg;  ///< CPG and controller of the present segment
  Controller* controller;
  Out block;                                ///< all numbers of the lane alone, of which the next three are parts
  Out cpg_state, controller_state, ledger;  // parts of Simulation::state_
  double energy_at_start = 0;               // J
  std::vector<double> angle, speed, torque, touching, setpoint, command, limit;  // by joint (touching: by module), for plugins
  std::vector<double> bound;                                                     // V, by joint: see LaneSupply
  std::vector<double> fastest;               // rad/s, largest speed at which each joint met a stop
  std::int64_t meetings = 0;                 // meetings with stops whose loads were measured
  std::vector<double> angle_now, speed_now;  // scratch: true angles and speeds, rad, rad/s
  std::vector<double> channels;              // values of sensors, for plugins
  std::vector<double> load;                  // N, by joint, for plugins
  std::vector<double> asked;                 // set points before faults, for SteppedLanes
  Sample sample;
  CpgIntegrator integrator;
  LaneSensors sensors;
  LaneSupply supply;
  std::unique_ptr<Recorder> recorder;  ///< nullptr for a companion (step_error.h)
};

inline std::int64_t Simulation::step_of(const Lane& lane) const { return step_number() - lane.begun; }

}  // namespace gaitlab
