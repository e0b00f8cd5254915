#include "sensors/encoder.h"

#include "sensors/parts.h"

namespace gaitlab::sensors {

const char* const EncoderSensor::kManual = R"(Encoders or potentiometers of joints: the angle, and the speed as its difference.

    a = gain x + zero + bias + walk + noise       x: the joint's angle, rad
    y = q floor(a / q + 1/2)                      q: resolution
    speed = (y_k - y_(k-1)) / T                   T: time between samples, also after a lost one

The controller and the CPG get the measured angle and speed of these joints in place of the true ones; trace columns
joint.J.measured and joint.J.measured_speed. All keys are those of a channel (docs/real-robot.md). speed: true measures the speed by a
tachometer, a channel with separate keys. Every joint has separate draws. One joint has at most one encoder.
Source: quantisation as additive noise of q/sqrt(12), Widrow and Kollar, Quantization Noise, 2008.
Default (chosen): an exact sensor.

    sensors:
      encoders: {type: encoder, joints: "*", resolution: 0.00511, noise: 0.0035, delay: 0.015})";

void EncoderSensor::Settings::fields(Fields& f) {
  f.names("joints", joints, Among::joints, "Joints that have an encoder: a name, a pattern, or a list of names and patterns.");
  ChannelKeys::fields(f);
  f.flag("speed", speed, "true: a tachometer measures the speed; false: the speed is the difference of the angles.");
  f.group("tachometer", tachometer, "Channel of the speed, with `speed: true`.");
  if (!speed && tachometer != ChannelKeys(kRadianPerSecond)) {
    f.problem("tachometer",
              "tachometer is given, but the speed is the difference of the angles; remove it, or add speed: true");
  }
}

EncoderSensor::EncoderSensor(const SensorSite& site, const Settings& settings)
    : joints_(matching(settings.joints, joint_names_of(site.robot))) {
  for (const std::size_t j : joints_) {
    const std::string name = site.name + "." + site.robot.joints[j].name;
    angles_.add(Channel(settings, site, name));
    readings_.push_back({name, joint_column(j, "measured"), "rad",
                         "angle measured by the encoder, in force just before t, of joint " + site.robot.joints[j].name,
                         Replaces::angle, j});
  }
  for (const std::size_t j : joints_) {
    const std::string name = site.name + "." + site.robot.joints[j].name + ".speed";
    if (settings.speed) speeds_.add(Channel(settings.tachometer, site, name));
    readings_.push_back({name, joint_column(j, "measured_speed"), "rad/s",
                         "speed measured by the encoder, in force just before t, of joint " + site.robot.joints[j].name,
                         Replaces::speed, j});
  }
}

std::vector<SensorStream> EncoderSensor::streams() const {
  std::vector<SensorStream> all = angles_.streams();
  for (SensorStream& one : speeds_.streams()) all.push_back(std::move(one));
  return all;
}

void EncoderSensor::sense(const Truth& truth, Out state, Out values) const {
  const std::size_t n = joints_.size();
  const auto one_of = [&](In all) { return [this, all](std::size_t i) { return all.subspan(joints_[i], 1); }; };
  angles_.sense(truth.tick, one_of(truth.angle), state, values.first(n));
  if (speeds_.states() > 0) {
    speeds_.sense(truth.tick, one_of(truth.speed), state.subspan(angles_.states()), values.subspan(n));
  } else {
    differentiate(truth.tick, values.first(n), state.subspan(angles_.states()), values.subspan(n));
  }
}

void EncoderSensor::differentiate(std::int64_t tick, In angle, Out before, Out speed) const {
  for (std::size_t i = 0; i < joints_.size(); ++i) {
    const Channel& channel = angles_.channels()[i];
    if (tick == 0) {
      before[i] = angle[i];
      speed[i] = 0;
    }
    if (!channel.arrives(tick)) continue;
    speed[i] = (angle[i] - before[i]) / channel.sample_period();
    before[i] = angle[i];
  }
}

}  // namespace gaitlab::sensors
