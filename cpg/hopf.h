// CPG `hopf`: Hopf oscillators with diffusive coupling, with separate durations of swing and stance.
#pragma once
#include "core/plugin/oscillators.h"
#include "core/plugin/registry.h"
#include "cpg/phase_table.h"

namespace gaitlab {

class Hopf final : public Cpg {
 public:
  struct Model {
    double coupling = 1, rate = 2, duty_factor = 0.5, sharpness = 20;
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

  Hopf(const RobotInfo& robot, const Settings& settings);
  /// x, y: one block of each.
  [[nodiscard]] std::size_t states() const override { return 2 * joints_; }
  [[nodiscard]] std::string state_name(std::size_t index) const override;
  void start(Out state) const override;
  void derivative(const Measured&, In state, Out rate) const override;
  void output(double t, In state, Out setpoint) const override;
  [[nodiscard]] std::string note() const override { return network_.note(); }

  /// omega / (2 pi f) at y: the pace of stance where b y >> 1, of swing where b y << -1.
  [[nodiscard]] double pace(double y) const;

 private:
  std::size_t joints_;
  Settings s_;
  OscillatorNetwork network_;
  double scale_ = 1;  ///< so that the mean frequency is f
  PhaseTable angle_;  ///< angle on the circle at a phase, and back
};

}  // namespace gaitlab
