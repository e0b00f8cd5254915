#include "report/verdict/warnings.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/laws/joint_friction.h"
#include "core/scenario/built_robot.h"
#include "core/settings/wording.h"
#include "report/analysis/own_overlap.h"
#include "report/verdict/evidence.h"
#include "report/verdict/leg_sag.h"
#include "report/verdict/plausible/plausibility.h"
#include "report/verdict/position_loop.h"

namespace gaitlab::report {

namespace {

constexpr double kOvershoots = 0.5;     // share of the bound; without delay, one command then removes the whole error
constexpr double kStep = 0.1;           // share of the torque at rest; chosen
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
    if (std::string text = makes_energy(m, name); !text.empty()) {
      out.push_back({s.nearest_place("actuator.Kt"), std::move(text)});
      return;
    }
  }
}

/// Warns of the first joint that its motor cannot turn, and of joints that creep.
void check_friction(const Scenario& s, const Actuator& actuator, std::vector<Warning>& out) {
  const std::span<const JointFriction> friction = actuator.friction();
  if (friction.empty()) return;
  const DcMotor* const motors = actuator.dc_motors();
  const std::vector<double> rest(friction.size());
  std::vector<double> most(friction.size());
  std::vector<double> unused(friction.size());
  actuator.effort(actuator.command_limit(), rest, most, unused);
  bool dry = false;
  for (std::size_t j = 0; j < friction.size(); ++j) {
    if (!s.robot->joints[j].driven()) continue;
    dry = dry || friction[j].dry > 0;
    const double lifts = most[j] * (motors == nullptr ? 1 : motors[j].load);
    if (!(friction[j].dry >= lifts)) continue;
    out.push_back({s.nearest_place("actuator.dry_friction"),
                   fmt::format("the motor of joint {} cannot turn it: dry_friction is {:.4g} N m, and the motor gives at most "
                               "{:.4g} N m at rest",
                               s.robot->joints[j].name, friction[j].dry, lifts)});
    break;
  }
  if (dry && s.physics.integrator->limited && s.contact.law == ContactLaw::penalty) {
    out.push_back(
        {s.nearest_place("physics.integrator"),
         fmt::format("integrator {} has no joints that stick: dry friction is smooth below {:g} rad/s, and a held joint "
                     "creeps; take integrator: adaptive",
                     s.physics.integrator->name, CreepingFriction<double>::kCreep)});
  }
}

/// Warns of the loop that is nearest to its bound, or beyond it.
void check_gain(const Scenario& s, const std::vector<PositionLoop>& loops, std::vector<Warning>& out) {
  const auto nearest = std::ranges::max_element(loops, {}, &PositionLoop::share);
  if (nearest == loops.end() || !(nearest->share() > kOvershoots * kRounding)) return;
  const bool severe = nearest->share() > 1;
  const double most = severe ? 1 : kOvershoots;
  std::vector<std::string> remedies;
  if (const double Kp = nearest->Kp_of(most); Kp > 0)
    remedies.push_back(fmt::format("{}: {:.4g} or less", nearest->key, two_digits(Kp / nearest->per_key)));
  const double period = nearest->period_of(most);
  const bool own_period = nearest->delay > 0 || nearest->period > nearest->tick;  // the period is that of the encoder
  if (period > 0 && !own_period) remedies.push_back(fmt::format("controller.period: {:.4g} or less", two_digits(period)));
  out.push_back({s.nearest_place(fmt::format("controller.{}", nearest->key)),
                 fmt::format("{} {:.4g} of joint {} is {} for {}: the joint {} (gain {:.4g} per command, at most {:.3g}){}",
                             nearest->key, nearest->Kp / nearest->per_key, s.robot->joints[nearest->joint].name,
                             severe ? "too large" : "large", commands_text(*nearest),
                             nearest->gain() > kNeverSettles ? "cannot settle"
                             : severe                        ? "may not settle"
                                                             : "overshoots",
                             nearest->gain(), most * nearest->settles(),
                             remedies.empty() ? "" : fmt::format("; take {}", fmt::join(remedies, ", or "))),
                 severe});
}

/// Warns if one step of a measured angle commands a large share of the torque at rest.
void check_encoder(const Scenario& s, const std::vector<PositionLoop>& loops, std::vector<Warning>& out) {
  const auto share = [](const PositionLoop& loop) { return loop.step / loop.stall; };
  const auto most = std::ranges::max_element(loops, {}, share);
  if (most == loops.end() || !(share(*most) > kStep * kRounding)) return;
  const double less = kStep / share(*most);
  out.push_back({s.nearest_place("sensors"),
                 fmt::format("one step of the encoder of joint {}, {:.3g} rad, commands {:.3g} N m, {:.3g} % of the {:.3g} N m "
                             "that its motor has at rest: such steps dominate the torques; take resolution: {:.4g} or less, or "
                             "{}: {:.4g} or less",
                             s.robot->joints[most->joint].name, most->resolution, most->step, 100 * share(*most), most->stall,
                             two_digits(most->resolution * less), most->key, two_digits(most->Kp * less / most->per_key))});
}

/// `with_gain` is false if the period or a speed is implausible, which then is the reason of a large gain.
void check_motors(const Scenario& s, bool with_gain, std::vector<Warning>& out) {
  if (s.actuator.entry == nullptr || s.robot->joints.empty()) return;
  const std::unique_ptr<Actuator> actuator = make_motors(s);
  check_friction(s, *actuator, out);
  const DcMotor* const motors = actuator->dc_motors();
  if (motors == nullptr) return;
  check_constants(s, motors, out);
  if (!with_gain) return;
  const std::vector<PositionLoop> loops = position_loops(s);
  check_gain(s, loops, out);
  check_encoder(s, loops, out);
  if (const std::optional<Warning> sag = sag_warning(s)) out.push_back(*sag);
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
                   fmt::format("bodies {} and {} of {} overlap by {:.3g} mm with all hinges at 0{}: only more than {:.3g} mm "
                               "counts as a collision",
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
