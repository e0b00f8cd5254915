// CPG `equations`, a model whose equations are in the scenario file.
#pragma once
#include "core/plugin/registry.h"
#include "cpg/equation_program.h"

namespace gaitlab::cpg {

/// A change of states when a condition becomes true, for each joint separately.
struct EquationEvent {
  std::string when;
  std::vector<Named> set;            ///< new values of states
  std::vector<std::string> of{"*"};  ///< joints
  void fields(Fields& f);
};

/// Settings of the model. The texts follow the grammar of core/expression/expression.h. The defaults are the model of
/// `phase_oscillator`.
struct EquationsModel {
  double coupling = 1;
  std::vector<Named> states{{"phi", "omega + sum(j in neighbours, w[i,j]*sin(phi[j] - phi[i] - psi[i,j]))"},
                            {"r", "2*(amplitude - r)"},
                            {"x", "2*(offset - x)"}};
  std::vector<Named> parameters;
  std::vector<Named> initial{{"phi", "phase"}, {"x", "offset"}};
  std::string output = "x + r*sin(phi)";
  std::vector<Named> inputs;  ///< values of sensors
  std::vector<EquationEvent> events;
  void fields(Fields& f);
};

class Equations final : public Cpg {
 public:
  using Settings = OscillatorSettings<EquationsModel>;
  static const char* const kManual;
  static constexpr std::size_t kMostStates = 32, kMostParameters = 64, kMostEvents = 16, kMostInputs = 64;

  /// Throws std::invalid_argument if a text has a fault, names a sensor value that the scenario lacks, or if a parameter or
  /// initial value is not finite for this robot.
  Equations(const RobotInfo& robot, const Settings& settings);
  /// Number of states. Each state of the model is a block with one number per joint, and so is each event: 1 while its
  /// condition is true.
  [[nodiscard]] std::size_t states() const override { return (states_.size() + events_.size()) * joints_; }
  [[nodiscard]] std::string state_name(std::size_t index) const override;
  void start(Out state) const override;
  void derivative(const Measured& measured, In state, Out rate) const override;
  void event(const Measured& measured, Out state) const override;
  void output(double t, In state, Out setpoint) const override;
  [[nodiscard]] std::string note() const override { return network_.note(); }

 private:
  std::size_t joints_;
  OscillatorNetwork network_;
  std::vector<std::string> states_;
  EquationProgram initial_, derivative_, output_;
  struct Event {
    EquationProgram when, set;
    std::vector<std::size_t> joints, states;  ///< joints that it applies to, and states that it sets
  };
  std::vector<Event> events_;
  mutable std::vector<double> condition_, values_;  ///< scratch
};

}  // namespace gaitlab::cpg
