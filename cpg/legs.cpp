#include "cpg/legs.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <numbers>
#include <tuple>

#include "cpg/stance.h"

namespace gaitlab::cpg {

namespace {
constexpr double kUsualLift = 0.1;  // share of the height of the stance
constexpr double kAcross = 0.1;     // weight of the direction across the way, for a leg of one or two joints
constexpr double kDamping = 1e-3;   // of the angles of a leg
constexpr int kNext = 4;            // steps of least squares from point to point of a way
constexpr std::size_t kNone = static_cast<std::size_t>(-1);
constexpr std::array kSteeredNames{"speed", "side", "turn"};
constexpr double kMissed = 0.2;  // largest error of a foot without a note, as a share of the distance that it moves

std::string digits(double value) {
  std::array<char, 32> text = {};
  return {text.data(), std::to_chars(text.begin(), text.end(), value, std::chars_format::general, 3).ptr};
}
}  // namespace

const char* const Legs::kManual =
    R"(Feet on given ways, for every robot whose legs are found: docked or imported, with two legs or more.

    stance, time t from -T/2 to T/2, T = duty / f:   x' = -V - turn z (x - c) (vector product),   x(0) = x_0
    swing, share s from 0 to 1:   a cubic from the end of the stance to its beginning, with the speeds of the stance there,
                                  + lift sin^2(pi s) upwards
    body:  every foot + lean w cos(2 pi f t) to the left (only walk and crawl)
    phase of a leg: f t + p, stance while its fraction is below duty
    V = (speed + stride f) forwards + side to the left
    set points: stance angles + min(1, t / ramp) (angles of the gait - stance angles)

x_0: foot in the stance, z: upwards, c: middle of all feet, w: half the track (largest distance of a foot from c to the side). The angles of
128 points of a cycle follow by damped least squares, with weight 1 along the way of the foot and upwards, and across it 1 for
legs of three joints or more, 0.1 for others; between them set points are linear. If the feet hold, the body moves with V
and turns with turn. Other joints stand still.

    gait                      duty       p, as a lead
    trot, tripod, alternate   0.5        0 and 0.5 in turn around the robot: diagonal pairs, tripods
    pace; bound               0.5        right; rear legs 0.5
    gallop                    0.4        rear legs 0.5, right legs 0.1 more
    walk; crawl               0.75;0.85  from rear to front, sides 0.5 apart
    wave                      1-1/n      the same, n legs
    ripple                    0.75       neighbours 0.25 apart, sides 0.5

With a leg on the midline, the legs of walk, crawl, wave and ripple follow one another around the robot. `phases` replaces p (with lean: 0
in walk and crawl, because the lean belongs to their own phases), `duty` the duty.

Stance: initial.angles, if they are stated; otherwise feet below the hips, at `stance` times the length of a leg. The
robot starts there.

With `steering`, the name of a sensor of type steering, its values speed (m/s), side (m/s) and turn (rad/s) replace these keys. Each is
limited to -10 to 10, and all are reduced in the same proportion if a foot would move by more than the least 2 sqrt(L^2 - l^2) in a stance
(L: length of a leg, l: from hip to foot). The gait follows them with the time constant T/4, from 0. The angles are then computed at every
control tick, by the same least squares from those of the tick before, which takes three times as long as the table. States: angle.J, and
speed, side, turn in force.

Balance is not controlled: pace, bound and gallop may fall. A robot of straight legs with flat feet, such as
the hexapod of M-TRAN modules, walks with type tripod. Legs: docs/modules.md.
Reference: S. Buss, Introduction to inverse kinematics, 2009 (damped least squares); gaits and stance chosen.

    cpg: {type: legs, frequency: 1.5, model: {gait: trot, stride: 0.15}})";

void Legs::Settings::fields(Fields& f) {
  f.number("frequency", frequency, {"Hz", 0.01, 20, "Frequency of the cycle of stance and swing."});
  f.group("model", model, "Keys that only this type has.");
}

void Legs::Model::fields(Fields& f) {
  f.choice("gait", gait, kGaitNames, "Phases of the legs.");
  f.number("stride", stride, {"m", -10, 10, "Way of the body in a cycle, forwards (base frame, +x)."});
  f.number("speed", speed, {"m/s", -10, 10, "Speed forwards, instead of stride."});
  f.number("side", side, {"m/s", -10, 10, "Speed to the left."});
  f.number("turn", turn, {"rad/s", -10, 10, "Yaw rate, to the left."});
  f.number_or("lift", lift, "usual", {"m", 1e-5, 1, "Height of a foot in mid-swing; usual: 0.1 of the height of the stance."});
  f.number_or("duty", duty, "usual", {"", 0.01, 0.95, "Share of the cycle in which a leg stands; usual: the gait's."});
  f.number("lean", lean,
           {"", 0, 1, "Lean of the body over the legs that stand, as a share of half the track; only walk and crawl."});
  f.number_or("stance", stance, "usual",
              {"", 0.1, 0.98,
               "Height of the hips in the stance, as a share of the length of a leg; usual: 0.75, or less near a stop."});
  f.number("ramp", ramp, {"s", 0.1, 100, "Duration of the start, in which the motion grows from the stance."});
  f.numbers(
      "phases", phases,
      {"", -100, 100, "Leads p of the legs, shares of the cycle, in the order of `gaitlab check`; without them, the gait's."});
  f.text("steering", steering, "Sensor of type steering, whose values speed, side and turn replace these keys.");
}

Vec3 Legs::Way::foot(const Vec3& from, double time) const {
  constexpr double kSeries = 1e-4;  // rad, below which the terms of higher order are beyond the rounding
  const double angle = turn * time;
  const bool small = std::abs(angle) < kSeries;
  const double along = small ? 1 - angle * angle / 6 : math::sin(angle) / angle;
  const double across = small ? angle / 2 : (1 - math::cos(angle)) / angle;
  const Vec3 way = time * (along * velocity - across * up.cross(velocity));  // integral of R(-turn t) v
  return middle + gaitlab::turn(up, -angle) * (from - middle) - way;
}

Vec3 Legs::Way::speed(const Vec3& from, double time) const { return -turn * up.cross(foot(from, time) - middle) - velocity; }

Vec3 Legs::target(const Way& way, const Vec3& from, double share, double lead) const {
  const double stance = duty_ / s_.frequency;       // s
  const double swing = (1 - duty_) / s_.frequency;  // s
  const Vec3 lean = way.left * (way.lean * math::cos(2 * std::numbers::pi * (share - lead)));
  if (share < duty_) return way.foot(from, stance * (share / duty_ - 0.5)) + lean;
  const double s = (share - duty_) / (1 - duty_);
  const double s2 = s * s;
  const double s3 = s2 * s;
  const double up = math::sin(std::numbers::pi * s);
  return (2 * s3 - 3 * s2 + 1) * way.foot(from, stance / 2) + (s3 - 2 * s2 + s) * swing * way.speed(from, stance / 2) +
         (-2 * s3 + 3 * s2) * way.foot(from, -stance / 2) + (s3 - s2) * swing * way.speed(from, -stance / 2) +
         way.up * (lift_ * up * up) + lean;
}

Mat3 Legs::weights_of(const Way& way, const Step& step) const {
  const double half = duty_ / s_.frequency / 2;
  Vec3 along = way.foot(step.from, -half) - way.foot(step.from, half);
  const Vec3 forward = way.left.cross(way.up);
  along = along.norm() > 1e-9 ? along.normalized() : forward;
  Mat3 weights;
  weights.row(0) = along;
  weights.row(1) = way.up;
  weights.row(2) = (step.joints.size() >= 3 ? 1 : kAcross) * way.up.cross(along);
  return weights;
}

void Legs::plan(const LegKinematics& leg, const Way& way, Step& step) const {
  constexpr int kFirst = 30;  // steps at the first point
  const Mat3 weights = weights_of(way, step);
  std::vector<double> q = stance_;
  step.angles.resize(kSamples * step.joints.size());
  for (int round = 0; round < 2; ++round) {  // the second begins where the first ended, so that the cycle closes
    for (std::size_t k = 0; k < kSamples; ++k) {
      const Vec3 to = target(way, step.from, static_cast<double>(k) / kSamples, step.phase);
      leg.reach(to, weights, kDamping, round == 0 && k == 0 ? kFirst : kNext, q);
      for (std::size_t i = 0; i < step.joints.size(); ++i) step.angles[k * step.joints.size() + i] = q[step.joints[i]];
      if (round == 1) step.error = std::max(step.error, (to - leg.foot(q)).norm());
    }
  }
}

Legs::Legs(const RobotInfo& robot, const Settings& settings) : s_(settings) {
  if (robot.legs.empty()) {
    throw std::invalid_argument(
        "found no legs: no two chains of links without branches end near the ground at the start (an arm and a snake have "
        "none); set initial.angles so that the robot stands, or state the legs: robot: {legs: {NAME: BODY}}");
  }
  if (s_.model.stance > 0 && robot.start_stated)
    throw SettingError("model.stance", "stance and initial.angles are both given; expected one");
  if (s_.model.stride != 0 && s_.model.speed != 0)
    throw SettingError("model.speed", "stride and speed are both given; expected one");
  find_steering(robot);
  for (const Leg& leg : robot.legs) legs_.emplace_back(robot, leg);
  stance_ = stance_of(robot, legs_, s_.model.stance);
  still_.up = vector_of(robot.up);
  still_.left = still_.up.cross(forwards(still_.up));
  still_.middle.setZero();
  for (const LegKinematics& leg : legs_) still_.middle += leg.foot(stance_) / static_cast<double>(legs_.size());
  double track = 0, height = 0;
  for (const LegKinematics& leg : legs_) {
    const Vec3 foot = leg.foot(stance_);
    track = std::max(track, std::abs(still_.left.dot(foot - still_.middle)));
    height = std::max(height, still_.up.dot(leg.hip(stance_) - foot));
  }
  still_.lean = leans(s_.model.gait) ? s_.model.lean * track : 0;
  const Way way = way_of({s_.model.speed + s_.model.stride * s_.frequency, s_.model.side, s_.model.turn});
  duty_ = s_.model.duty > 0 ? s_.model.duty : duty_of(s_.model.gait, robot.legs);
  lift_ = s_.model.lift > 0 ? s_.model.lift : kUsualLift * height;
  reach_ = std::numeric_limits<double>::infinity();
  for (const LegKinematics& leg : legs_) reach_ = std::min(reach_, 2 * leg.length());
  if (const double feet = way.velocity.norm() * duty_ / s_.frequency; feet > reach_) {
    throw SettingError(s_.model.stride != 0 ? "model.stride" : "model.speed",
                       digits(way.velocity.norm()) + " m/s at " + digits(s_.frequency) + " Hz needs feet that move " +
                           digits(feet) + " m in a stance; these legs reach " + digits(reach_) +
                           " m: take a higher frequency, a shorter stride or a smaller duty");
  }
  const std::vector<double> leads = phases(robot);
  for (std::size_t l = 0; l < legs_.size(); ++l) {
    Step step{{robot.legs[l].joints.begin(), robot.legs[l].joints.end()}, leads[l], {}, 0, legs_[l].foot(stance_)};
    plan(legs_[l], way, step);
    moved_.insert(moved_.end(), step.joints.begin(), step.joints.end());
    steps_.push_back(std::move(step));
  }
  longest_ = std::numeric_limits<double>::infinity();
  for (const LegKinematics& leg : legs_) {
    const double straight = (leg.hip(stance_) - leg.foot(stance_)).squaredNorm();
    longest_ = std::min(longest_, 2 * std::sqrt(std::max(0.0, leg.length() * leg.length() - straight)));
  }
  follow_ = 1 - math::exp(-4 * s_.frequency * robot.control_period);
  angles_ = stance_;
  describe(robot, way, height);
}

std::vector<double> Legs::phases(const RobotInfo& robot) const {
  const std::vector<double>& given = s_.model.phases;
  if (given.empty()) return phases_of(s_.model.gait, robot.legs);
  if (leans(s_.model.gait) && s_.model.lean > 0) {
    throw SettingError("model.phases",
                       "model.phases is given, and the body leans over the phases of the gait; expected lean: 0");
  }
  if (given.size() == robot.legs.size()) return given;
  std::string names;
  for (const Leg& leg : robot.legs) names += (names.empty() ? "" : ", ") + leg.name;
  throw SettingError("model.phases", "model.phases has " + std::to_string(given.size()) + " numbers; the robot has " +
                                         std::to_string(robot.legs.size()) + " legs: " + names);
}

/// Finds the channels of the steered values.
void Legs::find_steering(const RobotInfo& robot) {
  channel_.fill(kNone);
  if (!steered()) return;
  std::string wanted;
  bool any = false;
  for (std::size_t k = 0; k < kSteered; ++k) {
    const std::string name = s_.model.steering + "." + kSteeredNames[k];
    wanted += (k == 0 ? "" : k + 1 == kSteered ? " or " : ", ") + name;
    const auto at = std::ranges::find(robot.channels, name);
    if (at == robot.channels.end()) continue;
    channel_[k] = static_cast<std::size_t>(at - robot.channels.begin());
    any = true;
  }
  std::string known;
  for (const std::string& name : robot.channels) known += (known.empty() ? "" : ", ") + name;
  if (!any) {
    throw SettingError("model.steering",
                       "model.steering: no sensor gives " + wanted +
                           (known.empty() ? "; add sensors: {remote: {type: steering, values: {turn: {unit: rad/s, value: "
                                            "0.2}}}}, and steering: remote"
                                          : "; the sensors give " + known));
  }
  for (const std::string& name : robot.channels) {
    const bool own = name.starts_with(s_.model.steering + ".");
    const auto known_name = [&](const char* one) { return name == s_.model.steering + "." + one; };
    if (own && std::ranges::none_of(kSteeredNames, known_name)) {
      throw SettingError("model.steering",
                         "legs do not follow '" + name + "'; expected " + wanted + ", or another sensor for it");
    }
  }
  const Model& m = s_.model;
  const std::array<std::tuple<const char*, double, std::size_t>, 4> keys{
      {{"stride", m.stride, 0}, {"speed", m.speed, 0}, {"side", m.side, 1}, {"turn", m.turn, 2}}};
  for (const auto& [key, value, k] : keys) {
    if (channel_[k] == kNone || value == 0) continue;
    throw SettingError(std::string("model.") + key, std::string(key) + " is given, and " + kSteeredNames[k] +
                                                        " is steered by '" + m.steering + "'; expected one");
  }
}

/// The way with these speeds: forwards (m/s), to the left (m/s), turning (rad/s).
Legs::Way Legs::way_of(const std::array<double, kSteered>& speeds) const {
  Way way = still_;
  way.velocity = forwards(way.up) * speeds[0] + way.left * speeds[1];
  way.turn = speeds[2];
  return way;
}

void Legs::describe(const RobotInfo& robot, const Way& way, double height) {
  note_ = std::to_string(steps_.size()) + (steps_.size() == 1 ? " leg:" : " legs:");
  for (const Leg& leg : robot.legs) note_ += (leg.name == robot.legs.front().name ? " " : ", ") + leg.name;
  note_ += "; hips " + digits(height) + " m above the feet";
  for (std::size_t k = 0; k < kSteered; ++k) {
    if (channel_[k] != kNone) note_ += "; " + std::string(kSteeredNames[k]) + " from " + robot.channels[channel_[k]];
  }
  std::string missed;
  const double least = way.velocity.norm() * duty_ / s_.frequency;
  for (std::size_t l = 0; l < steps_.size(); ++l) {
    const double whole = std::max(least, lift_);
    if (steps_[l].error > kMissed * whole) {
      missed += (missed.empty() ? "; feet miss their ways: " : ", ") + robot.legs[l].name + " by " +
                digits(1e3 * steps_[l].error) + " mm";
    }
  }
  note_ += missed;
}

/// Position of a leg in its cycle, from 0 to 1.
double Legs::share_of(const Step& step, double t) const {
  const double cycles = t * s_.frequency + step.phase;
  return cycles - std::floor(cycles);
}

/// Angles of the legs from their tables.
void Legs::sample(double t, std::vector<double>& angles) const {
  for (const Step& step : steps_) {
    const double at = share_of(step, t) * kSamples;
    const std::size_t k = std::min(static_cast<std::size_t>(at), kSamples - 1);
    const double part = at - static_cast<double>(k);
    const double* const now = &step.angles[k * step.joints.size()];
    const double* const next = &step.angles[(k + 1) % kSamples * step.joints.size()];
    for (std::size_t i = 0; i < step.joints.size(); ++i) angles[step.joints[i]] = (1 - part) * now[i] + part * next[i];
  }
}

std::string Legs::state_name(std::size_t index) const {
  return index < moved_.size() ? "angle." + std::to_string(moved_[index]) : kSteeredNames[index - moved_.size()];
}

void Legs::start(Out state) const {
  if (!steered()) return;
  sample(0, angles_);
  for (std::size_t i = 0; i < moved_.size(); ++i) state[i] = angles_[moved_[i]];
  state[moved_.size()] = s_.model.speed + s_.model.stride * s_.frequency;
  state[moved_.size() + 1] = s_.model.side;
  state[moved_.size() + 2] = s_.model.turn;
}

void Legs::event(const Measured& m, Out state) const {
  if (!steered()) return;
  constexpr double kMost = 10;  // m/s, rad/s, as of the keys
  std::array<double, kSteered> wanted{s_.model.speed + s_.model.stride * s_.frequency, s_.model.side, s_.model.turn};
  for (std::size_t k = 0; k < kSteered; ++k) {
    if (channel_[k] != kNone) wanted[k] = std::clamp(m.channels[channel_[k]], -kMost, kMost);
  }
  double farthest = 0;  // m, way of a foot in a stance
  for (const Step& step : steps_) {
    const double speed =
        std::sqrt(wanted[0] * wanted[0] + wanted[1] * wanted[1]) + std::abs(wanted[2]) * (step.from - still_.middle).norm();
    farthest = std::max(farthest, speed * duty_ / s_.frequency);
  }
  const double part = farthest > longest_ ? longest_ / farthest : 1;
  const Out speeds = state.subspan(moved_.size());
  for (std::size_t k = 0; k < kSteered; ++k) speeds[k] += follow_ * (part * wanted[k] - speeds[k]);
  const Way way = way_of({speeds[0], speeds[1], speeds[2]});
  for (std::size_t i = 0; i < moved_.size(); ++i) angles_[moved_[i]] = state[i];
  for (std::size_t l = 0; l < steps_.size(); ++l) {
    const Vec3 to = target(way, steps_[l].from, share_of(steps_[l], m.t), steps_[l].phase);
    legs_[l].reach(to, weights_of(way, steps_[l]), kDamping, kNext, angles_);
  }
  for (std::size_t i = 0; i < moved_.size(); ++i) state[i] = angles_[moved_[i]];
}

void Legs::output(double t, In state, Out setpoint) const {
  std::copy(stance_.begin(), stance_.end(), setpoint.begin());
  const double grown = t < s_.model.ramp ? t / s_.model.ramp : 1;
  if (!steered()) sample(t, angles_);
  for (std::size_t i = 0; i < moved_.size(); ++i) {
    double& angle = setpoint[moved_[i]];
    angle += grown * ((steered() ? state[i] : angles_[moved_[i]]) - angle);
  }
}

}  // namespace gaitlab::cpg
