#include "cpg/network.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <utility>

#include "core/math/functions.h"
#include "core/model/pattern.h"

namespace gaitlab::cpg {

const char* const Network::kManual =
    R"(A feed-forward network from measured values to set points, such as a policy that was learned.

    z = clamp((u - mean) / deviation, -clip, clip),   z = act(W z + b) layer by layer,   theta = centre + scale z

u: the inputs, at the control tick. z of the last layer has a number per joint with a motor, in their order, and is held until the
next tick (states y.J). Without layers z is 0. Sums run over the columns of W from the first to the last.

inputs      angle.JOINT rad, speed.JOINT rad/s, torque.JOINT N m, load.JOINT N (of the link that it moves), touching.MODULE, values of
            sensors such as imu.roll, previous.JOINT (the last z), clock.sin and clock.cos (of 2 pi frequency t); * and ? match
            any, in the order of the robot: angle.*
activation  tanh, relu (max(0, z)), elu (z, or exp(z) - 1 below 0), none

Each layer is {weights: [[...], ...], bias: [...], activation: tanh}: a row of weights per output. A policy file for `cpg: {type:
./policy.yaml}` has the keys `gaitlab_cpg: 1`, `type: network`, `frequency` and `model`; gaitlab.Policy of the Python package writes one. Another
program that computes the same network agrees to about 1e-12 in the first tick, and from then on as far as the motion is
predictable. Learned gaits are judged like any other.
Reference: the policies of Mania, Guy, Recht, NeurIPS 2018, and of the usual libraries for learning.

    cpg:
      type: network
      frequency: 1
      model:
        inputs: ["angle.*", "speed.*", clock.sin, clock.cos]
        scale: 0.4)";

namespace {

constexpr const char* kActivations[] = {"tanh", "relu", "elu", "none"};

double activated(Network::Activation activation, double z) {
  switch (activation) {
    case Network::Activation::tanh:
      return math::tanh(z);
    case Network::Activation::relu:
      return std::max(0.0, z);
    case Network::Activation::elu:
      return z > 0 ? z : math::exp(z) - 1;
    case Network::Activation::none:
      break;
  }
  return z;
}

[[noreturn]] void refuse(const std::string& key, const std::string& what) {
  throw SettingError("model." + key, "model." + key + what);
}

}  // namespace

void Network::Layer::fields(Fields& f) {
  f.rows("weights", weights, {"", -1e6, 1e6, "Matrix W: a row per output."});
  f.numbers("bias", bias, {"", -1e6, 1e6, "Vector b; without it, 0."});
  f.choice("activation", activation, kActivations, "Function of each output.");
}

void Network::Model::fields(Fields& f) {
  f.texts("inputs", inputs, "Names of the inputs, or patterns with * and ?.");
  f.numbers("mean", mean, {"", -1e9, 1e9, "Mean of each input; without it, 0."});
  f.numbers("deviation", deviation, {"", kPositive, 1e9, "Standard deviation of each input; without it, 1."});
  f.number("clip", clip, {"", kPositive, 1e9, "Largest absolute value of a normalised input."});
  f.list("layers", layers, "Layers, from the inputs to the outputs.");
  f.per_joint("centre", centre, {"rad", -1000, 1000, "Set point of z = 0."});
  f.per_joint("scale", scale, {"rad", 0, 1000, "Change of the set point for z = 1."});
}

void Network::Settings::fields(Fields& f) {
  f.number("frequency", frequency, {"Hz", 0, 20, "Frequency of clock.sin and clock.cos."});
  f.group("model", model, "The network.");
}

Network::Network(const RobotInfo& robot, const Settings& settings) : s_(settings), joints_(robot.joints.size()) {
  for (std::size_t j = 0; j < joints_; ++j) {
    if (robot.joints[j].driven) driven_.push_back(j);
    if (robot.joints[j].driven) check_angle(robot.joints[j], "model.centre", s_.model.centre[j]);
  }
  for (const std::string& wanted : s_.model.inputs) add_inputs(robot, wanted);
  const std::size_t count = inputs_.size();
  const auto check = [&](const char* key, std::vector<double>& values, double usual) {
    if (values.empty()) values.assign(count, usual);
    if (values.size() != count)
      refuse(key, " has " + std::to_string(values.size()) + " numbers; the network has " + std::to_string(count) + " inputs");
  };
  check("mean", s_.model.mean, 0);
  check("deviation", s_.model.deviation, 1);
  std::size_t width = count;
  std::size_t most = std::max(count, driven_.size());
  for (std::size_t k = 0; k < s_.model.layers.size(); ++k) {
    Layer& layer = s_.model.layers[k];
    const std::string name = "layers: layer " + std::to_string(k);
    const std::string before = k == 0 ? "the inputs give" : "layer " + std::to_string(k - 1) + " gives";
    if (layer.weights.empty()) refuse(name, " has no weights");
    if (layer.weights[0].size() != width)
      refuse(name, " has " + std::to_string(layer.weights[0].size()) + " inputs, " + before + " " + std::to_string(width));
    width = layer.weights.size();
    if (layer.bias.empty()) layer.bias.assign(width, 0.0);
    if (layer.bias.size() != width)
      refuse(name, " has " + std::to_string(width) + " rows of weights and " + std::to_string(layer.bias.size()) + " biases");
    most = std::max(most, width);
  }
  if (!s_.model.layers.empty() && width != driven_.size()) {
    refuse("layers", ": the last layer gives " + std::to_string(width) + " numbers; the robot has " +
                         std::to_string(driven_.size()) + " motors");
  }
  values_.resize(most);
  outputs_.resize(most);
}

void Network::add_inputs(const RobotInfo& robot, const std::string& wanted) {
  const std::size_t before = inputs_.size();
  const auto add = [&](const std::string& name, Source source, std::size_t index) {
    if (glob(wanted, name)) inputs_.push_back({source, index});
  };
  constexpr std::array<std::pair<const char*, Source>, 4> kOfJoints{
      {{"angle.", Source::angle}, {"speed.", Source::speed}, {"torque.", Source::torque}, {"load.", Source::load}}};
  for (const auto& [prefix, source] : kOfJoints) {
    for (std::size_t j = 0; j < joints_; ++j) add(prefix + robot.joints[j].name, source, j);
  }
  for (std::size_t m = 0; m < robot.modules.size(); ++m) add("touching.m" + std::to_string(m), Source::touching, m);
  for (std::size_t c = 0; c < robot.channels.size(); ++c) add(robot.channels[c], Source::channel, c);
  for (std::size_t d = 0; d < driven_.size(); ++d) add("previous." + robot.joints[driven_[d]].name, Source::previous, d);
  add("clock.sin", Source::sine, 0);
  add("clock.cos", Source::cosine, 0);
  for (std::size_t i = before; i < inputs_.size(); ++i)
    clock_ = clock_ || inputs_[i].source == Source::sine || inputs_[i].source == Source::cosine;
  if (inputs_.size() > before) return;
  std::string known;
  for (const std::string& channel : robot.channels) known += ", " + channel;
  refuse("inputs", ": '" + wanted.substr(0, 80) +
                       "' is unknown; expected angle, speed, torque, load or previous with a joint, touching with a module, "
                       "clock.sin, clock.cos" +
                       (known.empty() ? std::string("; no sensor of this scenario gives values") : known));
}

double Network::value(const Input& input, const Measured& m, In state) const {
  switch (input.source) {
    case Source::angle:
      return m.angle[input.index];
    case Source::speed:
      return m.speed[input.index];
    case Source::torque:
      return m.torque[input.index];
    case Source::load:
      return m.load[input.index];
    case Source::touching:
      return m.touching[input.index];
    case Source::channel:
      return m.channels[input.index];
    case Source::previous:
      return state[input.index];
    case Source::sine:
      return math::sin(2 * std::numbers::pi * s_.frequency * m.t);
    case Source::cosine:
      break;
  }
  return math::cos(2 * std::numbers::pi * s_.frequency * m.t);
}

void Network::event(const Measured& m, Out state) const {
  if (s_.model.layers.empty()) return;
  const Model& model = s_.model;
  for (std::size_t i = 0; i < inputs_.size(); ++i)
    values_[i] = std::clamp((value(inputs_[i], m, state) - model.mean[i]) / model.deviation[i], -model.clip, model.clip);
  for (const Layer& layer : model.layers) {
    for (std::size_t row = 0; row < layer.weights.size(); ++row) {
      double sum = layer.bias[row];
      for (std::size_t i = 0; i < layer.weights[row].size(); ++i) sum += layer.weights[row][i] * values_[i];
      outputs_[row] = activated(layer.activation, sum);
    }
    std::swap(values_, outputs_);
  }
  std::copy_n(values_.begin(), state.size(), state.begin());
}

void Network::output(double, In state, Out setpoint) const {
  std::fill(setpoint.begin(), setpoint.end(), 0.0);
  for (std::size_t d = 0; d < driven_.size(); ++d)
    setpoint[driven_[d]] = s_.model.centre[driven_[d]] + s_.model.scale[driven_[d]] * state[d];
}

SetPointTimes Network::times() const { return {clock_ && s_.frequency > 0 ? 1 / s_.frequency : 0, 0}; }

}  // namespace gaitlab::cpg
