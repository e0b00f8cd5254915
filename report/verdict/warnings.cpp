#include "report/verdict/warnings.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/laws/dc_motor.h"
#include "core/scenario/built_robot.h"
#include "core/scenario/sensor_section.h"
#include "core/settings/settings_numbers.h"
#include "core/settings/wording.h"
#include "report/analysis/own_overlap.h"
#include "report/verdict/plausibility.h"

namespace gaitlab::report {

namespace {

constexpr double kOvershoots = 1;       // gain of the sampled position loop; at 1 the error is zero at the next tick
constexpr double kCannotSettle = 2;     // gain of the sampled position loop; measured: 1.3 to 1.9 settle, 2.3 does not
constexpr double kRounding = 1 + 1e-9;  // tolerance for products that should be equal
constexpr double kTurn = 2 * std::numbers::pi;

/// Rounds down to two digits: 156.4 becomes 150.
double two_digits(double value) {
  const double unit = std::pow(10.0, std::floor(std::log10(value)) - 1);
  return std::floor(value / unit) * unit;
}

void check_constants(const Scenario& s, const DcMotor* motors, std::vector<Warning>& out) {
  for (std::size_t j = 0; j < s.robot->joints.size(); ++j) {
    const DcMotor& m = motors[j];
    const std::string& name = s.robot->joints[j].name;
    if (!s.robot->joints[j].driven()) continue;
    for (const auto& [key, value] : {std::pair{"Kt", m.Kt}, {"u_max", m.u_max}, {"i_max", m.i_max}}) {
      if (value > 0) continue;
      out.push_back({s.nearest_place(std::string("actuator.") + key),
                     fmt::format("the motor of joint {} makes no torque: {} is {:g}", name, key, value)});
      return;
    }
    if (!(m.Ks > 0)) continue;
    const double apart = std::max(m.Kt / m.Ks, m.Ks / m.Kt);
    if (apart > kConstantsApart) {
      out.push_back(
          {s.nearest_place("actuator.Kt"),
           fmt::format("Kt {:.4g} N m/A and Ks {:.4g} V s/rad of joint {} are one constant in SI units, but differ by a "
                       "factor of {:.3g}: is one in mN m/A or rpm/V? (1 mN m/A = 0.001 N m/A; k rpm/V = {:.4g} / k V s/rad)",
                       m.Kt, m.Ks, name, apart, 60 / kTurn)});
      return;
    }
    if (m.efficiency * m.Kt > kRounding * m.Ks) {
      out.push_back({s.nearest_place("actuator.Kt"),
                     fmt::format("the motor of joint {} makes energy: efficiency x Kt {:.4g} N m/A exceeds Ks {:.4g} V s/rad; "
                                 "take Kt = Ks",
                                 name, m.efficiency * m.Kt, m.Ks)});
      return;
    }
  }
}

/// True if the derivative part responds to a step of the error with more than a quarter of the proportional part, so that it
/// changes the bound on Kp. Its response is Kd N / (Kd + N Ts) (eq. 5).
bool damps(const SettingsNumbers& settings, std::size_t joint, double period) {
  const SettingsNumbers::Found* Kp = settings.find("Kp");
  const SettingsNumbers::Found* Kd = settings.find("Kd");
  const SettingsNumbers::Found* N = settings.find("N");
  if (Kd == nullptr || !(Kd->value[joint] > 0)) return false;
  const double d = Kd->value[joint];
  const double step = N == nullptr ? d / period : d * N->value[joint] / (d + N->value[joint] * period);
  return step > 0.25 * Kp->value[joint];
}

void check_gain(const Scenario& s, const DcMotor* motors, std::vector<Warning>& out) {
  const SettingsNumbers settings(s.controller);
  const auto* gain = settings.find("Kp");
  if (gain == nullptr || make_controller(s.controller, plugin_info(s))->command_unit() != "V") return;
  double largest = 0;
  std::size_t worst = 0;
  for (std::size_t j = 0; j < s.robot->joints.size(); ++j) {
    // A motor without back-EMF has no damping, and the rule does not apply.
    if (!s.robot->joints[j].driven() || !(motors[j].Ks > 0)) continue;
    const double g = gain->value[j] * s.control_period / (motors[j].Ks * motors[j].gear);
    if (!(g > largest) || damps(settings, j, s.control_period)) continue;
    largest = g;
    worst = j;
  }
  if (!(largest > kOvershoots * kRounding)) return;
  const bool severe = largest > kCannotSettle;
  out.push_back({s.nearest_place("controller.Kp"),
                 fmt::format("Kp {:.4g} of joint {} is {} for commands every {:.4g} s: the joint {} (gain {:.3g} per command, "
                             "at most {}); take Kp: {:.4g} or less, or a shorter controller.period",
                             gain->value[worst], s.robot->joints[worst].name, severe ? "too large" : "large", s.control_period,
                             severe ? "cannot settle" : "overshoots", largest, severe ? kCannotSettle : kOvershoots,
                             two_digits(gain->value[worst] / largest)),
                 severe});
}

/// `with_gain` is false if the period or a speed is implausible, which then is the reason of a large gain.
void check_motors(const Scenario& s, bool with_gain, std::vector<Warning>& out) {
  if (s.actuator.entry == nullptr || s.robot->joints.empty()) return;
  const std::unique_ptr<Actuator> actuator = make_motors(s);
  const DcMotor* const motors = actuator->dc_motors();
  if (motors == nullptr) return;
  check_constants(s, motors, out);
  if (s.controller.entry != nullptr && with_gain) check_gain(s, motors, out);
}

/// Notes the overlaps of bodies of one module that do not count.
void note_design(const Scenario& s, std::vector<Warning>& out) {
  for (std::size_t t = 0; t < s.robot->types.size(); ++t) {
    const ModuleType& type = s.robot->types[t];
    DesignOverlap design(type);
    const auto pairs = design.pairs();
    if (pairs.empty()) continue;
    const auto [a, b] = pairs.front();
    const std::string more = pairs.size() > 1 ? fmt::format(" (and {} more pairs)", pairs.size() - 1) : "";
    const bool known = t < s.module_documents->size();
    const double depth = 1000 * design.depth(a, b);  // mm
    out.push_back({known ? (*s.module_documents)[t].place : s.nearest_place("robot"),
                   fmt::format("bodies {} and {} of {} are {:.3g} mm in one another with all hinges at 0{}: only more than "
                               "{:.3g} mm is a collision",
                               type.bodies[a].name, type.bodies[b].name, clipped(type.name), depth, more, kTurned * depth),
                   false});
  }
}

}  // namespace

std::vector<Warning> setup_warnings(const Scenario& s) {
  std::vector<Warning> out;
  try {
    check_accepted(s);
    const Implausible odd = implausible(s);
    out = odd.warnings;
    const auto reported = [&](const char* row) { return std::ranges::find(odd.rows, row) != odd.rows.end(); };
    const bool gain_known = !reported("control period") && !reported("no-load speed") && !reported("wheel speed");
    check_motors(s, gain_known && !reported("gain"), out);
  } catch (const PluginError&) {
    out.clear();  // the run reports the error with its place
  }
  note_design(s, out);
  if (s.ground.beyond_border(s.position.x(), s.position.y())) {
    out.push_back(
        {s.nearest_place("ground.heightfield"),
         fmt::format("the robot starts at ({:.4g}, {:.4g}) m, beside the heightfield, where its edge heights continue: move "
                     "the field under the robot (ground.heightfield.origin) or the robot onto it (robot.position)",
                     s.position.x(), s.position.y())});
  }
  return out;
}

}  // namespace gaitlab::report
