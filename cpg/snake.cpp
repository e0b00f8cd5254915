#include "cpg/snake.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <stdexcept>

#include "core/math/functions.h"

namespace gaitlab::cpg {

const char* const Snake::kManual =
    R"(Gaits of a chain: a wave through its pitch joints (about y) and one through its yaw joints (about z).

    V_i = O_v + s A_v sin(2 pi f t + i D_v)             i-th pitch joint from the base
    H_i = O_h + s A_h sin(2 pi f t + i D_h + shift)     i-th yaw joint
    s = min(1, t / ramp);  i counts from 0, on the way from the base to the joint; the base is one end of the chain

A joint is a pitch joint if its axis is within 45 degrees of y in the base frame at zero angles, else a yaw joint if it is within 45
degrees of z; other joints stay at 0. Positive angles are right-hand turns about +y and +z, for every direction of the axes.
    straight      pitch: {amplitude: 0.6, lag: 2.0944}          (the defaults)
    turning       yaw: {offset: 0.3}
    rolling       pitch: {amplitude: 0.5, lag: 0}, yaw: {amplitude: 0.5}, shift: 1.5708
    sidewinding   pitch: {amplitude: 0.25, lag: 1.5708}, yaw: {amplitude: 0.5, lag: 1.5708}, shift: 2.0944
    serpentine    pitch: {amplitude: 0}, yaw: {amplitude: 0.6, lag: 1.5708}     (needs wheels)
The sign of yaw.offset and of shift mirrors a motion.
Source: J. Gonzalez-Gomez et al., Motion of minimal configurations of a modular robot: sinusoidal, lateral rolling and lateral
shift, 2006.

    cpg: {type: snake, frequency: 0.5, model: {yaw: {offset: 0.3}}})";

void Snake::Settings::fields(Fields& f) {
  f.number("frequency", frequency, {"Hz", 0, 20, "Frequency of both waves."});
  f.group("model", model, "Keys that only this type has.");
}

void Snake::Model::fields(Fields& f) {
  f.group("pitch", pitch, "Wave of the joints about y.");
  f.group("yaw", yaw, "Wave of the joints about z.");
  f.number("shift", shift, {"rad", -100, 100, "Phase lead of the first yaw joint over the first pitch joint."});
  f.number("ramp", ramp, {"s", 0, 1e6, "Duration of the start, in which the amplitudes grow from 0."});
}

void Snake::Wave::fields(Fields& f) {
  f.number("amplitude", amplitude, {"rad", 0, 3.2, "Amplitude."});
  f.number("lag", lag, {"rad", -100, 100, "Phase lead of each joint over the one before it, from the base outwards."});
  f.number("offset", offset, {"rad", -3.2, 3.2, "Mean angle."});
}

Snake::Snake(const RobotInfo& robot, const Settings& settings) : s_(settings), joints_(robot.joints.size()) {
  const double near_axis = std::sqrt(0.5);
  enum class Kind { pitch, yaw, other };
  const auto kind = [&](const JointInfo& joint) {
    if (!joint.driven) return Kind::other;
    return std::abs(joint.axis[1]) >= near_axis ? Kind::pitch : std::abs(joint.axis[2]) >= near_axis ? Kind::yaw : Kind::other;
  };
  for (std::size_t j = 0; j < joints_; ++j) {
    const JointInfo& joint = robot.joints[j];
    const Kind own = kind(joint);
    if (own == Kind::other) continue;
    const bool yaw = own == Kind::yaw;
    const Wave& wave = yaw ? s_.model.yaw : s_.model.pitch;
    check_angle(joint, yaw ? "model.yaw" : "model.pitch", wave.amplitude + std::abs(wave.offset));
    int number = 0;
    for (std::int64_t a = joint.parent; a >= 0; a = robot.joints[static_cast<std::size_t>(a)].parent)
      number += kind(robot.joints[static_cast<std::size_t>(a)]) == own ? 1 : 0;
    members_.push_back({j, yaw, joint.axis[yaw ? 2 : 1] > 0 ? 1.0 : -1.0, number * wave.lag + (yaw ? s_.model.shift : 0)});
    ++(yaw ? yaws_ : pitches_);
  }
  std::map<std::int64_t, int> children;
  for (const JointInfo& joint : robot.joints) branches_ = branches_ || ++children[joint.parent] > 1;
  const auto check = [&](const Wave& wave, std::size_t count, const char* kind, const char* axis) {
    if (count > 0 || (wave.amplitude == 0 && wave.offset == 0)) return;
    throw SettingError(std::string("model.") + kind, std::string("model.") + kind +
                                                         " moves no joint: none with a motor turns about " + axis +
                                                         (*axis == 'z' ? "; dock every other module with a turn of 1" : ""));
  };
  check(s_.model.pitch, pitches_, "pitch", "y");
  check(s_.model.yaw, yaws_, "yaw", "z");
}

void Snake::output(double t, In, Out setpoint) const {
  std::fill(setpoint.begin(), setpoint.end(), 0.0);
  const double grown = t < s_.model.ramp ? t / s_.model.ramp : 1;
  const double cycle = 2 * std::numbers::pi * s_.frequency * t;
  for (const Member& one : members_) {
    const Wave& wave = one.yaw ? s_.model.yaw : s_.model.pitch;
    setpoint[one.joint] = one.sign * (wave.offset + grown * wave.amplitude * math::sin(cycle + one.phase));
  }
}

std::string Snake::note() const {
  return std::to_string(pitches_) + " pitch and " + std::to_string(yaws_) + " yaw joints" +
         (branches_ ? "; the robot branches: in each branch the waves begin at the base" : "");
}

}  // namespace gaitlab::cpg
