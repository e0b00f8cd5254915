// CPG `hopf`, Hopf oscillators with diffusive coupling and separate durations of swing and stance.
#pragma once
#include "core/plugin/oscillators.h"
#include "core/plugin/registry.h"
#include "cpg/phase_table.h"

namespace gaitlab::cpg {

struct HopfModel {
  double coupling = 1, rate = 2, duty_factor = 0.5, sharpness = 20;
  void fields(Fields& f);
};

class Hopf final : public OscillatorCpg<HopfModel> {
 public:
  static const char* const kManual;
  static constexpr const char* kBlocks[] = {"x", "y"};  ///< names of the states

  Hopf(const RobotInfo& robot, const Settings& settings);
  void start(Out state) const override;
  void derivative(const Measured&, In state, Out rate) const override;
  void output(double t, In state, Out setpoint) const override;

  /// Angular speed at y divided by 2 pi f. It is the pace of stance if b y >> 1, and that of swing if b y << -1.
  [[nodiscard]] double pace(double y) const;

 private:
  double scale_ = 1;  ///< factor on the frequency, so that its mean is f
  PhaseTable angle_;  ///< angle on the circle as a function of the phase, and the inverse
};

}  // namespace gaitlab::cpg
