#include "cpg/tripod.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <stdexcept>

#include "core/math/functions.h"

namespace gaitlab::cpg {

namespace {
constexpr double kFade = 0.2;  // share of the swing in which the tilt fades
// Rad; near pi / 4 the sole stands on its edge, so that a larger tilt hardly increases the depth.
constexpr double kSteepest = 0.65;
constexpr double kAboutY = 0.9;   // cosine between an axis and y
constexpr double kLowest = 1e-6;  // m, height within which foot points are the lowest
}  // namespace

const char* const Tripod::kManual =
    R"(Alternating groups of legs: one stands and pushes the body on, the other swings forward; legs are found from the assembly.

    stance:  a = A (1 - 2 u)          u: 0 to 1 over the stance, duty_factor of the period
    swing:   a = -A cos(pi s)         s: 0 to 1 over the swing; |a| is never below that of the stance: the leg crosses quickly
    hip = a (towards +x), ankle = -hip + tilt        the foot is flat except for its tilt, which is 0 in the swing
    tilt in stance: so that all feet that stand reach the same depth below their hips,
        l cos(a) + z cos(tilt) + x sin(tilt) = D,   D = (largest l cos(a) of the legs that stand) + z cos(d') + x sin(d')
        d' = d sin^2(pi s), s: progress of the legs that swing (0 while no leg swings); tilt at most 0.65
    tilt in swing: 0; the stance's tilt fades over the first fifth of the swing, and the next stance's grows over the last fifth

l: hip to ankle; z, x: depth of the sole below the ankle and its half length; all from the robot. In order alternate with
duty_factor 0.5 all legs that stand have the same a, and tilt = d sin^2(pi u): the body is low when the feet are farthest and
rises in mid-stance, as in figure 11 of the paper. A square foot that turns about its ankle only ever gets lower, so a swing foot
cannot be lifted; the stance feet stand on their edges instead and lift the body.

A leg (docs/modules.md) has two hinges about y or more, and feet below the last. Groups, counted from the front on each side:
alternate - every other leg, the sides opposite (6 legs: tripods, 4 legs: diagonal pairs); wave - one after another from the
rear to the front, the sides half a period apart (4 legs: with duty_factor 0.75 three should stand at any time). Spine: 0.
Source: Chariot, Filippi, Verlinden 2012, section IV-B and figure 11; angles and timing chosen.

    cpg: {type: tripod, frequency: 0.5, amplitude: 0.4})";

void Tripod::Settings::fields(Fields& f) {
  f.number("frequency", frequency, {"Hz", 0, 20, "Frequency of the whole cycle, stance and swing."});
  f.number("amplitude", amplitude, {"rad", 0, 1.5, "A: a leg swings from -A to +A."});
  f.group("model", model, "Keys that only this type has.");
}

void Tripod::Model::fields(Fields& f) {
  static constexpr const char* kOrders[] = {"alternate", "wave"};
  f.number("tilt", tilt, {"rad", 0, kSteepest, "d: tilt of the standing feet in mid-stance, which lifts the body."});
  f.number("duty_factor", duty_factor, {"", 0.5, 0.95, "Share of the period in which a foot stands."});
  f.choice("order", order, kOrders, "Legs that swing together.");
  f.number("ramp", ramp, {"s", 0, 100, "Duration of the start, in which amplitude and tilt grow from 0."});
  f.flag("reverse", reverse, "Run the gait backwards in time.");
}

std::vector<Tripod::Chain> Tripod::chains(const RobotInfo& robot) {
  std::vector<Chain> all;
  for (const Leg& leg : robot.legs) {
    std::vector<std::size_t> about_y;
    for (const std::int64_t j : leg.joints) {
      if (std::abs(robot.joints[static_cast<std::size_t>(j)].axis[1]) > kAboutY) about_y.push_back(static_cast<std::size_t>(j));
    }
    if (about_y.size() < 2) continue;
    const JointInfo& hip = robot.joints[about_y.front()];
    const JointInfo& ankle = robot.joints[about_y.back()];
    Chain chain{about_y.front(),
                about_y.back(),
                hip.axis[1] > 0 ? 1.0 : -1.0,
                ankle.axis[1] > 0 ? 1.0 : -1.0,
                hip.origin[1] > 0,
                hip.origin[2] - ankle.origin[2]};
    const std::int64_t last = robot.bodies[static_cast<std::size_t>(leg.bodies.back())].module;
    const auto& feet = robot.modules[static_cast<std::size_t>(last)].feet;
    for (const auto& foot : feet) chain.sole_depth = std::max(chain.sole_depth, ankle.origin[2] - foot[2]);
    for (const auto& foot : feet) {
      if (ankle.origin[2] - foot[2] > chain.sole_depth - kLowest)
        chain.sole_reach = std::max(chain.sole_reach, std::abs(foot[0] - ankle.origin[0]));
    }
    if (chain.length > 0 && chain.sole_depth > 0) all.push_back(chain);
  }
  return all;
}

Tripod::Tripod(const RobotInfo& robot, const Settings& settings) : joints_(robot.joints.size()), s_(settings) {
  const std::vector<Chain> legs = chains(robot);
  const auto left =
      static_cast<std::size_t>(std::count_if(legs.begin(), legs.end(), [](const Chain& leg) { return leg.left; }));
  if (legs.size() < 4 || 2 * left != legs.size()) {
    throw std::invalid_argument("it needs legs in pairs, four or more; found " + std::to_string(left) + " on the left and " +
                                std::to_string(legs.size() - left) +
                                " on the right (a leg has two hinges about y or more, and feet below)");
  }
  std::size_t rank[2] = {0, 0};  // number of the next leg, counted from the front: right, left
  for (const Chain& leg : legs) {
    const std::size_t at = rank[leg.left ? 1 : 0]++;
    const bool other = (at + (leg.left ? 1 : 0)) % 2 == 1;
    const double from_rear = static_cast<double>(left - 1 - at);
    const double wave = (leg.left ? 0.5 : 0.0) - from_rear * (1 - s_.model.duty_factor);
    steps_.push_back({leg, s_.model.order == Order::alternate ? (other ? 0.5 : 0.0) : wave});
  }
}

Tripod::Motion Tripod::motion(const Step& step, double cycles, double amplitude) const {
  const double at = cycles + step.phase;
  const double p = at - std::floor(at);
  const double duty = s_.model.duty_factor;
  if (p < duty) return {true, p / duty, amplitude * (1 - 2 * p / duty)};
  const double s = (p - duty) / (1 - duty);
  return {false, s, -amplitude * math::cos(std::numbers::pi * s)};
}

/// Tilt of the foot at which its lowest point is `height` below the ankle, from z cos(tilt) + x sin(tilt) = height.
double Tripod::tilt_to_reach(const Chain& leg, double height) {
  const double longest = std::sqrt(leg.sole_depth * leg.sole_depth + leg.sole_reach * leg.sole_reach);
  const double flat = math::atan2(leg.sole_depth, leg.sole_reach);
  return std::clamp(math::asin(std::min(1.0, height / longest)) - flat, 0.0, kSteepest);
}

/// The depth that flat feet without lift would reach, and the lift: D of the manual without the foot's part, which differs from
/// leg to leg.
Tripod::Depth Tripod::depth(double cycles, double grown) const {
  Depth d;
  for (const Step& step : steps_) {
    const Motion m = motion(step, cycles, grown * s_.amplitude);
    const double bump = math::sin(std::numbers::pi * m.progress);
    if (!m.stands) d.lift = std::max(d.lift, grown * s_.model.tilt * bump * bump);
    if (m.stands) d.reach = std::max(d.reach, step.leg.length * math::cos(m.forward));
  }
  return d;
}

double Tripod::tilt(const Chain& leg, const Depth& d, double forward) {
  const double below_hip = d.reach + leg.sole_depth * math::cos(d.lift) + leg.sole_reach * math::sin(d.lift);
  return tilt_to_reach(leg, below_hip - leg.length * math::cos(forward));
}

void Tripod::output(double t, In, Out setpoint) const {
  std::fill(setpoint.begin(), setpoint.end(), 0.0);
  const double grown = t < s_.model.ramp ? t / s_.model.ramp : 1;
  const double cycles = (s_.model.reverse ? -t : t) * s_.frequency;
  const double amplitude = grown * s_.amplitude;
  const Depth now = depth(cycles, grown);
  const double swing = 1 - s_.model.duty_factor;  // share of the period
  for (const Step& step : steps_) {
    const Motion m = motion(step, cycles, amplitude);
    double tilted = 0;
    if (m.stands) {
      tilted = tilt(step.leg, now, m.forward);
    } else if (m.progress < kFade) {
      // The tilt fades from its value at the end of the stance, because an ankle cannot jump.
      const Depth then = depth(cycles - m.progress * swing, grown);
      tilted = (1 - m.progress / kFade) * tilt(step.leg, then, amplitude);
    } else if (m.progress > 1 - kFade) {
      const Depth then = depth(cycles + (1 - m.progress) * swing, grown);
      tilted = (1 - (1 - m.progress) / kFade) * tilt(step.leg, then, amplitude);
    }
    // A motion towards +x of a leg that hangs down is a left-hand turn about +y.
    setpoint[step.leg.hip] = -step.leg.hip_sign * m.forward;
    setpoint[step.leg.ankle] = step.leg.ankle_sign * (m.forward - tilted);
  }
}

std::string Tripod::note() const { return std::to_string(steps_.size()) + " legs found"; }

}  // namespace gaitlab::cpg
