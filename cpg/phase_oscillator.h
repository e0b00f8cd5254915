// CPG `phase_oscillator`: the paper's network of phase oscillators.
#pragma once
#include "core/plugin/oscillators.h"
#include "core/plugin/registry.h"

namespace gaitlab {

class PhaseOscillator final : public Cpg {
 public:
  struct Model {
    double coupling = 1, amplitude_rate = 2, offset_rate = 2;
    bool amplitude_weighted = false;
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

  PhaseOscillator(const RobotInfo& robot, const Settings& settings);
  /// phi, r, x: one block of each.
  [[nodiscard]] std::size_t states() const override { return 3 * joints_; }
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
