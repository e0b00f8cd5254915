#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <set>

#include "core/laws/dc_motor.h"
#include "core/model/outline.h"
#include "core/robot_files/type_presets.h"
#include "core/scenario/built_robot.h"
#include "core/settings/wording.h"
#include "report/analysis/settings_numbers.h"
#include "report/verdict/plausible_number.h"
#include "report/verdict/warnings.h"

namespace gaitlab::report {

namespace {

constexpr double kGravity = 9.81;  // m/s^2, of the rule of thumb

double of_kgf_cm(double value) { return value * 0.0980665; }
double of_rev_per_min(double value) { return value * 2 * std::numbers::pi / 60; }
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
    MotorData one{j, m.efficiency * m.gear * m.Kt * std::min(m.u_max / m.R, m.i_max), m.u_max / (m.Ks * m.gear)};
    if (torque != nullptr && speed != nullptr) one = {j, torque->value[j], speed->value[j], "stall_torque", "no_load_speed"};
    if (torque == nullptr && !one_constant) continue;
    if (one.torque > 0 && one.speed > 0 && std::isfinite(one.torque + one.speed)) all.push_back(one);
  }
  return all;
}

/// Place of a motor's key: in the scenario, else in the map of the hinge, else in that of the module type.
SourceLocation motor_place(const Scenario& s, std::size_t joint, const char* key) {
  const SourceLocation own = s.place(std::string("actuator.") + key);
  if (own.line > 0 || own.file != s.file) return own;
  const Module& module = s.robot->modules[s.robot->joints[joint].module];
  if (module.type >= s.module_documents->size()) return own;
  const Node& document = (*s.module_documents)[module.type];
  const std::string& name = s.robot->joints[joint].name;
  const Node* const hinges = document.find("hinges");
  for (std::size_t i = 0; hinges != nullptr && i < hinges->items.size(); ++i) {
    const Node* const hinge = hinges->items[i].find("name");
    const Node* const motor = hinges->items[i].find("actuator");
    const Node* const value = motor == nullptr ? nullptr : motor->find(key);
    if (value != nullptr && hinge != nullptr && name.ends_with("/" + hinge->text)) return value->place;
  }
  const Node* const motor = document.find("actuator");
  const Node* const value = motor == nullptr ? nullptr : motor->find(key);
  return value != nullptr ? value->place : s.nearest_place("actuator");
}

double mass_of_module(const Scenario& s, std::size_t joint) {
  double mass = 0;
  const Module& module = s.robot->modules[s.robot->joints[joint].module];
  for (const BodyType& body : s.robot->types[module.type].bodies) mass += body.mass;
  return mass;
}

std::vector<Finding> speeds_without_load(const Subject& subject) {
  const Scenario& s = subject.scenario;
  std::vector<Finding> found;
  for (const MotorData& motor : motor_data(s)) {
    const std::string& name = s.robot->joints[motor.joint].name;
    found.push_back({motor_place(s, motor.joint, motor.speed_key),
                     {name},
                     fmt::format("the motor of {} turns at {:.4g} rad/s without load", name, motor.speed),
                     motor.speed,
                     {},
                     {{motor.speed, "rad/s"}}});
  }
  return found;
}

std::vector<Finding> stall_torques(const Subject& subject) {
  const Scenario& s = subject.scenario;
  std::vector<Finding> found;
  for (const MotorData& motor : motor_data(s)) {
    const std::string& name = s.robot->joints[motor.joint].name;
    const double mass = mass_of_module(s, motor.joint);
    const double edge = outline_edges(*s.robot, s.robot->joints[motor.joint].module).maxCoeff();
    if (!(edge > 0) || !(mass > 0)) continue;
    found.push_back(
        {motor_place(s, motor.joint, motor.torque_key),
         {name},
         fmt::format("the stall torque of {}, {:.4g} N m, holds {:.3g} times the weight of its module ({:.4g} kg) at "
                     "a distance of its length ({:.3g} m)",
                     name, motor.torque, motor.torque / (mass * kGravity * edge), mass, edge),
         motor.torque / (mass * kGravity * edge),
         {},
         {{motor.torque, "N m"}}});
  }
  return found;
}

std::vector<Finding> powers(const Subject& subject) {
  const Scenario& s = subject.scenario;
  std::vector<Finding> found;
  for (const MotorData& motor : motor_data(s)) {
    const std::string& name = s.robot->joints[motor.joint].name;
    const double mass = mass_of_module(s, motor.joint);
    if (!(mass > 0)) continue;
    const auto power = [mass](double torque, double speed) { return torque * speed / 4 / mass; };
    const double now = power(motor.torque, motor.speed);
    found.push_back({motor_place(s, motor.joint, motor.torque_key),
                     {name},
                     fmt::format("the motor of {} gives up to {:.3g} W (stall torque {:.4g} N m x no-load speed {:.4g} rad/s / "
                                 "4), {:.3g} W per kg of its module",
                                 name, now * mass, motor.torque, motor.speed, now),
                     now,
                     [power, motor](const Slip& slip) {
                       return slip.input == 0 ? power(slip.corrected(motor.torque), motor.speed)
                                              : power(motor.torque, slip.corrected(motor.speed));
                     },
                     {{motor.torque, "N m"}, {motor.speed, "rad/s"}}});
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
       speeds_without_load},
      {"stall torque",
       0,
       60,
       "expected at most 60",
       {{"is it in kgf cm", of_kgf_cm}, {"is it in N cm", of_centi}, {"is it in mN m", of_milli}},
       {},
       stall_torques},
      {"power",
       0,
       40,
       "expected at most 40 W/kg",
       {{"is the torque in kgf cm", of_kgf_cm},
        {"is the torque in N cm", of_centi},
        {"is the speed in rev/min", of_rev_per_min, 1},
        {"is the torque in mN m", of_milli}},
       {"no-load speed", "stall torque"},
       powers},
  };
}

}  // namespace gaitlab::report
