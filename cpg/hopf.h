// CPG `hopf`: Hopf oscillators with diffusive coupling, with separate durations of swing and stance.
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
  static constexpr const char* kBlocks[] = {"x", "y"};  ///< of the states

  Hopf(const RobotInfo& robot, const Settings& settings);
  void start(Out state) const override;
  void derivative(const Measured&, In state, Out rate) const override;
  void output(double t, In state, Out setpoint) const override;

  /// omega / (2 pi f) at y: the pace of stance where b y >> 1, of swing where b y << -1.
  [[nodiscard]] double pace(double y) const;

 private:
  double scale_ = 1;  ///< for a mean frequency of f
  PhaseTable angle_;  ///< angle on the circle at a phase, and back
};

}  // namespace gaitlab::cpg
