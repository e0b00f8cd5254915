#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>

#include "core/laws/data_sheet.h"
#include "core/laws/dc_motor.h"
#include "core/model/outline.h"
#include "core/robot_files/type_presets.h"
#include "core/scenario/built_robot.h"
#include "core/scenario/sensor_section.h"
#include "core/settings/settings_numbers.h"
#include "core/settings/wording.h"
#include "report/analysis/envelope.h"
#include "report/verdict/plausible/plausible_number.h"

namespace gaitlab::report {

namespace {

double of_kgf_cm(double value) { return value * kKgfCm; }
double of_rev_per_min(double value) { return value * kRevPerMin; }
double of_s_per_60_degrees(double value) { return std::numbers::pi / 3 / value; }

/// Torque at rest and no-load speed of a joint's motor: the data of a servo, or those that follow from the constants of a DC
/// motor.
struct MotorData {
  std::size_t joint = 0;
  double torque = 0, speed = 0;  ///< N m, rad/s
  const char *torque_key = "Kt", *speed_key = "gear";
};

std::vector<MotorData> motor_data(const Scenario& s) {
  std::vector<MotorData> all;
  if (s.actuator.entry == nullptr) return all;
  const std::unique_ptr<Actuator> actuator = make_motors(s);
  const DcMotor* const motors = actuator == nullptr ? nullptr : actuator->dc_motors();
  const SettingsNumbers sheet(s.actuator);
  const SettingsNumbers::Found* const torque = sheet.find("stall_torque");
  const SettingsNumbers::Found* const speed = sheet.find("no_load_speed");
  for (std::size_t j = 0; motors != nullptr && j < s.robot->joints.size(); ++j) {
    if (!s.robot->joints[j].driven()) continue;
    const DcMotor& m = motors[j];
    const bool one_constant = std::max(m.Kt / m.Ks, m.Ks / m.Kt) <= kConstantsApart;  // otherwise warnings.cpp reports them
    MotorData one{j, m.efficiency * m.load * m.gear * m.Kt * std::min(m.u_max / m.R, m.i_max), m.u_max / (m.Ks * m.gear)};
    if (torque != nullptr && speed != nullptr) one = {j, torque->value[j], speed->value[j], "stall_torque", "no_load_speed"};
    if (torque == nullptr && !one_constant) continue;
    if (one.torque > 0 && one.speed > 0 && std::isfinite(one.torque + one.speed)) all.push_back(one);
  }
  return all;
}

/// Place of a motor's or controller's key: in the scenario, else in the map of the hinge, else in that of the module type.
SourceLocation motor_place(const Scenario& s, std::size_t joint, const char* key, const char* section = "actuator") {
  SourceLocation own = s.place(fmt::format("{}.{}", section, key));
  if (own.line > 0 || own.file != s.file) return own;
  const std::size_t type = s.robot->modules[s.robot->joints[joint].module].type;
  if (type >= s.module_documents->size()) return own;
  for (const Node* map : {hinge_map(s, joint), &(*s.module_documents)[type]}) {
    const Node* const motor = map == nullptr ? nullptr : map->find(section);
    const Node* const value = motor == nullptr ? nullptr : motor->find(key);
    if (value != nullptr) return value->place;
  }
  return s.nearest_place(section);
}

double mass_of_module(const Scenario& s, std::size_t joint) {
  double mass = 0;
  const Module& module = s.robot->modules[s.robot->joints[joint].module];
  for (const BodyType& body : s.robot->types[module.type].bodies) mass += body.mass;
  return mass;
}

std::vector<Finding> speeds_without_load(const Subject& subject, bool free) {
  const Scenario& s = subject.scenario;
  std::vector<Finding> found;
  for (const MotorData& motor : motor_data(s)) {
    if (s.robot->joints[motor.joint].turns_freely() != free) continue;
    const std::string& name = s.robot->joints[motor.joint].name;
    found.push_back({motor_place(s, motor.joint, motor.speed_key),
                     {name},
                     fmt::format("the motor of {} turns at {:.4g} rad/s without load", name, motor.speed),
                     motor.speed,
                     {},
                     {},
                     {{motor.speed, "rad/s"}}});
  }
  return found;
}

std::vector<Finding> speeds_of_hinges(const Subject& subject) { return speeds_without_load(subject, false); }
std::vector<Finding> speeds_of_wheels(const Subject& subject) { return speeds_without_load(subject, true); }

std::vector<Finding> stall_torques(const Subject& subject) {
  const Scenario& s = subject.scenario;
  std::vector<Finding> found;
  const std::vector<Vec3> edges = outline_edges_of_modules(*s.robot);
  for (const MotorData& motor : motor_data(s)) {
    const std::string& name = s.robot->joints[motor.joint].name;
    const double mass = mass_of_module(s, motor.joint);
    const double edge = edges[s.robot->joints[motor.joint].module].maxCoeff();
    if (!(edge > 0) || !(mass > 0)) continue;
    found.push_back(
        {motor_place(s, motor.joint, motor.torque_key),
         {name},
         fmt::format("the stall torque of {}, {:.4g} N m, holds {:.3g} times the weight of its module ({:.4g} kg) at "
                     "a distance of its length ({:.3g} m)",
                     name, motor.torque, motor.torque / (mass * kGravity * edge), mass, edge),
         motor.torque / (mass * kGravity * edge),
         {},
         {},
         {{motor.torque, "N m"}}});
  }
  return found;
}

/// Largest power of all motors of a module together, W, with their torques and speeds corrected.
double power_of(const std::vector<MotorData>& motors, const Slip* slip) {
  double sum = 0;
  for (const MotorData& motor : motors) {
    const double torque = slip != nullptr && slip->input == 0 ? slip->corrected(motor.torque) : motor.torque;
    const double speed = slip != nullptr && slip->input == 1 ? slip->corrected(motor.speed) : motor.speed;
    sum += torque * speed / 4;
  }
  return sum;
}

std::map<std::size_t, std::vector<MotorData>> motors_of_modules(const Scenario& s) {
  std::map<std::size_t, std::vector<MotorData>> modules;
  for (const MotorData& motor : motor_data(s)) modules[s.robot->joints[motor.joint].module].push_back(motor);
  return modules;
}

/// Powers per mass of every module with motors.
std::vector<Finding> powers(const Subject& subject) {
  const Scenario& s = subject.scenario;
  std::vector<Finding> found;
  for (const auto& [module, motors] : motors_of_modules(s)) {
    const double mass = mass_of_module(s, motors.front().joint);
    if (!(mass > 0)) continue;
    const auto weaker = [](const MotorData& a, const MotorData& b) { return a.torque * a.speed < b.torque * b.speed; };
    const MotorData& strongest = *std::max_element(motors.begin(), motors.end(), weaker);
    std::vector<std::string> names;
    for (const MotorData& motor : motors) names.push_back(s.robot->joints[motor.joint].name);
    const double power = power_of(motors, nullptr);
    const std::string whose = motors.size() == 1 ? "the motor of " + names.front()
                                                 : fmt::format("the {} motors of module m{}", motors.size(), module);
    found.push_back({motor_place(s, strongest.joint, strongest.torque_key),
                     names,
                     fmt::format("{} {} up to {:.3g} W ({}stall torque {:.4g} N m x no-load speed {:.4g} rad/s / 4), {:.3g} W "
                                 "per kg of {} module",
                                 whose, motors.size() == 1 ? "gives" : "give", power,
                                 motors.size() == 1 ? "" : "the strongest: ", strongest.torque, strongest.speed, power / mass,
                                 motors.size() == 1 ? "its" : "the"),
                     power / mass,
                     [motors = motors, mass](const Slip& slip) { return power_of(motors, &slip) / mass; },
                     {},
                     {{strongest.torque, "N m"}, {strongest.speed, "rad/s"}}});
  }
  return found;
}

/// Torques at rest above a hundred times m g L of the robot.
std::vector<Impossible> impossible_torques(const Scenario& s) {
  constexpr double kMost = 100;
  const double edge = outline_edges(*s.robot).norm();
  const double held = s.robot->mass * kGravity * edge;  // N m
  std::vector<Impossible> found;
  if (s.actuator.entry == nullptr || !(held > 0)) return found;
  const AvailableTorque available(s);
  const std::size_t joints = s.robot->joints.size();
  std::vector<double> most(joints);
  std::vector<double> unused(joints);
  available.actuator().effort(available.commands(), std::vector<double>(joints, 0.0), most, unused);
  for (std::size_t j = 0; j < joints; ++j) {
    const double times = most[j] / (kMost * held);
    if (!s.robot->joints[j].driven() || !available.known(j) || !(times > 1)) continue;
    found.push_back(
        {times, fmt::format("the motor of {} has {:.4g} N m at rest: {:.3g} times the weight of the whole robot ({:.4g} kg) at "
                            "a distance of its extent ({:.3g} m), but at most {:g} times is possible",
                            s.robot->joints[j].name, most[j], kMost * times, s.robot->mass, edge, kMost)});
  }
  return found;
}

/// Modules whose motors have more power than any motor of their mass.
std::vector<Impossible> impossible_powers(const Scenario& s) {
  constexpr double kMost = 1500;  // W/kg
  std::vector<Impossible> found;
  for (const auto& [module, motors] : motors_of_modules(s)) {
    const double mass = mass_of_module(s, motors.front().joint);
    const double power = power_of(motors, nullptr) / mass;
    if (!(mass > 0) || !(power > kMost)) continue;
    found.push_back(
        {power / kMost, fmt::format("the motors of module m{} ({:.4g} kg) have {:.3g} W: {:.3g} W/kg, but no motor has more "
                                    "than {:g} W/kg",
                                    module, mass, power * mass, power, kMost)});
  }
  return found;
}

/// Finding on a number of each driven joint, `key` of a section: its text, and the number that is judged. Empty if the section
/// lacks the key. Without a unit, a corrected number is not shown.
template <class Text, class Judged>
std::vector<Finding> each_setting(const Scenario& s, const PluginSelection& plugin, const char* section, const char* key,
                                  Text text, Judged judged, const char* unit = nullptr) {
  if (plugin.entry == nullptr) return {};
  const SettingsNumbers numbers(plugin);
  const SettingsNumbers::Found* const values = numbers.find(key);
  std::vector<Finding> found;
  for (std::size_t j = 0; values != nullptr && j < s.robot->joints.size(); ++j) {
    if (!s.robot->joints[j].driven()) continue;
    const std::string& name = s.robot->joints[j].name;
    const double value = values->value[j];
    found.push_back({motor_place(s, j, key, section), {name}, text(name, value, j), judged(value, j), {}, {}, {{value, unit}}});
  }
  return found;
}

std::vector<Finding> voltages(const Subject& subject) {
  return each_setting(
      subject.scenario, subject.scenario.actuator, "actuator", "voltage",
      [](const std::string& name, double value, std::size_t) {
        return fmt::format("the data of the motor of {} are for {} V", name, number_text(value));
      },
      [](double value, std::size_t) { return value; });
}

std::vector<Finding> supplies(const Subject& subject) {
  const Scenario& s = subject.scenario;
  if (s.actuator.entry == nullptr) return {};
  const SettingsNumbers numbers(s.actuator);
  const SettingsNumbers::Found* const data = numbers.find("voltage");
  if (data == nullptr) return {};
  return each_setting(
      s, s.actuator, "actuator", "u_max",
      [&](const std::string& name, double value, std::size_t j) {
        return fmt::format("the supply of the motor of {} is {} V, but its data are for {} V", name, number_text(value),
                           number_text(data->value[j]));
      },
      [&](double value, std::size_t j) { return value > 0 ? value / data->value[j] : 1; });
}

/// Currents `key` of DC motors, relative to the current at rest under the supply.
std::vector<Finding> currents(const Scenario& s, const char* key) {
  if (s.actuator.entry == nullptr || s.robot->joints.empty()) return {};
  const std::unique_ptr<Actuator> actuator = make_motors(s);
  const DcMotor* const motors = actuator == nullptr ? nullptr : actuator->dc_motors();
  if (motors == nullptr) return {};
  const auto stall = [motors](std::size_t j) { return motors[j].u_max / motors[j].R; };
  return each_setting(
      s, s.actuator, "actuator", key,
      [&](const std::string& name, double value, std::size_t j) {
        return fmt::format("{} of {} is {} A, {:.3g} times the current that its motor draws at rest under {:.4g} V, {:.3g} A",
                           key, name, number_text(value), value / stall(j), motors[j].u_max, stall(j));
      },
      [&](double value, std::size_t j) { return stall(j) > 0 ? value / stall(j) : 0; }, "A");
}

std::vector<Finding> continuous_currents(const Subject& subject) { return currents(subject.scenario, "i_continuous"); }
std::vector<Finding> largest_currents(const Subject& subject) { return currents(subject.scenario, "i_max"); }

std::vector<Finding> rotors(const Subject& subject) {
  const Scenario& s = subject.scenario;
  std::map<std::size_t, MotorData> motors;
  for (const MotorData& motor : motor_data(s)) motors[motor.joint] = motor;
  const auto time = [&](double inertia, std::size_t j) {
    const auto motor = motors.find(j);
    return motor == motors.end() ? 0 : inertia * motor->second.speed / motor->second.torque;
  };
  return each_setting(
      s, s.actuator, "actuator", "rotor_inertia",
      [&](const std::string& name, double value, std::size_t j) {
        return fmt::format(
            "rotor_inertia of {} is {} kg m^2 at the joint, so that the motor alone takes {:.3g} s to reach its "
            "speed",
            name, number_text(value), time(value, j));
      },
      time);
}

std::vector<Finding> gains(const Subject& subject) {
  const Scenario& s = subject.scenario;
  if (s.controller.entry == nullptr) return {};
  const std::vector<PositionGains> all = make_controller(s.controller, plugin_info(s))->gains();
  std::vector<Finding> found;
  for (std::size_t j = 0; j < all.size(); ++j) {
    if (!s.robot->joints[j].driven()) continue;
    const std::string& name = s.robot->joints[j].name;
    const double value = all[j].P / all[j].per_key;
    found.push_back(
        {motor_place(s, j, all[j].key, "controller"),
         {name},
         fmt::format("{} of {} is {}, so that the motor turns away from its set point", all[j].key, name, number_text(value)),
         value,
         {},
         {},
         {{value, nullptr}}});
  }
  return found;
}

}  // namespace

std::vector<PlausibleNumber> plausible_motors() {
  return {
      {"no-load speed",
       0.5,
       40,
       "expected 0.5 to 40 rad/s at the joint",
       {{"is it in rev/min", of_rev_per_min},
        {"is it in degrees/s", of_degrees},
        {"is it in s per 60 degrees", of_s_per_60_degrees}},
       {},
       speeds_of_hinges},
      {"wheel speed",
       0.5,
       400,
       "expected 0.5 to 400 rad/s at a joint without stops",
       {{"is it in rev/min", of_rev_per_min}},
       {},
       speeds_of_wheels},
      {"stall torque",
       0,
       60,
       "expected at most 60 times",
       {{"is it in kgf cm", of_kgf_cm}, {"is it in N cm", of_centi}, {"is it in mN m", of_milli}},
       {},
       stall_torques,
       false,
       0.3,
       impossible_torques},
      {"power",
       0,
       100,
       "expected at most 100 W/kg",
       {{"is the torque in kgf cm", of_kgf_cm},
        {"is the torque in N cm", of_centi},
        {"is the speed in rev/min", of_rev_per_min, 1},
        {"is the torque in mN m", of_milli}},
       {"no-load speed", "wheel speed", "stall torque"},
       powers,
       false,
       1,
       impossible_powers},
      {"voltage", 0.5, 1000, "expected 0.5 to 1000 V", {{"is it in mV", of_milli}}, {}, voltages},
      {"supply", 0.3, 3, "expected 0.3 to 3 times the voltage of its data", {}, {"voltage"}, supplies},
      {"continuous current",
       0,
       1,
       "expected less than the current at rest",
       {{"is it in mA", of_milli}},
       {"voltage", "supply", "stall torque"},
       continuous_currents,
       false,
       kLeastShare},
      {"largest current",
       0,
       30,
       "expected at most 30 times the current at rest",
       {{"is it in mA", of_milli}},
       {"voltage", "supply", "stall torque"},
       largest_currents,
       false,
       kLeastShare},
      {"rotor inertia",
       0,
       1,
       "expected at most 1 s",
       {{"is it in kg cm^2", of_square_cm}, {"is it in g cm^2", of_gram_square_cm}},
       {"no-load speed", "wheel speed", "stall torque", "power"},
       rotors,
       false,
       1e-4},
      {"gain", 0, kNoLimit, "expected 0 or more", {{"has it the wrong sign", turned_round}}, {}, gains},
  };
}

}  // namespace gaitlab::report
