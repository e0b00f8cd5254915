// CPG `sine`, prescribed sines without states.
#pragma once
#include <stdexcept>

#include "core/math/functions.h"
#include "core/plugin/oscillators.h"
#include "core/plugin/registry.h"

namespace gaitlab::cpg {

class Sine final : public Cpg {
 public:
  struct Model {
    double ramp = 0;
    void fields(Fields& f) {
      f.number("ramp", ramp,
               {"s", 0, 1e6,
                "Duration of the start, in which the amplitudes grow linearly from 0; without initial.angles the robot starts "
                "at the offsets."});
    }
  };
  using Settings = OscillatorSettings<Model>;
  static constexpr const char* kManual = R"(Prescribed sines: the limit cycle of a network of oscillators, without its states.

    theta_i = X_i + min(1, t / ramp) R_i sin(2 pi f_i t + phi_i)

phi_i: sum of the lags along the couplings; couplings that contradict one another around a cycle are an error.
Source: Chariot, Filippi, Verlinden 2012, eq. 10 on the limit cycle of eq. 7.

    cpg: {type: sine, frequency: 0.25, amplitude: 0.6, phase_lag: 1.2, model: {ramp: 1}})";

  Sine(const RobotInfo& robot, const Settings& settings)
      : joints_(robot.joints.size()), s_(settings), network_(robot, settings, 1) {
    if (!network_.consistent) throw std::invalid_argument("the couplings' lags contradict one another around a cycle");
  }

  void output(double t, In, Out setpoint) const override {
    const double grown = t < s_.model.ramp ? t / s_.model.ramp : 1;
    for (std::size_t i = 0; i < joints_; ++i) {
      setpoint[i] =
          s_.offset[i] + grown * (s_.amplitude[i] * math::sin(2 * std::numbers::pi * s_.frequency[i] * t + network_.phases[i]));
    }
  }

  [[nodiscard]] SetPointTimes times() const override { return {0, s_.model.ramp}; }

 private:
  std::size_t joints_;
  Settings s_;
  OscillatorNetwork network_;
};

}  // namespace gaitlab::cpg
