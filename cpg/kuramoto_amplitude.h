// CPG `kuramoto_amplitude`: phase oscillators whose amplitude and offset obey critically damped second-order equations.
#pragma once
#include "core/plugin/oscillators.h"
#include "core/plugin/registry.h"

namespace gaitlab {

class KuramotoAmplitude final : public Cpg {
 public:
  struct Model {
    double coupling = 4, amplitude_rate = 20, offset_rate = 20;
    void fields(Fields& f);
  };
  struct Settings : OscillatorKeys {
    Model model;
    void fields(Fields& f) {
      OscillatorKeys::fields(f);
      f.group("model", model, "Keys of this model alone.");
    }
  };
  static const char* const kManual;

  KuramotoAmplitude(const RobotInfo& robot, const Settings& settings);
  /// phi, r, r', x, x': one block of each.
  [[nodiscard]] std::size_t states() const override { return 5 * joints_; }
  [[nodiscard]] std::string state_name(std::size_t index) const override;
  void start(Out state) const override;
  void derivative(const Measured&, In state, Out rate) const override;
  void output(double t, In state, Out setpoint) const override;
  [[nodiscard]] std::string note() const override { return network_.note(); }

 private:
  std::size_t joints_;
  Settings s_;
  OscillatorNetwork network_;
};

}  // namespace gaitlab
