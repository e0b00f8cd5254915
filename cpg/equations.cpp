#include "cpg/equations.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "core/model/pattern.h"

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
events      changes of states when a condition becomes true: {when: CONDITION, set: {NAME: value}, of: joints (default: all)}.
            A condition is looked at once per control tick, for each joint, before the output; its values are 0 and 1 in the
            states event0.J, event1.J ... All values of a `set` are computed from the states before it.
inputs      NAME: value of a sensor, for those whose names are not words with dots: {foot: feet.m5/passive}
parameters  NAME: a number, a list, {default: 1, m3/passive: 2}, or a text of what is fixed: parameters above it and
            given: frequency Hz, omega = 2 pi frequency, amplitude, offset, phase (limit cycle of the couplings, rad),
            index (of the joint, from 0), joints (their number), depth (hinges towards the base), side (1 left, -1 right, 0)
A model with states has no defaults for parameters, initial and output. pi, the given names and parameters may be used
anywhere; states and t (s) in derivatives, events and output; measured values at the control tick only in derivatives and
events: angle rad, speed rad/s, torque N m, touching (1 while the joint's module touches the ground, else 0), load N (normal
force on the link that the joint moves), limb_load N (the same with all links beyond it), limb_touching (1 if limb_load is
above 0), and values of sensors by their names, such as imu.roll (trace column sensor.imu.roll; one number for all joints).

    sum(j in neighbours, TERM)      over the couplings by which joint i follows a joint j. In TERM: NAME[j], and of the
                                    coupling w[i,j] (its weight) and psi[i,j] (minus its phase_lag: phi_i = phi_j - psi_ij)
    + - * / ^   < <= > >= == !=   and or not      comparisons give 1 or 0; every value except 0 is true, NaN (such as
                                                  log(-1)) included
    sin cos tan tanh exp log sqrt abs sign        of one number; log: natural; sign(0) = 0
    min(a, b)  max(a, b)  clamp(x, low, high)  if(condition, then, else)
    mod(a, b)  atan2(y, x)                        mod: a - b floor(a/b), in [0, b), b > 0; atan2: angle of (x, y), rad

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
  struct Event {
    Term when;
    std::vector<Term> set;
    std::vector<std::size_t> states;  ///< states that `set` changes
  };
  std::vector<Event> events;
  std::vector<Fault> faults;

  explicit Parsed(const EquationsModel& model) {
    declare("states", model.states, Kind::state, Equations::kMostStates);
    declare("parameters", model.parameters, Kind::parameter, Equations::kMostParameters);
    if (model.inputs.size() > Equations::kMostInputs)
      faults.push_back({"inputs", "", std::string::npos, "more than " + std::to_string(Equations::kMostInputs) + " inputs"});
    for (const Named& input : std::span(model.inputs).first(std::min(model.inputs.size(), Equations::kMostInputs))) {
      if (const std::string wrong = names.declare_channel(input.name, input.text); !wrong.empty())
        faults.push_back({"inputs", input.name, std::string::npos, wrong});
    }
    if (model.states.size() > Equations::kMostStates || model.parameters.size() > Equations::kMostParameters) return;
    for (std::size_t k = 0; k < model.parameters.size(); ++k) {
      parameters.push_back(tree("parameters", model.parameters[k].name, model.parameters[k].text, Where::parameter, k));
    }
    for (const Named& state : model.states) states.push_back(tree("states", state.name, state.text, Where::derivative, 0));
    initial.resize(model.states.size());
    for (const Named& value : model.initial) {
      const auto state = std::ranges::find(model.states, value.name, &Named::name);
      if (state == model.states.end()) {
        faults.push_back({"initial", value.name, std::string::npos, not_a_state(model, value.name)});
      } else {
        initial[static_cast<std::size_t>(state - model.states.begin())] =
            tree("initial", value.name, value.text, Where::initial, 0);
      }
    }
    output = tree("output", "", model.output, Where::output, 0);
    if (model.events.size() > Equations::kMostEvents)
      faults.push_back({"events", "", std::string::npos, "more than " + std::to_string(Equations::kMostEvents) + " events"});
    for (std::size_t k = 0; k < std::min(model.events.size(), Equations::kMostEvents); ++k) add_event(model, k);
    for (const Named& state : model.states) {
      const bool taken = state.name.starts_with("event") && state.name.size() > 5 &&
                         state.name.find_first_not_of("0123456789", 5) == std::string::npos;
      if (taken && !model.events.empty())
        faults.push_back({"states", state.name, std::string::npos, "'" + state.name + "' is the name of an event's state"});
    }
  }

 private:
  static std::string not_a_state(const EquationsModel& model, const std::string& name) {
    std::vector<std::string> known;
    for (const Named& one : model.states) known.push_back(one.name);
    return "'" + name + "' is not a state" + offer_name(name, known, "states");
  }

  /// Adds the trees of an event. The place of a fault within a list is its key, so that the message names the event.
  void add_event(const EquationsModel& model, std::size_t k) {
    const std::size_t before = faults.size();
    const EquationEvent& given = model.events[k];
    Event& event = events.emplace_back();
    const auto of_event = [&](std::size_t from, const std::string& where) {
      for (std::size_t i = from; i < faults.size(); ++i) {
        const std::size_t at = std::exchange(faults[i].offset, std::string::npos);
        faults[i].name.clear();
        faults[i].what = "event " + std::to_string(k) + ", " + where +
                         (at == std::string::npos ? "" : ", character " + std::to_string(at + 1)) + ": " + faults[i].what;
      }
    };
    event.when = tree("events", "", given.when, Where::event, 0);
    of_event(before, "when");
    for (const Named& one : given.set) {
      const std::size_t own = faults.size();
      const auto state = std::ranges::find(model.states, one.name, &Named::name);
      if (state == model.states.end()) {
        faults.push_back({"events", "", std::string::npos, not_a_state(model, one.name)});
      } else {
        event.states.push_back(static_cast<std::size_t>(state - model.states.begin()));
        event.set.push_back(tree("events", "", one.text, Where::event, 0));
      }
      of_event(own, "set." + one.name);
    }
  }

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
      names.declare_channels(term);
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
  for (const JointInfo& joint : robot.joints) {
    tables.module.push_back(static_cast<std::size_t>(joint.module));
    tables.parent.push_back(joint.parent);
  }
  for (const GivenValue& given : given_values()) {
    std::vector<double> values;
    for (std::size_t j = 0; j < tables.joints; ++j) values.push_back(given.value(robot, keys, network.phases, j));
    tables.given.push_back(std::move(values));
  }
  return tables;
}

/// Joints whose names match one of the patterns.
std::vector<std::size_t> joints_of(const RobotInfo& robot, const std::vector<std::string>& patterns) {
  std::vector<std::size_t> found;
  for (std::size_t j = 0; j < robot.joints.size(); ++j) {
    const auto matches = [&](const std::string& pattern) { return glob(pattern, robot.joints[j].name); };
    if (std::ranges::any_of(patterns, matches)) found.push_back(j);
  }
  return found;
}

/// Number in RobotInfo::channels of each name.
std::vector<std::size_t> channels_of(const RobotInfo& robot, const std::vector<std::string>& names) {
  std::vector<std::size_t> found;
  for (const std::string& name : names) {
    const auto at = std::ranges::find(robot.channels, name);
    if (at == robot.channels.end()) {
      throw std::invalid_argument("'" + name.substr(0, 80) + "' is unknown" +
                                  (robot.channels.empty() ? std::string("; no sensor of this scenario gives such values")
                                                          : offer_name(name, robot.channels, "values of sensors")));
    }
    found.push_back(static_cast<std::size_t>(at - robot.channels.begin()));
  }
  return found;
}

}  // namespace

void EquationEvent::fields(Fields& f) {
  f.text("when", when, "Condition, looked at once per control tick, before the output.");
  if (when.empty()) f.problem("when", "no condition is given; expected for example: limb_touching and mod(phi, 2*pi) > pi");
  f.named("set", set, NamedValues::texts, "New values of states, from the states before, when the condition becomes true.");
  if (set.empty()) f.problem("set", "nothing is set; expected for example: {phi: 0}");
  if (of.empty()) of = {"*"};
  f.names("of", of, Among::joints, "Joints for which the condition is looked at: a name, a pattern, or a list.");
}

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
  f.named("inputs", inputs, NamedValues::texts, "Names for values of sensors, such as {foot: feet.m5/passive}.");
  f.list("events", events, "Changes of states when a condition becomes true.");
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
  tables.channels = channels_of(robot, parsed.names.channels());
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
  std::vector<double> start(states_.size() * joints_);
  initial_.run({}, start);
  for (std::size_t k = 0; k < states_.size(); ++k) {
    check_finite(robot, "initial " + states_[k], In(start).subspan(k * joints_, joints_));
  }
  std::size_t most = 0;
  for (std::size_t k = 0; k < parsed.events.size(); ++k) {
    const Parsed::Event& event = parsed.events[k];
    events_.push_back({EquationProgram(parsed.names, tables, {&event.when, 1}),
                       EquationProgram(parsed.names, tables, event.set), joints_of(robot, model.events[k].of), event.states});
    for (const std::string& pattern : model.events[k].of) {
      if (joints_of(robot, {pattern}).empty()) {
        throw SettingError("model.events", "model.events: event " + std::to_string(k) + ", of: '" + pattern.substr(0, 80) +
                                               "' matches no joint");
      }
    }
    if (events_.back().joints.empty())
      throw SettingError("model.events", "model.events: event " + std::to_string(k) + ", of: no joint is named");
    most = std::max(most, event.set.size());
  }
  condition_.resize(joints_);
  values_.resize(most * joints_);
}

std::string Equations::state_name(std::size_t index) const {
  const std::size_t block = index / joints_;
  const std::string name = block < states_.size() ? states_[block] : "event" + std::to_string(block - states_.size());
  return name + "." + std::to_string(index % joints_);
}

void Equations::start(Out state) const {
  std::fill(state.begin(), state.end(), 0.0);
  initial_.run({}, state);
}

void Equations::derivative(const Measured& m, In state, Out rate) const {
  std::fill(rate.begin() + static_cast<std::ptrdiff_t>(states_.size() * joints_), rate.end(), 0.0);
  derivative_.run({m.t, state, m.angle, m.speed, m.torque, m.touching, m.load, m.channels}, rate);
}

void Equations::event(const Measured& m, Out state) const {
  for (std::size_t k = 0; k < events_.size(); ++k) {
    const Event& event = events_[k];
    const EquationInputs inputs{m.t, state, m.angle, m.speed, m.torque, m.touching, m.load, m.channels};
    event.when.run(inputs, condition_);
    event.set.run(inputs, values_);
    const Out was = state.subspan((states_.size() + k) * joints_, joints_);
    for (const std::size_t j : event.joints) {
      const double now = condition_[j] != 0 ? 1 : 0;
      for (std::size_t s = 0; now > was[j] && s < event.states.size(); ++s)
        state[event.states[s] * joints_ + j] = values_[s * joints_ + j];
      was[j] = now;
    }
  }
}

void Equations::output(double t, In state, Out setpoint) const { output_.run({t, state, {}, {}, {}, {}}, setpoint); }

}  // namespace gaitlab::cpg
