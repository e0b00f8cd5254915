#include "actuators/servo.h"

#include <fmt/format.h>

#include <algorithm>

#include "core/laws/data_sheet.h"

namespace gaitlab::actuators {

namespace {

constexpr double kUsualEfficiency = 0.7;   // chosen, equal to that of dc_motor
constexpr double kLeastEfficiency = 0.01;  // chosen, far below any motor with its gear
constexpr double kRounding = 1e-9;         // tolerance for a data sheet whose numbers give an efficiency of exactly 1

/// Returns `make(joint)` for every joint. If no given value differs between joints, `make` is called only once.
template <class Make>
PerJoint of_each(std::initializer_list<const PerJoint*> values, Make make) {
  PerJoint made;
  std::size_t joints = 0;
  for (const PerJoint* value : values) joints = std::max(joints, value->each.size());
  for (std::size_t j = 0; j < joints; ++j) made.each.push_back(make(j));
  if (joints == 0) made.common = make(0);
  return made;
}

}  // namespace

const char* const ServoActuator::kManual =
    R"(A geared DC motor by its data sheet: a straight line from the stall torque to the no-load speed, both at one voltage.

    T = T0 u / V - T0 w / w0    |u| <= u_max
    i = (u - k w) / R           |i| <= i_max

u: command, V; w: joint speed, rad/s; T: torque on the joint, N m; i: current, A. V: voltage, T0: stall_torque, w0: no_load_speed.
It is dc_motor with gear 1 and the constants that the data sheet implies:

    k = V / w0                    Kt = Ks = k, of motor and gear together
    I0 = stall_current            or T0 / (efficiency k) if none is stated
    eta = T0 / (I0 k)             at most 1
    R = V / I0

efficiency_model and turn_speed are those of dc_motor: with directional the line holds while the servo drives, and a servo that
is driven, or held at rest, bears more.

Use servo if a data sheet states torque and speed, as for every hobby servo, and dc_motor if it states the constants of motor
and gear. Units of data sheets: 1 kgf cm = 0.0980665 N m; x s per 60 degrees = 1.0472 / x rad/s.
The stall current changes currents, powers and copper losses, but torques only if efficiency_model is directional. The controller models the electronics of a servo (its position loop, a dead band).
Source: the straight line is that of dc_motor (Chariot, Filippi, Verlinden 2012, eq. 1 and 2); numbers: the servo's data sheet.
efficiency: 0.7 (chosen) if neither efficiency nor stall_current is stated. Takes commands in V.

    actuator:
      {type: servo, voltage: 10, stall_torque: 1.618, no_load_speed: 5.343,
       stall_current: 0.9})";

void ServoActuator::Settings::fields(Fields& f) {
  f.required("voltage", voltage, {"V", kPositive, 1e6, "Voltage at which the other data hold; required."});
  f.required("stall_torque", stall_torque, {"N m", kPositive, 1e9, "Torque of the stalled servo at that voltage; required."});
  f.required("no_load_speed", no_load_speed,
             {"rad/s", kPositive, 1e6, "Speed of the servo without load at that voltage; required."});
  f.rating("stall_current", stall_current, {"A", 0, 1e6, "Current of the stalled servo at that voltage."});
  f.rating("efficiency", efficiency,
           {"", 0, 1, "Efficiency of motor and gear, instead of stall_current; 0.7 if neither is stated."});
  EfficiencyKeys::fields(f);
  const auto that_holds = [&](double DcMotor::*limit) {
    return of_each({&voltage, &stall_torque, &no_load_speed, &stall_current, &efficiency, &u_max, &i_max},
                   [&](std::size_t j) { return motor(j).*limit; });
  };
  const PerJoint usual_voltage = that_holds(&DcMotor::u_max);
  const PerJoint usual_current = that_holds(&DcMotor::i_max);
  f.limit("u_max", u_max, usual_voltage,
          {"V", 0, 1e6, "Supply voltage of the driver: commands are limited to +- this value; 0: the value of `voltage`."});
  f.limit("i_max", i_max, usual_current,
          {"A", 0, 1e6, "Absolute rating: the current is limited to +- this value; 0: the stall current at `u_max`."});
  f.per_joint("rotor_inertia", rotor_inertia, {"kg m^2", 0, 1e3, "Inertia of rotor and gear, at the joint."});
  FrictionKeys::fields(f);
  RatingKeys::fields(f);
  std::size_t joints = 0;
  for (const PerJoint* value : {&voltage, &stall_torque, &no_load_speed, &stall_current, &efficiency})
    joints = std::max(joints, value->each.size());
  bool sound = check(f, 0, joints == 0);
  for (std::size_t j = 1; sound && j < joints; ++j) sound = check(f, j, false);
}

bool ServoActuator::Settings::check(Fields& f, std::size_t joint, bool alone) const {
  if (!(stall_current[joint] > 0)) return true;
  const std::string which = alone ? "" : fmt::format(" (joint number {})", joint);
  if (efficiency[joint] > 0) {
    f.problem("efficiency",
              "efficiency and stall_current are both stated, but one follows from the other; remove one of them" + which);
    return false;
  }
  const double eta = stall_torque[joint] * no_load_speed[joint] / (voltage[joint] * stall_current[joint]);
  if (!(voltage[joint] > 0 && stall_torque[joint] > 0 && no_load_speed[joint] > 0)) return true;
  if (i_continuous[joint] > stall_current[joint]) {
    f.problem("i_continuous",
              fmt::format("i_continuous {:.4g} A is above stall_current, {:.4g} A, the largest current of the motor{}",
                          i_continuous[joint], stall_current[joint], which));
    return false;
  }
  if (eta <= 1 + kRounding && eta >= kLeastEfficiency) return true;
  const std::string torque =
      fmt::format("stall_torque {:.4g} N m at {:.4g} A and {:.4g} rad/s at {:.4g} V would need an efficiency of {:.3g}",
                  stall_torque[joint], stall_current[joint], no_load_speed[joint], voltage[joint], eta);
  f.problem(
      eta > 1 ? "stall_torque" : "stall_current",
      eta > 1
          ? fmt::format(
                "{}; at most 1{}: is the torque in kgf cm ({:.4g} kgf cm are {:.4g} N m), the speed in rev/min "
                "({:.4g} rev/min are {:.4g} rad/s), or is voltage the supply? The data hold at `voltage`; the supply is u_max",
                torque, which, stall_torque[joint], kKgfCm * stall_torque[joint], no_load_speed[joint],
                kRevPerMin * no_load_speed[joint])
          : fmt::format("{}; at least {}: is the current in mA, or the voltage in mV?{}", torque, kLeastEfficiency, which));
  return false;
}

DcMotor ServoActuator::Settings::motor(std::size_t joint) const {
  const double V = voltage[joint];
  const double T0 = stall_torque[joint];
  const double w0 = no_load_speed[joint];
  if (!(V > 0 && T0 > 0 && w0 > 0)) return {};
  const double k = V / w0;
  const double I0 = stall_current[joint] > 0 ? stall_current[joint]
                                             : T0 / ((efficiency[joint] > 0 ? efficiency[joint] : kUsualEfficiency) * k);
  const double R = V / I0;
  const double u = u_max[joint] > 0 ? u_max[joint] : V;
  // At rest with voltage u, the current is u / R bit for bit, so that a joint at stall is not beyond its limit.
  const double i = i_max[joint] > 0 ? i_max[joint] : u / R;
  return {R, k, k, 1.0, std::min(1.0, T0 / (I0 * k)), u, i, reversal_speed()};
}

ServoActuator::ServoActuator(const RobotInfo& robot, const std::vector<const Settings*>& lanes) {
  for (std::size_t j = 0; j < robot.joints.size(); ++j) {
    for (const Settings* s : lanes) add(s->motor(j), s->rotor_inertia[j], s->of(j), s->friction_of(j));
  }
}

}  // namespace gaitlab::actuators
