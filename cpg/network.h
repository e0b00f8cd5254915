// CPG `network`, a feed-forward network that computes the set points from measured values: a learned policy.
#pragma once
#include <string>
#include <vector>

#include "core/plugin/registry.h"

namespace gaitlab::cpg {

class Network final : public Cpg {
 public:
  enum class Activation { tanh, relu, elu, none };
  struct Layer {
    std::vector<std::vector<double>> weights;  ///< a row per output of the layer
    std::vector<double> bias;
    Activation activation = Activation::tanh;
    void fields(Fields& f);
  };
  struct Model {
    std::vector<std::string> inputs{"clock.sin", "clock.cos"};
    std::vector<double> mean, deviation;
    double clip = 10;
    std::vector<Layer> layers;
    PerJoint centre{0}, scale{0.3};
    void fields(Fields& f);
  };
  struct Settings {
    double frequency = 1;
    Model model;
    void fields(Fields& f);
  };
  static const char* const kManual;

  /// Throws SettingError for an unknown input, and for layers whose sizes do not fit one another, the inputs or the motors.
  Network(const RobotInfo& robot, const Settings& settings);
  /// The outputs of the network, one per joint with a motor, held over a control period.
  [[nodiscard]] std::size_t states() const override { return driven_.size(); }
  [[nodiscard]] std::string state_name(std::size_t index) const override { return "y." + std::to_string(driven_[index]); }
  void derivative(const Measured&, In, Out rate) const override { std::fill(rate.begin(), rate.end(), 0.0); }
  void start(Out state) const override { std::fill(state.begin(), state.end(), 0.0); }
  void event(const Measured& measured, Out state) const override;
  void output(double t, In state, Out setpoint) const override;
  [[nodiscard]] SetPointTimes times() const override;

 private:
  enum class Source { angle, speed, torque, load, touching, channel, previous, sine, cosine };
  struct Input {
    Source source;
    std::size_t index = 0;
  };
  void add_inputs(const RobotInfo& robot, const std::string& wanted);
  [[nodiscard]] double value(const Input& input, const Measured& measured, In state) const;

  Settings s_;
  std::size_t joints_;
  std::vector<std::size_t> driven_;
  std::vector<Input> inputs_;
  bool clock_ = false;                            ///< true if the clock is an input
  mutable std::vector<double> values_, outputs_;  ///< scratch
};

}  // namespace gaitlab::cpg
