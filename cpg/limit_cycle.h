// The limit cycle of one oscillator, found by integration, and networks of oscillators that move along it.
#pragma once
#include <array>
#include <memory>
#include <utility>

#include "core/plugin/oscillators.h"
#include "core/plugin/registry.h"
#include "cpg/phase_table.h"

namespace gaitlab::cpg {

/// An autonomous oscillator in its own unit of time, whose orbit turns about a centre in a plane.
class Oscillator {
 public:
  static constexpr std::size_t kMost = 4;  ///< largest number of states

  virtual ~Oscillator() = default;
  [[nodiscard]] virtual std::size_t states() const = 0;
  [[nodiscard]] virtual const char* state_name(std::size_t index) const = 0;
  virtual void start(Out x) const = 0;  ///< gives a state that converges to the limit cycle
  virtual void derivative(In x, Out rate) const = 0;
  [[nodiscard]] virtual double output(In x) const = 0;
  struct Point {
    double sine, cosine;
  };
  /// The point of a state in the plane. Its angle atan2(sine, cosine) increases along the orbit and is 0 when the output rises
  /// through its mean.
  [[nodiscard]] virtual Point point(In x) const = 0;
  [[nodiscard]] virtual double step() const = 0;  ///< step of RK4 in the search for the limit cycle
};

struct LimitCycle {
  double period = 0;     ///< period in the oscillator's unit of time
  double amplitude = 0;  ///< peak of the output's magnitude
  PhaseTable angle;
  std::vector<double> orbit;  ///< states at even phases from 0 to 2 pi; index phase * states + state

  /// Integrates from Oscillator::start until the start and the end of a turn agree to 1e-11. Throws std::invalid_argument if
  /// they never do.
  explicit LimitCycle(const Oscillator& oscillator);
};

/// The oscillators of a robot's joints. Couplings make them faster or slower. The state obeys z_i' = pace_i F(z_i), and the
/// output is X_i + r_i y(z_i) / (peak of y).
class CycleNetwork : public Cpg {
 public:
  struct Model {
    double coupling = 1, amplitude_rate = 2;
    void fields(Fields& f);
  };

  /// Number of states: a block with one number per joint for each state of the oscillator, then a block for r.
  [[nodiscard]] std::size_t states() const override { return (oscillator_->states() + 1) * joints_; }
  [[nodiscard]] std::string state_name(std::size_t index) const override;
  void start(Out state) const override;
  void derivative(const Measured&, In state, Out rate) const override;
  void output(double t, In state, Out setpoint) const override;
  [[nodiscard]] SetPointTimes times() const override { return {0, rise_time(model_.amplitude_rate)}; }
  [[nodiscard]] std::string note() const override { return network_.note(); }
  [[nodiscard]] const LimitCycle& limit_cycle() const { return cycle_; }

 protected:
  CycleNetwork(const RobotInfo& robot, const OscillatorKeys& keys, const Model& model,
               std::unique_ptr<const Oscillator> oscillator);

 private:
  using Local = std::array<double, Oscillator::kMost>;
  [[nodiscard]] Local local(In state, std::size_t joint) const;

  std::size_t joints_;
  OscillatorKeys keys_;
  Model model_;
  OscillatorNetwork network_;
  std::unique_ptr<const Oscillator> oscillator_;
  LimitCycle cycle_;
};

}  // namespace gaitlab::cpg
