#include "controllers/rc_servo.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <string>
#include <utility>

namespace gaitlab::controllers {

namespace {

/// A maker's unit of P: its name in a scenario, and the duty per rad of one unit.
struct Firmware {
  const char* name;
  double duty_per_rad;
};
constexpr double kPerTurn = 4096;  // steps of a 12-bit encoder
constexpr double kTurn = 6.283185307179586;
constexpr std::array<Firmware, 3> kFirmware{{
    {"dynamixel_x", kPerTurn / kTurn / 256 / 885},  // logs of an XL330: 252 to 254 PWM/rad at P 100, of 885
    {"dynamixel_1", 0.158},                         // Rhoban/bam, oscilloscope, MX-64 and MX-106
    {"feetech_sts", 0.1649},                        // kscalelabs/sysid, STS3215 at P 32, motor leads apart
}};
constexpr std::array kUnits{kFirmware[0].name, kFirmware[1].name, kFirmware[2].name};
constexpr double kUsualGain = 5;    // duty/rad; chosen: MX and STS3215 have 5.1 and 5.3 by default
constexpr int kMostOnWay = 100000;  // goals on the way to a joint, 0.8 MB; chosen: 10 s of periods of 0.1 ms
constexpr double kRounding = 1e-9;  // of a latency of whole control periods

double clamp(double value, double most) { return std::clamp(value, -most, most); }

}  // namespace

const char* const RcServo::kManual =
    R"(The position loop in the firmware of a hobby servo or a smart servo. Its command is the duty d of the driver's PWM, from -1 to 1:
the motor gets d times the supply.

    e = goal - measured angle, rad
    d = 0                                                              if |e| <= dead_band > 0
    d = gain (e - sign(e) dead_band) + sign(e) punch + I_k + D (e - e_last) / T      otherwise

The servo samples every T, `every` control periods, and holds d in between. I_k is the sum of I T e over samples outside the dead
band; it is held while the last d was beyond `limit` with the sign of e. The driver cuts d at +- limit, and check `voltage` counts
a duty that is cut as a command at the supply.

The goal is the set point after `latency`, rounded up to whole control periods, because a servo takes up a goal at its next
sample; before, it is the angle at the start. speed_limit and acceleration_limit are the servo's own profile of the goal: with
speed v of the goal, p += v T, and v changes by at most acceleration_limit T towards the largest speed from which the goal can
still stop at its end. 0: no such limit.

P is the gain in the maker's unit, instead of `gain`; without either the gain is 5 (chosen: near 5.1 and 5.3 of MX and STS3215 at
their default P):

    unit          duty/rad per P   source
    dynamixel_x   0.002877         P / 256 PWM per 0.088 degree, of 885: logs of an XL330-M288 (Rhoban/bam), 252 to 254
                                   PWM/rad at P 100. P / 128, as in the maker's text, is twice as much. Checked on the XL330 only
    dynamixel_1   0.158            Rhoban/bam, oscilloscope on MX-64 and MX-106
    feetech_sts   0.1649           kscalelabs/sysid, STS3215 12 V at P 32

Latencies of logs: XL330 0.007 s, STS3215 0.034 s.
Source: form and units: the makers' manuals and the logs above; dead band and punch: RC servos and Dynamixel AX. Commands duty,
for actuators that take V.

    controller: {type: rc_servo, period: 0.001, P: 400, unit: dynamixel_x})";

double RcServo::Settings::gain_of_P(std::size_t joint) const {
  return P[joint] > 0 ? P[joint] * kFirmware.at(static_cast<std::size_t>(unit)).duty_per_rad : kUsualGain;
}

double RcServo::Settings::proportional(std::size_t joint) const {
  return gain[joint] != kNotStated ? gain[joint] : gain_of_P(joint);
}

void RcServo::Settings::fields(Fields& f) {
  f.rating("P", P, {"", kPositive, 1e6, "Proportional gain in the maker's unit, instead of gain."});
  f.choice("unit", unit, kUnits, "Unit of P: the maker's firmware.");
  PerJoint usual;
  for (std::size_t j = 0; j < P.each.size(); ++j) usual.each.push_back(gain_of_P(j));
  usual.common = gain_of_P(0);
  f.per_joint("gain", gain, usual,
              {"/rad", 0, 1e6, "Proportional gain: duty per angle; that of P, or 5 if neither is stated."});
  f.per_joint("I", I, {"/(rad s)", 0, 1e6, "Integral gain: duty per angle and time."});
  f.per_joint("D", D, {"s/rad", 0, 1e6, "Derivative gain: duty per rate of the error."});
  f.per_joint("speed_limit", speed_limit, {"rad/s", 0, 1e6, "Largest speed of the goal; 0: no limit."});
  f.per_joint("acceleration_limit", acceleration_limit, {"rad/s^2", 0, 1e9, "Largest acceleration of the goal; 0: no limit."});
  f.per_joint("latency", latency,
              {"s", 0, 10, "Time from a set point until it acts; the longest one is a state per control period."});
  f.per_joint("dead_band", dead_band, {"rad", 0, 1, "Error up to which the motor gets nothing."});
  f.per_joint("punch", punch, {"", 0, 1, "Least duty outside the dead band."});
  f.limit("limit", limit, {"", kPositive, 1, "Largest duty."});
  f.integer("every", every, {"", 1, 1000000, "Control periods between two samples of the servo."});
  for (std::size_t j = 0; j < std::max({std::size_t{1}, gain.each.size(), P.each.size()}); ++j) {
    if (gain[j] == kNotStated || !(P[j] > 0)) continue;
    f.problem("P", "gain and P are both stated, but they are the same gain in two units; remove one of them");
    return;
  }
}

RcServo::RcServo(const RobotInfo& robot, Settings settings) : joints_(robot.joints.size()), s_(std::move(settings)) {
  double most = 0;  // s, largest rounding
  for (std::size_t j = 0; j < joints_; ++j) {
    const double periods = s_.latency[j] > 0 ? s_.latency[j] / robot.control_period : 0;
    if (!(periods <= kMostOnWay)) {
      throw SettingError("latency", "latency of joint " + robot.joints[j].name + " is more than " + std::to_string(kMostOnWay) +
                                        " control periods; expected a shorter latency, or a longer controller.period");
    }
    delay_.push_back(static_cast<std::size_t>(std::ceil(periods * (1 - kRounding))));
    on_way_ = std::max(on_way_, delay_.back());
    const double late = static_cast<double>(delay_.back()) * robot.control_period;
    const double rounding = robot.joints[j].driven ? late - s_.latency[j] : 0;
    if (!(rounding > kRounding * late) || rounding <= most) continue;
    most = rounding;
    rounded_ = fmt::format(
        "latency {:.4g} s{} acts as {:.4g} s, the next whole number of control periods (controller.period {:.4g} s)",
        s_.latency[j], s_.latency.each.empty() ? "" : " of joint " + robot.joints[j].name, late, robot.control_period);
  }
}

std::string RcServo::note() const { return rounded_; }

std::vector<PositionGains> RcServo::gains() const {
  std::vector<PositionGains> all;
  for (std::size_t j = 0; j < joints_; ++j) {
    const bool own = !(s_.P[j] > 0);
    const double P = s_.proportional(j);
    all.push_back({.P = P,
                   .I = s_.I[j],
                   .D = s_.D[j],
                   .most = s_.limit[j],
                   .every = s_.every,
                   .key = own ? "gain" : "P",
                   .unit = own ? "/rad" : "",
                   .per_key = own ? 1 : P / s_.P[j],
                   .key_of_D = "D",
                   .unit_of_D = "s/rad"});
  }
  return all;
}

void RcServo::start(Out x) const { std::fill(x.begin(), x.end(), 0.0); }

/// Moves the goal of the profile towards the given goal by one sample.
void RcServo::follow(std::size_t joint, double goal, double period, Joint& x) const {
  const double most = s_.speed_limit[joint];
  const double steepest = s_.acceleration_limit[joint];
  const double way = goal - x.goal;
  double speed = way / period;
  if (most > 0) speed = clamp(speed, most);
  if (steepest > 0) {
    // From the speed v the goal stops after samples of v T, (v - a T) T, ... down to 0: with v = (k + f) a T, 0 <= f < 1, this
    // is a T^2 (k + 1) (k / 2 + f), thus v / a T = k / 2 + way / (a T^2 (k + 1)).
    const double change = steepest * period;
    const double samples = std::abs(way) / (change * period);
    const double whole = std::floor((std::sqrt(1 + 8 * samples) - 1) / 2);
    const double stops = change * (whole / 2 + samples / (whole + 1));
    speed = x.speed + clamp(clamp(speed, stops) - x.speed, change);
  }
  x.speed = speed;
  x.goal = most > 0 || steepest > 0 ? x.goal + speed * period : goal;
}

void RcServo::command(std::size_t joint, double error, double period, bool first, Joint& x) const {
  if (first) x.last_error = error;
  const double rate = (error - x.last_error) / period;
  x.last_error = error;
  const double side = error > 0 ? 1 : error < 0 ? -1 : 0;
  if (s_.dead_band[joint] > 0 && std::abs(error) <= s_.dead_band[joint]) {
    x.duty = 0;
    return;
  }
  const bool wound_up = std::abs(x.duty) > s_.limit[joint] && x.duty * error > 0;
  if (!wound_up) x.integral += s_.I[joint] * period * error;
  x.duty =
      s_.proportional(joint) * (error - side * s_.dead_band[joint]) + side * s_.punch[joint] + x.integral + s_.D[joint] * rate;
}

void RcServo::update(const Measured& m, In setpoint, In, Out x, Out command) const {
  const auto tick = static_cast<std::int64_t>(x[0]);
  const bool samples = tick % s_.every == 0;
  const double period = m.period * static_cast<double>(s_.every);
  double* at = x.data() + 1;
  for (std::size_t j = 0; j < joints_; ++j) {
    Joint joint{at[0], at[1], at[2], at[3], at[4]};
    double* const on_way = at + kJointStates;
    at = on_way + on_way_;
    if (tick == 0) {
      joint.goal = m.angle[j];
      std::fill_n(on_way, on_way_, m.angle[j]);
    }
    double goal = setpoint[j];
    if (on_way_ > 0) {
      const std::size_t now = static_cast<std::size_t>(tick) % on_way_;
      const double late = on_way[(now + on_way_ - delay_[j]) % on_way_];
      on_way[now] = setpoint[j];
      if (delay_[j] > 0) goal = late;
    }
    if (samples) {
      follow(j, goal, period, joint);
      this->command(j, joint.goal - m.angle[j], period, tick == 0, joint);
    }
    command[j] = joint.duty;
    std::ranges::copy(std::array{joint.goal, joint.speed, joint.integral, joint.last_error, joint.duty}, on_way - kJointStates);
  }
  x[0] = static_cast<double>(tick + 1);
}

}  // namespace gaitlab::controllers
