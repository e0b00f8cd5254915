#include "core/simulation/probes.h"

#include <fmt/format.h>

#include <algorithm>

#include "core/model/legs.h"
#include "core/model/pattern.h"
#include "core/plugin/plugin_instance.h"
#include "core/plugin/robot_info.h"
#include "core/scenario/buses.h"
#include "core/scenario/sections.h"
#include "core/scenario/sensor_section.h"
#include "core/settings/joint_patterns.h"
#include "core/settings/offers.h"
#include "core/settings/wording.h"

namespace gaitlab {

namespace {

const std::string kReaction = "reaction.";
constexpr std::size_t kMostPatterns = 1000;  // longer lists would take seconds, because every pattern is tested on every column

}  // namespace

Probes::Probes(const Scenario& scenario, const std::vector<ContactElement>& contacts, const Cpg* cpg,
               std::string_view command_unit, const Sample& sample)
    : sample_(sample) {
  add_all(scenario, contacts, cpg, command_unit);
  select(scenario);
}

std::vector<Column> Probes::known(const Scenario& scenario) {
  const Robot& robot = *scenario.robot;
  const std::vector<ContactElement> contacts = contact_elements(robot, scenario.contact.on);
  const std::unique_ptr<Cpg> cpg = make_cpg(scenario.cpg, plugin_info(scenario));
  const std::unique_ptr<Actuator> actuator = make_actuator(scenario.actuator, info(robot));
  Sample sample(robot, contacts.size(), cpg == nullptr ? 0 : cpg->states());
  sample.sensed.resize(sensor_readings(scenario).size());
  Probes all(sample);
  all.add_all(scenario, contacts, cpg.get(), actuator == nullptr ? "" : actuator->command_unit());
  return std::move(all.columns_);
}

void Probes::add_all(const Scenario& scenario, const std::vector<ContactElement>& contacts, const Cpg* cpg,
                     std::string_view command_unit) {
  const Robot& robot = *scenario.robot;
  add("t", "s", "time", sample_.t);
  if (!scenario.changes.empty()) add("segment", "", "number of changes (section `at`) before t", sample_.segment);
  const auto faults = [](const Change& change) { return !change.faults.empty(); };
  const bool motors = scenario.actuator.entry != nullptr;
  const bool friction = motors && !make_actuator(scenario.actuator, info(robot))->friction().empty();
  add_joints(robot, motors, command_unit, std::ranges::any_of(scenario.changes, faults), friction);
  const std::vector<MotorBus> all = buses(scenario);
  for (std::size_t b = 0; b < all.size(); ++b) {
    const std::string of = all[b].module.empty() ? "" : " of module " + all[b].module;
    add(all[b].name() + ".voltage", "V", "voltage of the bus" + of + ", in force just before t", sample_.bus_voltage[b]);
    add(all[b].name() + ".current", "A",
        (of.empty() ? "current of the supply" : "current of the battery" + of) + " at the control tick that set this voltage",
        sample_.bus_current[b]);
  }
  add_base();
  add_vector("com", "m", "centre of mass, world axes", [](const Sample& s) { return s.sums.com; });
  add_contacts(contacts);
  add_loads(robot, contacts);
  add_legs(robot, plugin_info(scenario).legs, contacts);
  add_bodies(robot, sample_);
  add_boxes(scenario.ground);
  for (std::size_t i = 0; cpg != nullptr && i < cpg->states(); ++i) {
    add("cpg." + cpg->state_name(i), "", "state of the CPG", [i](const Sample& s) { return s.cpg[i]; });
  }
  add_energy(robot, friction);
  add_steps(robot);
  add_logged(scenario);
  add_reactions(robot);
  add_sensors(sensor_readings(scenario));
}

void Probes::add(std::string name, std::string unit, std::string definition, Read read) {
  columns_.push_back({std::move(name), std::move(unit), std::move(definition)});
  sources_.push_back({nullptr, std::move(read)});
}
void Probes::add(std::string name, std::string unit, std::string definition, const double& number) {
  columns_.push_back({std::move(name), std::move(unit), std::move(definition)});
  sources_.push_back({&number});
}

void Probes::add_steps(const Robot& robot) {
  add("steps.solves", "", "solves of the equations of motion from t = 0 to this row; 0: the engine does not count them",
      sample_.tally.solves);
  add("steps.off", "", "joint-steps from t = 0 to this row that do not satisfy the law of their motor or end stop",
      sample_.tally.off);
  for (std::size_t j = 0; j < robot.joints.size(); ++j) {
    add(fmt::format("torque_error.{}", j), "N m",
        "estimate of the motor torque's error from the length of the steps, RMS from t = 0 to this row, of joint " +
            robot.joints[j].name,
        sample_.tally.torque_error[j]);
  }
}

void Probes::add_vector(const std::string& name, const std::string& unit, const std::string& definition,
                        const std::function<Vec3(const Sample&)>& read) {
  constexpr const char* kAxis[] = {"x", "y", "z"};
  for (Eigen::Index i = 0; i < 3; ++i) {
    // `base.v` gives `base.vx`, `base` gives `base.x`.
    const bool joined = name.find('.') != std::string::npos && !name.ends_with('.');
    const std::string full = joined ? name + kAxis[i] : (name.ends_with('.') ? name : name + ".") + kAxis[i];
    add(full, unit, definition, [read, i](const Sample& s) { return read(s)[i]; });
  }
}

void Probes::add_joints(const Robot& robot, bool motors, std::string_view command_unit, bool faults, bool friction) {
  std::size_t plays = 0;
  for (std::size_t j = 0; j < robot.joints.size(); ++j) {
    const std::string of = " of joint " + robot.joints[j].name;
    const bool driven = motors && robot.joints[j].driven();
    const auto joint = [&](const char* quantity, std::string_view unit, const char* definition,
                           std::vector<double> Sample::*values) {
      add(fmt::format("joint.{}.{}", j, quantity), std::string(unit), definition + of, (sample_.*values)[j]);
    };
    if (driven) joint("setpoint", "rad", "set point in force just before t", &Sample::setpoint);
    add(fmt::format("joint.{}.angle", j), "rad", "angle" + of, sample_.state.q[j]);
    add(fmt::format("joint.{}.speed", j), "rad/s", "speed" + of, sample_.state.qd[j]);
    if (driven && robot.joints[j].play.any()) {
      const std::size_t play = plays++;
      add(fmt::format("joint.{}.motor_angle", j), "rad", "angle of the motor, geared," + of, sample_.state.rotor[play]);
      add(fmt::format("joint.{}.motor_speed", j), "rad/s", "speed of the motor, geared," + of, sample_.state.rotor_speed[play]);
    }
    if (driven) {
      joint("voltage_command", command_unit, "controller output before clamping, in force just before t", &Sample::command);
      joint("voltage", "V", "terminal voltage of the motor", &Sample::voltage);
      joint("current", "A", "current of the motor", &Sample::current);
      joint("torque", "N m", "motor torque on the joint, positive along the axis,", &Sample::torque);
      if (robot.joints[j].play.any())
        joint("gear_torque", "N m", "torque of the gear on the link, positive along the axis,", &Sample::gear_torque);
      if (friction) joint("friction", "N m", "part of this torque that friction gives,", &Sample::friction);
    }
    if (!robot.joints[j].driven()) {
      joint("passive_torque", "N m", "torque of spring, damper and friction of the hinge, positive along the axis,",
            &Sample::passive_torque);
    }
    joint("stop_torque", "N m", "torque of the hinge stop, positive along the axis,", &Sample::stop_torque);
    if (driven) joint("saturation", "", "0 none, 1 voltage, 2 current:", &Sample::saturation);
    if (driven && faults) joint("fault", "", "0 none, 1 dead, 2 open, 3 stuck, 4 weak, 5 lost, 6 late: fault", &Sample::fault);
  }
}

void Probes::add_logged(const Scenario& scenario) {
  if (!scenario.measured.any()) return;
  for (const MeasuredLog::OfJoint& of : scenario.measured.log->joints) {
    for (const LoggedKind& kind : logged_kinds()) {
      if (of.of(kind.kind).empty()) continue;
      add(fmt::format("joint.{}.logged_{}", of.joint, kind.key), kind.unit,
          fmt::format("{} in the log `measured`, of joint {}", kind.key, scenario.robot->joints[of.joint].name),
          [log = scenario.measured.log, &values = of.of(kind.kind)](const Sample& s) { return log->at(values, s.t); });
    }
  }
}

void Probes::add_sensors(const std::vector<SensorReading>& readings) {
  for (std::size_t i = 0; i < readings.size(); ++i) {
    add(readings[i].column, readings[i].unit, readings[i].definition, sample_.sensed[i]);
  }
}

void Probes::add_base() {
  add_vector("base", "m", "origin of the base frame, world axes", [](const Sample& s) { return s.state.position; });
  const std::string turn = "quaternion base -> world, sign continuous";
  add("base.qw", "", turn, [](const Sample& s) { return s.state.orientation.w(); });
  add("base.qx", "", turn, [](const Sample& s) { return s.state.orientation.x(); });
  add("base.qy", "", turn, [](const Sample& s) { return s.state.orientation.y(); });
  add("base.qz", "", turn, [](const Sample& s) { return s.state.orientation.z(); });
  add_vector("base.v", "m/s", "velocity of the base frame's origin, world axes",
             [](const Sample& s) { return s.state.velocity; });
  add_vector("base.w", "rad/s", "angular velocity of the base, world axes",
             [](const Sample& s) { return s.state.angular_velocity; });
}

void Probes::add_contacts(const std::vector<ContactElement>& contacts) {
  for (std::size_t c = 0; c < contacts.size(); ++c) {
    const std::string of = " of contact element " + contacts[c].name;
    const std::string name = fmt::format("contact.{}.", c);
    add(name + "fn", "N", "normal force" + of, [c](const Sample& s) { return s.contacts[c].fn; });
    add(name + "penetration", "m", "penetration, 0 without contact," + of,
        [c](const Sample& s) { return s.contacts[c].penetration; });
    add_vector(name + "f", "N", "force on the robot, world axes," + of, [c](const Sample& s) { return s.contacts[c].force; });
  }
}

void Probes::add_loads(const Robot& robot, const std::vector<ContactElement>& contacts) {
  std::vector<std::vector<std::size_t>> elements_of(robot.modules.size());
  for (std::size_t c = 0; c < contacts.size(); ++c) elements_of[robot.bodies[contacts[c].body].module].push_back(c);
  for (std::size_t m = 0; m < robot.modules.size(); ++m) {
    const std::vector<std::size_t>& elements = elements_of[m];
    if (elements.empty()) continue;
    add(fmt::format("load.{}", m), "N", fmt::format("normal force on all contact elements of module {}", m),
        [elements](const Sample& s) {
          double sum = 0;
          for (const std::size_t c : elements) sum += s.contacts[c].fn;
          return sum;
        });
  }
}

void Probes::add_legs(const Robot& robot, const std::vector<Leg>& legs, const std::vector<ContactElement>& contacts) {
  const Kinematics zero = at_zero(robot);
  for (const Leg& leg : legs) {
    std::vector<std::size_t> elements;
    for (std::size_t c = 0; c < contacts.size(); ++c) {
      if (std::ranges::find(leg.bodies, static_cast<std::int64_t>(contacts[c].body)) != leg.bodies.end()) elements.push_back(c);
    }
    const std::string name = "leg." + leg.name + ".";
    add(name + "load", "N", "normal force on all contact elements of the leg", [elements](const Sample& s) {
      double sum = 0;
      for (const std::size_t c : elements) sum += s.contacts[c].fn;
      return sum;
    });
    const std::size_t link = robot.bodies[static_cast<std::size_t>(leg.bodies.back())].link;
    const Vec3 in_link = zero.R[link].transpose() * (vector_of(leg.foot) - zero.p[link]);
    add_vector(name, "m", "foot of the leg, base frame", [link, in_link](const Sample& s) {
      return Vec3(s.state.orientation.conjugate() * (s.kinematics.point(link, in_link) - s.state.position));
    });
  }
}

void Probes::add_bodies(const Robot& robot, const Sample& first) {
  for (const Body& body : robot.bodies) {
    const std::size_t link = body.link;
    const Vec3 p = body.in_link.p;
    add_vector("body." + body.name + ".", "m", "origin of the body's frame, world axes",
               [link, p](const Sample& s) { return s.kinematics.point(link, p); });
    const Quat in_link(body.in_link.R);
    const double sign = (first.orientation[link] * in_link).w() < 0 ? -1 : 1;
    constexpr const char* kPart[] = {"qx", "qy", "qz", "qw"};  // Eigen's order of coefficients
    for (const Eigen::Index i : {3, 0, 1, 2}) {
      add("body." + body.name + "." + kPart[i], "", "quaternion body -> world, sign continuous",
          [=](const Sample& s) { return sign * (s.orientation[link] * in_link).coeffs()[i]; });
    }
  }
}

void Probes::add_boxes(const Ground& ground) {
  for (std::size_t b = 0; b < ground.boxes().size(); ++b) {
    if (!(ground.boxes()[b].mass > 0)) continue;  // this box cannot move
    const std::string name = fmt::format("box.{}.", b);
    const std::string of = fmt::format(" of ground.boxes[{}]", b);
    add_vector(name, "m", "middle" + of + ", world axes", [b](const Sample& s) { return s.boxes[b].position; });
    constexpr const char* kPart[] = {"qx", "qy", "qz", "qw"};  // Eigen's order of coefficients
    for (const Eigen::Index i : {3, 0, 1, 2}) {
      add(name + kPart[i], "", "quaternion box -> world, sign continuous," + of,
          [b, i](const Sample& s) { return s.boxes[b].orientation.coeffs()[i]; });
    }
    add_vector(name + "v", "m/s", "velocity of the middle" + of + ", world axes",
               [b](const Sample& s) { return s.boxes[b].velocity; });
  }
}

void Probes::add_energy(const Robot& robot, bool friction) {
  add("energy.kinetic", "J", "kinetic energy of all links", [](const Sample& s) { return s.sums.kinetic; });
  add("energy.potential", "J", "weight times height of the centre of mass", [](const Sample& s) { return s.sums.potential; });
  const auto ledger = [&](const char* entry, const char* definition, double Ledger::*value) {
    add(std::string("energy.") + entry, "J", std::string(definition) + ", from t = 0",
        [value](const Sample& s) { return s.ledger.*value; });
  };
  ledger("electrical", "energy drawn by the motors", &Ledger::electrical);
  ledger("copper", "energy lost in the motors' windings", &Ledger::copper);
  ledger("gear", "energy lost in the gears (negative: created by eq. 2)", &Ledger::gear);
  ledger("stored", "kinetic and potential energy, minus the value at the start", &Ledger::stored);
  ledger("contact", "energy given to the ground along its normal", &Ledger::contact);
  ledger("friction", "energy given to the ground along its surface", &Ledger::friction);
  ledger("stops", "energy given to the hinge stops", &Ledger::stops);
  if (!std::ranges::all_of(robot.joints, [](const Joint& joint) { return joint.driven(); })) {
    ledger("hinges", "energy lost in dampers and friction of passive hinges", &Ledger::hinges);
  }
  if (friction) ledger("dry", "energy lost in dry and viscous friction of driven joints", &Ledger::dry);
  add("energy.residual", "J", "electrical energy minus all other entries, from t = 0: the error of the integration",
      [](const Sample& s) { return s.ledger.residual(); });
  add_vector("momentum", "N s", "linear momentum, world axes", [](const Sample& s) { return s.sums.momentum; });
  add_vector("angular_momentum", "N m s", "angular momentum about the world origin",
             [](const Sample& s) { return s.sums.angular_momentum; });
}

void Probes::add_wrench(const std::string& name, const std::string& of,
                        const std::function<const Wrench&(const Sample&)>& read) {
  add_vector(name + ".f", "N", "force" + of, [read](const Sample& s) { return read(s).force; });
  add_vector(name + ".m", "N m", "moment" + of, [read](const Sample& s) { return read(s).moment; });
}

void Probes::add_reactions(const Robot& robot) {
  add_wrench(kReaction + "base", " from outside on the base, about its frame's origin, world axes; 0 if the base floats",
             [](const Sample& s) -> const Wrench& { return s.reactions.base(); });
  for (std::size_t j = 0; j < robot.joints.size(); ++j) {
    add_wrench(kReaction + std::to_string(j),
               " of the parent on the child at hinge " + robot.joints[j].name + ", about its origin, world axes",
               [j](const Sample& s) -> const Wrench& { return s.reactions.hinge(j); });
  }
  for (std::size_t m = 1; m < robot.modules.size(); ++m) {
    add_wrench(
        kReaction + dock_name(m),
        " of the parent on module " + std::to_string(m) + " at its dock, about the docked " + "faces' origin, world axes",
        [m](const Sample& s) -> const Wrench& { return s.reactions.dock(m); });
  }
}

namespace {

/// Marks the columns that match the patterns of the scenario, and t.
std::vector<bool> matched(const Scenario& scenario, const std::vector<Column>& columns) {
  std::vector<bool> wanted(columns.size(), false);
  wanted[0] = true;
  Problems problems;
  std::vector<std::string> names;
  names.reserve(columns.size());
  const std::vector<std::string> joints = joint_names(*scenario.robot);
  for (const Column& column : columns) names.push_back(column.name);
  if (scenario.trace.columns.size() > kMostPatterns) {
    throw InputError(scenario.place("trace.columns"),
                     fmt::format("has {} names and patterns; expected at most {}: a pattern with * and ? selects many columns",
                                 scenario.trace.columns.size(), kMostPatterns));
  }
  for (const std::string& pattern : scenario.trace.columns) {
    bool found = false;
    const ColumnChoice choice(pattern, joints, scenario.groups);
    for (std::size_t i = 0; i < columns.size(); ++i) {
      if (!choice.has(columns[i].name)) continue;
      wanted[i] = found = true;
    }
    // The default patterns include joint.*, and segment in a scenario with changes.
    const bool of_default = pattern == "segment" || (scenario.robot->joints.empty() && pattern.starts_with("joint."));
    if (found || of_default) continue;
    const std::string near = problems.size() < kMostOffers ? nearest(pattern, names) : "";
    problems.add(
        scenario.place("trace.columns"),
        fmt::format("{} matches no column{}", in_quotes(pattern),
                    near.empty() ? "; groups are t, joint, base, com, contact, load, leg, body, box, "
                                   "cpg, energy, momentum, angular_momentum, steps, torque_error, reaction, sensor, segment"
                                 : "; did you mean '" + near + "'?"));
  }
  problems.raise();
  return wanted;
}

}  // namespace

void Probes::select(const Scenario& scenario) {
  const std::vector<bool> wanted = matched(scenario, columns_);
  std::size_t kept = 0;
  for (std::size_t i = 0; i < columns_.size(); ++i) {
    if (!wanted[i]) {
      const auto covers = [&](const std::string& pattern) { return glob(pattern, columns_[i].name); };
      if (std::ranges::none_of(report_columns(), covers) && !scenario.measured.reads(columns_[i].name)) continue;
      rest_columns_.push_back(std::move(columns_[i]));
      rest_sources_.push_back(std::move(sources_[i]));
      continue;
    }
    if (kept != i) {
      columns_[kept] = std::move(columns_[i]);
      sources_[kept] = std::move(sources_[i]);
    }
    ++kept;
  }
  columns_.resize(kept);
  const auto want = [&](std::string_view prefix) {
    return std::ranges::any_of(columns_, [&](const Column& c) { return c.name.starts_with(prefix); });
  };
  want_reactions_ = want(kReaction);
  want_places_ =
      want_reactions_ || want("body.") || want("leg.") || want("energy.") || want("momentum.") || want("angular_momentum.");
  sources_.resize(kept);
  if (!want_reactions_ || scenario.contact.model().element_forces) return;
  throw InputError(scenario.place("trace.columns"),
                   "reactions are computed from contact forces, but contact.law: bullet has impulses, some of which do not act "
                   "at contact elements; remove the columns reaction.*, or take contact.law: penalty");
}

void Probes::fill(Out row, Out rest) const {
  const auto read = [&](const std::vector<Source>& sources, Out into) {
    for (std::size_t i = 0; i < sources.size(); ++i) {
      into[i] = sources[i].number != nullptr ? *sources[i].number : sources[i].read(sample_);
    }
  };
  read(sources_, row);
  read(rest_sources_, rest);
}

}  // namespace gaitlab
