#include "actuators/servo.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>

#include "core/laws/data_sheet.h"

namespace gaitlab::actuators {

namespace {

constexpr double kUsualEfficiency = 0.7;  // chosen, equal to that of dc_motor
constexpr double kTurnSpeed = 0.6;        // rad/s; chosen, equal to that of dc_motor
// Chosen (docs/equations.md, 3): of the three servos whose 208 logs were compared, none fitted to one of them.
constexpr double kUsualDry = 0.03;      // of the stall torque
constexpr double kUsualViscous = 0.1;   // of the stall torque over the no-load speed
constexpr double kUsualInertia = 0.03;  // s, of the stall torque over the no-load speed
constexpr double kUsualLoad = 0.15;
constexpr std::array kPlaces{"motor", "joint"};
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
    R"(A geared DC motor by its data sheet: a straight line from the stall torque to the no-load speed, both at one voltage, which
is the motor before losses; then the losses of gear and friction.

    E = T0 u / V - T0 w / w0     |u| <= u_max, |E| <= T0 by the current limit
    T = eta E                    if the motor drives (E w > 0), E / eta if it is driven
    T - dry_friction sign(w) - viscous_friction w         on the joint; at w = 0 it sticks within these bounds

u: command, V; w: joint speed, rad/s; E, T: torque, N m. V: voltage, T0: stall_torque, w0: no_load_speed.
eta = (1 - load_friction) / (1 + load_friction): the gear eats this share of the sum of motor's and load's torque.
A servo therefore lifts at most eta T0 - dry, and holds at most T0 / eta + dry. Defaults (chosen):

    dry_friction      3 % of T0            viscous_friction  10 % of T0 / w0
    rotor_inertia     0.03 s T0 / w0       load_friction     0.15 (eta 0.74)

With these defaults, and nothing fitted, angles of 16 logs of an XL330 are 43 mrad off on average (182 mrad by the line alone).
stall_torque_at: joint takes T0 and w0 as what the driven joint gives: right for ratings, numbers of a simulator, and numbers
chosen for what a robot does. The motor's line is then raised by the losses. The bare line: all four 0.

    k = V / w0                    constant of motor and gear together
    I0 = stall_current            or T0 / (efficiency k) if none is stated
    i = (u - k w) / R             R = V / I0, |i| <= i_max

The stall current and the efficiency T0 / (I0 k), at most 1, change currents, powers and copper losses, not torques. A motor that
is driven gets back E w at most, also at 0 V. Use servo if a data sheet states torque and speed, as for every hobby servo, and dc_motor if it
states the constants of motor and gear. Units: 1 kgf cm = 0.0980665 N m; x s per 60 degrees = 1.0472 / x rad/s.
Source: line: Chariot, Filippi, Verlinden 2012, eq. 1 and 2; numbers: the servo's data sheet; logs: Rhoban/bam.
efficiency: 0.7 (chosen) if neither efficiency nor stall_current is stated. Takes commands in V.

    actuator:
      {type: servo, voltage: 10, stall_torque: 1.618, no_load_speed: 5.343,
       stall_current: 0.9})";

ServoActuator::Settings::Settings() { dry_friction = viscous_friction = rotor_inertia = load_friction = PerJoint{kNotStated}; }

void ServoActuator::Settings::fields(Fields& f) {
  f.required("voltage", voltage, {"V", kPositive, 1e6, "Voltage at which the other data hold; required."});
  f.required("stall_torque", stall_torque, {"N m", kPositive, 1e9, "Torque of the stalled servo at that voltage; required."});
  f.required("no_load_speed", no_load_speed,
             {"rad/s", kPositive, 1e6, "Speed of the servo without load at that voltage; required."});
  f.choice("stall_torque_at", stall_torque_at, kPlaces,
           "Meaning of these two numbers: `motor`: before the losses of gear and friction; `joint`: of the driven joint.");
  f.rating("stall_current", stall_current, {"A", 0, 1e6, "Current of the stalled servo at that voltage."});
  f.rating("efficiency", efficiency,
           {"", 0, 1, "Efficiency of motor and gear, instead of stall_current; 0.7 if neither is stated. For currents only."});
  const auto of_all = [&](const auto& make) {
    return of_each({&voltage, &stall_torque, &no_load_speed, &stall_current, &efficiency, &dry_friction, &viscous_friction,
                    &rotor_inertia, &load_friction, &u_max, &i_max},
                   make);
  };
  const PerJoint usual_load{kUsualLoad};
  f.per_joint("load_friction", load_friction, usual_load,
              {"", 0, 0.99, "Share of the sum of motor's and load's torque that the gear eats; 0.15 if not stated."});
  const PerJoint usual_dry = of_all([&](std::size_t j) { return friction(j).dry; });
  f.per_joint("dry_friction", dry_friction, usual_dry,
              {"N m", 0, 1e9, "Dry friction of the joint; 3 % of the stall torque if not stated."});
  const PerJoint usual_viscous = of_all([&](std::size_t j) { return friction(j).viscous; });
  f.per_joint(
      "viscous_friction", viscous_friction, usual_viscous,
      {"N m s/rad", 0, 1e9, "Viscous friction of the joint; 10 % of the stall torque over the no-load speed if not stated."});
  const PerJoint usual_voltage = of_all([&](std::size_t j) { return motor(j).u_max; });
  const PerJoint usual_current = of_all([&](std::size_t j) { return motor(j).i_max; });
  f.limit("u_max", u_max, usual_voltage,
          {"V", 0, 1e6, "Supply voltage of the driver: commands are limited to +- this value; 0: the value of `voltage`."});
  f.limit("i_max", i_max, usual_current,
          {"A", 0, 1e6, "Absolute rating: the current is limited to +- this value; 0: the stall current at `voltage`."});
  const PerJoint usual_inertia = of_all([&](std::size_t j) { return inertia(j); });
  f.per_joint("rotor_inertia", rotor_inertia, usual_inertia,
              {"kg m^2", 0, 1e3,
               "Inertia of rotor and gear, at the joint; 0.03 s times stall torque over no-load speed if not stated."});
  RatingKeys::fields(f);
  std::size_t joints = 0;
  for (const PerJoint* value : {&voltage, &stall_torque, &no_load_speed, &stall_current, &efficiency})
    joints = std::max(joints, value->each.size());
  bool sound = check(f, 0, joints == 0);
  for (std::size_t j = 1; sound && j < joints; ++j) sound = check(f, j, false);
}

bool ServoActuator::Settings::check(Fields& f, std::size_t joint, bool alone) const {
  const std::string which = alone ? "" : fmt::format(" (joint number {})", joint);
  const double bound = stall_torque[joint] / no_load_speed[joint];
  if (stall_torque_at == StallTorqueAt::joint && no_load_speed[joint] > 0 && !(friction(joint).viscous < bound)) {
    f.problem(
        "viscous_friction",
        fmt::format("viscous_friction {:.4g} N m s/rad takes all of stall_torque at no_load_speed; expected below {:.4g} N m "
                    "s/rad with stall_torque_at: joint{}",
                    friction(joint).viscous, bound, which));
    return false;
  }
  if (!(stall_current[joint] > 0)) return true;
  if (efficiency[joint] > 0) {
    f.problem("efficiency",
              "efficiency and stall_current are both stated, but one follows from the other; remove one of them" + which);
    return false;
  }
  if (!(voltage[joint] > 0 && stall_torque[joint] > 0 && no_load_speed[joint] > 0)) return true;
  const Line raised = line(joint);
  const double eta = raised.torque * raised.speed / (voltage[joint] * stall_current[joint]);
  if (i_continuous[joint] > stall_current[joint]) {
    f.problem("i_continuous",
              fmt::format("i_continuous {:.4g} A is above stall_current, {:.4g} A, the largest current of the motor{}",
                          i_continuous[joint], stall_current[joint], which));
    return false;
  }
  if (eta <= 1 + kRounding && eta >= kLeastEfficiency) return true;
  const bool raises = stall_torque_at == StallTorqueAt::joint;
  const std::string torque = fmt::format(
      "stall_torque {:.4g} N m at {:.4g} A and {:.4g} rad/s at {:.4g} V{} would need an efficiency of {:.3g}", raised.torque,
      stall_current[joint], raised.speed, voltage[joint], raises ? ", raised by stall_torque_at: joint," : "", eta);
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

double ServoActuator::Settings::load(std::size_t joint) const {
  const double stated = load_friction[joint];
  return efficiency_of_load(stated != kNotStated ? stated : kUsualLoad);
}

JointFriction ServoActuator::Settings::friction(std::size_t joint) const {
  const double T0 = stall_torque[joint];
  const double w0 = no_load_speed[joint];
  const bool any = T0 > 0 && w0 > 0;
  return {dry_friction[joint] != kNotStated ? dry_friction[joint]
          : any                             ? kUsualDry * T0
                                            : 0,
          viscous_friction[joint] != kNotStated ? viscous_friction[joint]
          : any                                 ? kUsualViscous * T0 / w0
                                                : 0};
}

double ServoActuator::Settings::inertia(std::size_t joint) const {
  if (rotor_inertia[joint] != kNotStated) return rotor_inertia[joint];
  return no_load_speed[joint] > 0 ? kUsualInertia * stall_torque[joint] / no_load_speed[joint] : 0;
}

ServoActuator::Settings::Line ServoActuator::Settings::line(std::size_t joint) const {
  const double T0 = stall_torque[joint];
  const double w0 = no_load_speed[joint];
  if (stall_torque_at == StallTorqueAt::motor) return {T0, w0};
  const JointFriction lost = friction(joint);
  const double rest = (T0 + lost.dry) / load(joint);
  const double free = (lost.dry + lost.viscous * w0) / load(joint);
  return {rest, w0 * rest / (rest - free)};
}

DcMotor ServoActuator::Settings::motor(std::size_t joint) const {
  const double V = voltage[joint];
  if (!(V > 0 && stall_torque[joint] > 0 && no_load_speed[joint] > 0)) return {};
  const auto [T0, w0] = line(joint);
  const double k = V / w0;
  const double I0 = stall_current[joint] > 0 ? stall_current[joint]
                                             : T0 / ((efficiency[joint] > 0 ? efficiency[joint] : kUsualEfficiency) * k);
  const double R = V / I0;
  const double u = u_max[joint] > 0 ? u_max[joint] : V;
  // At rest with the voltage V, the current is V / R bit for bit, so that a joint at stall is not beyond its limit.
  const double i = i_max[joint] > 0 ? i_max[joint] : V / R;
  const double eta = load(joint);
  return {R, k, k, 1.0, std::min(1.0, T0 / (I0 * k)), u, i, eta, eta < 1 ? kTurnSpeed : 0, 1};
}

ServoActuator::ServoActuator(const RobotInfo& robot, const std::vector<const Settings*>& lanes) {
  for (std::size_t j = 0; j < robot.joints.size(); ++j) {
    for (const Settings* s : lanes) add(s->motor(j), s->inertia(j), s->of(j), s->friction(j));
  }
}

}  // namespace gaitlab::actuators
