#include "cpg/equations.h"

#include <algorithm>
#include <cmath>

namespace gaitlab::cpg {

const char* const Equations::kManual =
    R"(A model written in the scenario: states with their derivatives, an output, feedback from the sensors.

    phi_i' = 2 pi f_i + sum_j w_ij sin(phi_j - phi_i - psi_ij)      the default: what phase_oscillator does
    r_i'   = 2 (R_i - r_i)
    x_i'   = 2 (X_i - x_i)
    theta_i = x_i + r_i sin(phi_i)

Every text is written for one joint, i, and holds for all. A name without brackets belongs to joint i: phi is phi[i].

states      NAME: derivative, 1/s. initial: NAME: value at the start; a state not named there starts at 0.
output      set point, rad.
parameters  NAME: a number, a list, {default: 1, m3/passive: 2}, or a text of what is fixed: parameters above it and
            given: frequency Hz, omega = 2 pi frequency, amplitude, offset, phase (limit cycle of the couplings, rad),
            index (of the joint, from 0), joints (their number), depth (hinges towards the base), side (1 left, -1 right, 0)
A model with states has no defaults for parameters, initial and output. pi, the given names and parameters may be used
anywhere; states and t (s) in derivatives and output; measured values at the control tick only in derivatives:
angle rad, speed rad/s, torque N m, touching (1 while the joint's module touches the ground, else 0).

    sum(j in neighbours, TERM)      over the couplings by which joint i follows a joint j. In TERM: NAME[j], and of the
                                    coupling w[i,j] (its weight) and psi[i,j] (minus its phase_lag: phi_i = phi_j - psi_ij)
    + - * / ^   < <= > >= == !=   and or not      comparisons give 1 or 0; every value except 0 is true, NaN (such as
                                                  log(-1)) included
    sin cos tan tanh exp log sqrt abs sign        of one number; log: natural; sign(0) = 0
    min(a, b)  max(a, b)  clamp(x, low, high)  if(condition, then, else)

From loose to tight: or, and, not, comparison, + -, * /, sign, ^ (from the right: -2^2 = -4). Limits: 32 states and
64 parameters; in each text, 4000 characters, 500 numbers, names and operators in all, and 64 levels of nesting. There are no
loops, no other calls, no random numbers. A state or set point that is not finite (1/0, log(-1)) ends the run and is named.
Stable if RK4 is stable with cpg.step. Write a text of several lines after |, and a text that YAML would read as something else
in quotes. The default, written out:
scenarios/caterpillar-equations.yaml.
Reference: Chariot, Filippi, Verlinden 2012, eq. 7-10 (the default); their outlook asks for equations in the input.

    cpg:
      type: equations
      frequency: 0.25
      amplitude: 0.6
      model:
        parameters: {mu: 1, gain: 1 - depth/(2*joints)}
        states:
          u: omega*v
          v: omega*(mu*(1 - u^2)*v - u) + sum(j in neighbours, w[i,j]*(u[j] - u)) - 0.1*speed
        initial: {u: 2*cos(phase), v: -2*sin(phase)}
        output: offset + gain*amplitude*u/2)";

namespace {

using Kind = EquationNames::Kind;
using Where = EquationNames::Where;

/// A fault in the model. It is at a byte of the text under `key` (and `name`), or at the name if the offset is npos.
struct Fault {
  const char* key;
  std::string name;
  std::size_t offset;
  std::string what;
};

/// The texts of the model as checked trees.
struct Parsed {
  EquationNames names;
  std::vector<Term> parameters;  ///< 0 for a parameter that is given as a number
  std::vector<Term> states;
  std::vector<Term> initial;  ///< one per state
  Term output;
  std::vector<Fault> faults;

  explicit Parsed(const EquationsModel& model) {
    declare("states", model.states, Kind::state, Equations::kMostStates);
    declare("parameters", model.parameters, Kind::parameter, Equations::kMostParameters);
    if (model.states.size() > Equations::kMostStates || model.parameters.size() > Equations::kMostParameters) return;
    for (std::size_t k = 0; k < model.parameters.size(); ++k) {
      parameters.push_back(tree("parameters", model.parameters[k].name, model.parameters[k].text, Where::parameter, k));
    }
    for (const Named& state : model.states) states.push_back(tree("states", state.name, state.text, Where::derivative, 0));
    initial.resize(model.states.size());
    for (const Named& value : model.initial) {
      const auto state = std::ranges::find(model.states, value.name, &Named::name);
      if (state == model.states.end()) {
        std::vector<std::string> known;
        for (const Named& one : model.states) known.push_back(one.name);
        faults.push_back({"initial", value.name, std::string::npos,
                          "'" + value.name + "' is not a state" + offer_name(value.name, known, "states")});
      } else {
        initial[static_cast<std::size_t>(state - model.states.begin())] =
            tree("initial", value.name, value.text, Where::initial, 0);
      }
    }
    output = tree("output", "", model.output, Where::output, 0);
  }

 private:
  void declare(const char* key, const std::vector<Named>& values, Kind kind, std::size_t most) {
    for (std::size_t k = 0; k < values.size(); ++k) {
      std::string wrong = k < most ? "" : "more than " + std::to_string(most) + " " + key;
      if (wrong.empty()) wrong = names.declare(values[k].name, kind, k);
      if (!wrong.empty()) faults.push_back({key, values[k].name, std::string::npos, wrong});
      if (k >= most) return;
    }
  }

  /// Syntax tree of an expression. An empty text, which has been reported as a fault, gives the tree 0.
  Term tree(const char* key, const std::string& name, const std::string& text, Where where, std::size_t slot) {
    if (text.empty()) return {};
    std::vector<expression::Fault> wrong;
    Term term;
    try {
      term = expression::parse(text);
      names.check(term, where, slot, wrong);
    } catch (const expression::Fault& fault) {
      wrong.push_back(fault);
    }
    for (const expression::Fault& fault : wrong) faults.push_back({key, name, fault.offset, fault.what});
    return term;
  }
};

const std::string kNoOutput = "no output is given; expected the set point in rad, for example output: r*sin(phi)";

[[noreturn]] void refuse(const Fault& fault) {
  const std::string at = std::string("model.") + fault.key + (fault.name.empty() ? "" : "." + fault.name);
  const std::string character = fault.offset == std::string::npos ? "" : ", character " + std::to_string(fault.offset + 1);
  throw std::invalid_argument(at + character + ": " + fault.what);
}

void check_finite(const RobotInfo& robot, const std::string& what, In values) {
  for (std::size_t j = 0; j < values.size(); ++j) {
    if (std::isfinite(values[j])) continue;
    throw std::invalid_argument(what + " of joint " + robot.joints[j].name + " is " + std::to_string(values[j]) +
                                "; expected a finite number");
  }
}

EquationTables tables_of(const RobotInfo& robot, const OscillatorKeys& keys, const OscillatorNetwork& network) {
  EquationTables tables;
  tables.joints = robot.joints.size();
  tables.couplings = network.couplings;
  for (const JointInfo& joint : robot.joints) tables.module.push_back(static_cast<std::size_t>(joint.module));
  for (const GivenValue& given : given_values()) {
    std::vector<double> values;
    for (std::size_t j = 0; j < tables.joints; ++j) values.push_back(given.value(robot, keys, network.phases, j));
    tables.given.push_back(std::move(values));
  }
  return tables;
}

}  // namespace

void EquationsModel::fields(Fields& f) {
  const std::vector<Named> before = states;
  f.number("coupling", coupling, {"1/s", 0, 1000, "Weight w of the couplings made by a rule."});
  f.named("states", states, NamedValues::texts, "States and their derivatives.");
  if (states != before) {  // the other defaults belong to the default states
    initial.clear();
    output.clear();
  }
  f.named("parameters", parameters, NamedValues::texts_or_numbers, "Numbers with a name, fixed for the run.");
  f.named("initial", initial, NamedValues::texts, "States at the start; states that are not named start at 0.");
  f.text("output", output, "Set point, rad.");
  if (output.empty()) f.problem("output", kNoOutput);
  for (const Fault& fault : Parsed(*this).faults) f.problem_at(fault.key, fault.name, fault.offset, fault.what);
}

Equations::Equations(const RobotInfo& robot, const Settings& settings)
    : joints_(robot.joints.size()), network_(robot, settings, settings.model.coupling) {
  const EquationsModel& model = settings.model;
  const Parsed parsed(model);
  if (!parsed.faults.empty()) refuse(parsed.faults.front());
  if (model.output.empty()) refuse({"output", "", std::string::npos, kNoOutput});
  for (const Named& state : model.states) states_.push_back(state.name);
  EquationTables tables = tables_of(robot, settings, network_);
  for (std::size_t k = 0; k < model.parameters.size(); ++k) {
    std::vector<double> values(joints_);
    if (model.parameters[k].text.empty()) {
      for (std::size_t j = 0; j < joints_; ++j) values[j] = model.parameters[k].number[j];
    } else {
      EquationProgram(parsed.names, tables, {&parsed.parameters[k], 1}).run({}, values);
    }
    check_finite(robot, "parameter " + model.parameters[k].name, values);
    tables.parameters.push_back(std::move(values));
  }
  initial_ = EquationProgram(parsed.names, tables, parsed.initial);
  derivative_ = EquationProgram(parsed.names, tables, parsed.states);
  output_ = EquationProgram(parsed.names, tables, {&parsed.output, 1});
  std::vector<double> start(states());
  initial_.run({}, start);
  for (std::size_t k = 0; k < states_.size(); ++k) {
    check_finite(robot, "initial " + states_[k], In(start).subspan(k * joints_, joints_));
  }
}

std::string Equations::state_name(std::size_t index) const {
  return states_[index / joints_] + "." + std::to_string(index % joints_);
}

void Equations::start(Out state) const { initial_.run({}, state); }

void Equations::derivative(const Measured& measured, In state, Out rate) const {
  derivative_.run({measured.t, state, measured.angle, measured.speed, measured.torque, measured.touching}, rate);
}

void Equations::output(double t, In state, Out setpoint) const { output_.run({t, state, {}, {}, {}, {}}, setpoint); }

}  // namespace gaitlab::cpg
