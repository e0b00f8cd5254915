#include "kit/run_time.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

#include "core/errors.h"
#include "core/laws/heap.h"

namespace gaitlab::kit {

namespace {

/// Cost of a step, us: base + link * links + contact * contact elements + box * boxes that move. Measured on chains of 1 to 16
/// modules, with contact elements on no body, on the feet and on all bodies, without companion rollouts.
struct StepCost {
  std::string_view engine, integrator;
  ContactLaw law;
  double base, link, contact, box;
};
constexpr std::array kStepCosts{
    StepCost{"bullet", "semi_implicit", ContactLaw::penalty, 0.25, 0.44, 0.02, 0},
    StepCost{"bullet", "rk4", ContactLaw::penalty, 1, 1.7, 0.08, 0},
    StepCost{"bullet", "semi_implicit", ContactLaw::solver, 0, 3.3, 1.5, 11},
    StepCost{"articulated", "implicit", ContactLaw::penalty, 0.75, 0.25, 0.015, 0},
    StepCost{"articulated", "extrapolated", ContactLaw::penalty, 1.9, 0.62, 0.04, 0},
    StepCost{"articulated", "rk4", ContactLaw::penalty, 0, 0.72, 0.03, 0},
    StepCost{"articulated", "adaptive", ContactLaw::penalty, 0.75, 0.25, 0.015, 0},  // of a solve, not of a step
};
constexpr double kOnBoxes = 0.1;         // us per contact element and step, on ground with boxes
constexpr double kCompanionLanes = 1.5;  // cost of a solve with three companions in lanes, over a solve alone
constexpr double kTwinWindows = 1.1;     // cost of a run with twin windows over one without
constexpr double kCell = 0.1;            // us per number in the trace: recorded, summarised and written
constexpr double kStart = 0.08;          // s: reading, verdict, figure and page
constexpr double kStartInStudy = 0.03;   // s: reading and verdict
constexpr double kTrial = 10e3;          // us of work to count solves
constexpr double kFirstSteps = 4e3;      // us of work to find early failures
constexpr double kUnknown = 1e3;         // us per step of an engine that the table lacks

const StepCost* cost_of(const Scenario& s) {
  const auto same = [&](const StepCost& c) {
    return s.physics.engine->name == c.engine && s.physics.integrator->name == c.integrator && s.contact.law == c.law;
  };
  const auto* const found = std::ranges::find_if(kStepCosts, same);
  return found == kStepCosts.end() ? nullptr : found;
}

/// Cost of a step without companions, us.
double step_us(const StepCost& cost, const Scenario& s) {
  const auto contacts = static_cast<double>(contact_elements(*s.robot, s.contact.on).size());
  const auto moving = static_cast<double>(std::ranges::count_if(s.ground.boxes(), [](const Box& b) { return b.mass > 0; }));
  return cost.base + cost.link * static_cast<double>(s.robot->links.size()) + cost.box * moving +
         contacts * (cost.contact + (s.ground.boxes().empty() ? 0 : kOnBoxes));
}

std::int64_t steps_in_trial(const Scenario& s) {
  constexpr double kPeriods = 100;
  constexpr std::size_t kManyBoxes = 100;  // one step may take seconds if they overlap, which the table of costs lacks
  if (s.ground.boxes().size() > kManyBoxes) return 1;
  return std::max<std::int64_t>(2, std::llround(kPeriods * s.control_period / s.physics.step));
}

/// Cost of the searches in a heap of boxes, us per step, if all contact elements are in it. Only for the length of trials,
/// because few robots walk through a heap.
double heap_us(const Scenario& s) {
  constexpr double kSearch = 4;           // us per box of the heap and contact element
  constexpr std::size_t kFewInPlace = 3;  // boxes whose searches take as long as those of one
  const std::size_t boxes = most_in_one_place(s.ground.boxes());
  if (boxes <= kFewInPlace) return 0;
  return kSearch * static_cast<double>(boxes * contact_elements(*s.robot, s.contact.on).size());
}

constexpr double kCoarse = 0.1;  // accuracy of the trial, with which a hundred control periods take about 5 ms

/// Solves per second of a walking robot with this accuracy: the geometric mean of the shipped scenarios, with solves of steps
/// of `step` that need no division and of divided ones.
double typical_solves(double accuracy, double step) { return 3 / step + 4200 * std::pow(0.001 / accuracy, 0.85); }

/// Solves per second of the scenario with a coarse accuracy, in the second half of the trial, because the start is divided
/// more. Nothing if the trial fails.
std::optional<double> coarse_solves(const Scenario& s, double us) try {
  Scenario trial = s;
  trial.physics.estimate = Estimate::off;
  trial.physics.accuracy = kCoarse;
  Simulation simulation({&trial, 1}, {Loads::left_out, false});
  const std::int64_t most = steps_in_trial(s);
  std::vector<double> solves{0};  // after each step
  while (!simulation.done() && simulation.step_number() < most && (solves.size() < 3 || solves.back() * us < kTrial)) {
    simulation.step();
    solves.push_back(simulation.solves(0));
  }
  const std::size_t last = solves.size() - 1, half = last / 2;
  if (last < 2) return {};
  return (solves[last] - solves[half]) / (static_cast<double>(last - half) * s.physics.step);
} catch (const InputError&) {
  return {};
} catch (const RunError&) {
  return {};
}

/// Number of steps in a second, or of solves for an integrator that chooses its steps.
double steps_per_second(const Scenario& s, double us) {
  if (!s.physics.adapts()) return 1 / s.physics.step;
  const double step = s.physics.step, typical = typical_solves(s.physics.accuracy, step);
  const std::optional<double> found = coarse_solves(s, us + heap_us(s));
  return found ? std::max(3 / step, typical * *found / typical_solves(kCoarse, step)) : typical;
}

/// Factor of the companion rollouts that estimate the torque error.
double companions(const Scenario& s) {
  const Physics& physics = s.physics;
  if (physics.estimate == Estimate::off || s.actuator.entry == nullptr || s.robot->joints.empty()) return 1;
  if (!physics.adapts()) return physics.integrator->order > 0 && s.contact.model().complete_state ? kTwinWindows : 1;
  const auto& widths = physics.engine->lanes;
  const bool in_lanes = std::ranges::find(widths, 1 + kCompanions) != widths.end();
  return in_lanes ? kCompanionLanes : 1.0 + static_cast<double>(kCompanions);
}

/// CPU time of the steps without companions, s.
double steps_seconds(const Scenario& s) {
  const StepCost* const cost = cost_of(s);
  if (cost == nullptr) return 0;
  const double us = step_us(*cost, s);
  return 1e-6 * us * steps_per_second(s, us) * s.duration;
}

}  // namespace

double estimated_seconds(const Scenario& scenario, const RowsNeeded& rows) {
  const double steps = steps_seconds(scenario);
  return steps > 0 ? steps * companions(scenario) + 1e-6 * kCell * rows.rows * rows.columns + kStart : 0;
}

double estimated_seconds_in_study(const Scenario& scenario) {
  const double steps = steps_seconds(scenario);
  return steps > 0 ? steps * companions(scenario) + kStartInStudy : 0;
}

std::string early_failure(Simulation& simulation, const Scenario& scenario) try {
  const StepCost* const cost = cost_of(scenario);
  const double us = companions(scenario) * (cost == nullptr ? kUnknown : step_us(*cost, scenario)) + heap_us(scenario);
  const auto work = [&] { return us * std::max(static_cast<double>(simulation.step_number()), simulation.solves(0)); };
  while (!simulation.done() && simulation.step_number() < steps_in_trial(scenario) && work() < kFirstSteps) simulation.step();
  return "";
} catch (const RunError& error) {
  return error.what();
}

}  // namespace gaitlab::kit
