// CPG `phase_oscillator`, the paper's network of phase oscillators.
#pragma once
#include "core/plugin/oscillators.h"
#include "core/plugin/registry.h"

namespace gaitlab::cpg {

struct PhaseOscillatorModel {
  double coupling = 1, amplitude_rate = 2, offset_rate = 2;
  bool amplitude_weighted = false;
  void fields(Fields& f);
};

class PhaseOscillator final : public OscillatorCpg<PhaseOscillatorModel> {
 public:
  static const char* const kManual;
  static constexpr const char* kBlocks[] = {"phi", "r", "x"};  ///< names of the states

  PhaseOscillator(const RobotInfo& robot, const Settings& settings);
  void start(Out state) const override;
  void derivative(const Measured&, In state, Out rate) const override;
  void output(double t, In state, Out setpoint) const override;
  [[nodiscard]] SetPointTimes times() const override { return {0, rise_time(s_.model.amplitude_rate)}; }
};

}  // namespace gaitlab::cpg
