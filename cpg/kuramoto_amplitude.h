// CPG `kuramoto_amplitude`, phase oscillators whose amplitude and offset obey critically damped second-order equations.
#pragma once
#include "core/plugin/oscillators.h"
#include "core/plugin/registry.h"

namespace gaitlab::cpg {

struct KuramotoAmplitudeModel {
  double coupling = 4, amplitude_rate = 20, offset_rate = 20;
  void fields(Fields& f);
};

class KuramotoAmplitude final : public OscillatorCpg<KuramotoAmplitudeModel> {
 public:
  static const char* const kManual;
  static constexpr const char* kBlocks[] = {"phi", "r", "dr", "x", "dx"};  ///< names of the states

  KuramotoAmplitude(const RobotInfo& robot, const Settings& settings);
  void start(Out state) const override;
  void derivative(const Measured&, In state, Out rate) const override;
  void output(double t, In state, Out setpoint) const override;
  [[nodiscard]] SetPointTimes times() const override;
};

}  // namespace gaitlab::cpg
