#include "kit/run_time.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <optional>

#include "core/errors.h"
#include "core/laws/heap.h"
#include "core/simulation/twin_windows.h"

namespace gaitlab::kit {

namespace {

// CPU time of a run = process + start + steps + companions + rows, each computed from counts and the constants beside its
// equation. The constants were fitted to times of the parts of runs, the smaller of two measurements each: chains of 10 to 3000
// modules and carts of 4 to 64 wheels, both engines, with and without an estimate (docs/benchmarks.md, estimates;
// bench/estimates.cpp compares whole runs).

/// Cost of a step of one rollout, us: base + link * links + contact * contact elements + joint * driven joints + box * boxes
/// that move; times 1 + links / doubled in Bullet, because the data of long robots do not fit in the cache.
struct StepCost {
  std::string_view engine, integrator;
  ContactLaw law;
  double base, link, contact, joint, box;
  double doubled;  ///< number of links at which the cost of each link has doubled; infinity if that cost is constant
};
constexpr double kAny = std::numeric_limits<double>::infinity();
constexpr std::array kStepCosts{
    StepCost{"bullet", "semi_implicit", ContactLaw::penalty, 0.4, 0.72, 0.05, 0, 0, 4000},
    StepCost{"bullet", "rk4", ContactLaw::penalty, 1.6, 2.9, 0.2, 0, 0, 4000},
    StepCost{"bullet", "implicit", ContactLaw::penalty, 1.5, 0.85, 0.025, 0, 0, kAny},
    StepCost{"bullet", "extrapolated", ContactLaw::penalty, 4, 2.3, 0.06, 0, 0, kAny},
    StepCost{"bullet", "adaptive", ContactLaw::penalty, 1.5, 0.85, 0.025, 0, 0, kAny},  // cost of a solve
    StepCost{"bullet", "semi_implicit", ContactLaw::solver, 0, 4.5, 2, 8, 11, 4000},
    StepCost{"articulated", "implicit", ContactLaw::penalty, 1.1, 0.4, 0.025, 0, 0, kAny},
    StepCost{"articulated", "extrapolated", ContactLaw::penalty, 2.8, 1, 0.06, 0, 0, kAny},
    StepCost{"articulated", "rk4", ContactLaw::penalty, 0, 1.3, 0.05, 0, 0, kAny},
    StepCost{"articulated", "adaptive", ContactLaw::penalty, 1.1, 0.4, 0.025, 0, 0, kAny},  // cost of a solve
};
constexpr double kOnBoxes = 0.1;  // us per contact element and step, on ground with boxes
constexpr double kUnknown = 1e3;  // us per step of an engine that the table lacks

const StepCost* cost_of(const Scenario& s) {
  const auto same = [&](const StepCost& c) {
    return s.physics.engine->name == c.engine && s.physics.integrator->name == c.integrator && s.contact.law == c.law;
  };
  const auto* const found = std::ranges::find_if(kStepCosts, same);
  return found == kStepCosts.end() ? nullptr : found;
}

double links(const Scenario& s) { return static_cast<double>(s.robot->links.size()); }

double driven_joints(const Scenario& s) {
  if (s.actuator.entry == nullptr) return 0;
  return static_cast<double>(std::ranges::count_if(s.robot->joints, [](const Joint& joint) { return joint.driven(); }));
}

double contacts(const Scenario& s) { return static_cast<double>(contact_elements(*s.robot, s.contact.on).size()); }

/// Cost of a step without companions, us.
double step_us(const StepCost& cost, const Scenario& s) {
  const auto moving = static_cast<double>(std::ranges::count_if(s.ground.boxes(), [](const Box& b) { return b.mass > 0; }));
  const double contact = cost.contact + (s.ground.boxes().empty() ? 0 : kOnBoxes);
  const double us =
      cost.base + cost.link * links(s) + contact * contacts(s) + cost.joint * driven_joints(s) + cost.box * moving;
  return us * (1 + links(s) / cost.doubled);
}

/// Time for reading, checking, assembling and judging, s: per link and, to compute the set points of a CPG alone, per driven
/// joint.
double start_seconds(const Scenario& s, bool in_study) {
  constexpr double kLink = 7e-4, kLinkInStudy = 1.5e-4, kCpg = 4e-4;
  return (in_study ? kLinkInStudy : kLink) * links(s) + (s.cpg.entry == nullptr ? 0 : kCpg * driven_joints(s));
}

/// Time for recording, summarising, writing and drawing the rows of a trace, s.
double row_seconds(const RowsNeeded& rows) {
  constexpr double kRow = 8e-6, kCell = 2e-7;
  return rows.rows * (kRow + kCell * rows.columns);
}

/// Factor by which companion rollouts, which estimate the torque error of a run with an accuracy, increase the cost of a solve.
/// Three companions in lanes beside the run need four times as much of the cache.
double companions(const Scenario& s) {
  constexpr double kLanes = 1.4, kLinks = 2500, kMost = 5.6;
  if (!estimated_by_rollouts(s)) return 1;
  const auto& widths = s.physics.engine->lanes;
  const bool in_lanes = std::ranges::find(widths, 1 + kCompanions) != widths.end();
  return in_lanes ? std::min(kMost, kLanes + links(s) / kLinks) : 1.0 + static_cast<double>(kCompanions);
}

/// Number of steps of a run with `steps` fixed steps, including those of its twin.
double steps_with_twin(const Scenario& s, double steps) {
  const Physics& physics = s.physics;
  const bool possible = physics.integrator->order > 0 && s.contact.model().complete_state && !s.robot->joints.empty();
  if (physics.estimate != Estimate::full || !possible || s.actuator.entry == nullptr) return steps;
  const TwinWindows how = twin_windows(s, s.physics.integrator->limited);
  const auto window = static_cast<double>(how.window), cycle = static_cast<double>(how.cycle);
  const double whole = std::floor(steps / cycle);
  const double covered = whole * window + std::min(window, steps - whole * cycle);
  return steps + covered * (how.steps < 0 ? -how.steps : 1.0 / how.steps);
}

/// Cost of the searches in a heap of boxes, us per step, if all contact elements are in it. It decides only the length of
/// trials, because few robots walk through a heap.
double heap_us(const Scenario& s) {
  constexpr double kSearch = 4;           // us per box of the heap and contact element
  constexpr std::size_t kFewInPlace = 3;  // up to this number of boxes, searches take as long as for one box
  const std::size_t boxes = most_in_one_place(s.ground.boxes());
  return boxes <= kFewInPlace ? 0 : kSearch * static_cast<double>(boxes) * contacts(s);
}

std::int64_t steps_in_trial(const Scenario& s) {
  constexpr double kPeriods = 100;
  constexpr std::size_t kManyBoxes = 100;  // overlapping boxes may take seconds per step, unlike in the table of costs
  if (s.ground.boxes().size() > kManyBoxes) return 1;
  return std::max<std::int64_t>(2, std::llround(kPeriods * s.control_period / s.physics.step));
}

constexpr double kCoarse = 0.1;      // accuracy of the trial; a hundred control periods then take about 5 ms
constexpr double kTrial = 30e3;      // us of work to count solves
constexpr double kFirstSteps = 4e3;  // us of work to find early failures

/// Solves per simulated second of a walking robot with this accuracy, fitted to the geometric mean of the shipped scenarios.
/// The first term counts undivided steps of length `step`, the second divided steps.
double typical_solves(double accuracy, double step) { return 3 / step + 4200 * std::pow(0.001 / accuracy, 0.85); }

/// Number of solves so far, before the first and after each step of a trial with a coarse accuracy. Only the initial 0 if the
/// trial fails.
std::vector<double> coarse_solves(const Scenario& s, double us) {
  std::vector<double> solves{0};
  try {
    Scenario trial = s;
    trial.physics.estimate = Estimate::off;
    trial.physics.accuracy = kCoarse;
    Simulation simulation({&trial, 1}, {Loads::left_out, false});
    const std::int64_t most = steps_in_trial(s);
    while (!simulation.done() && simulation.step_number() < most && (solves.size() < 3 || solves.back() * us < kTrial)) {
      simulation.step();
      solves.push_back(simulation.solves(0));
    }
  } catch (const InputError&) {
    return {0};
  } catch (const RunError&) {
    return {0};
  }
  return solves;
}

/// Solves per step of a robot too large for a long trial. They rise with the number of joints, because any joint can decide the
/// step. Chains of 100 to 1000 modules need 32, 95 and 170 at accuracy 0.01.
double solves_of_many(const Scenario& s) {
  constexpr double kJoint = 0.1, kOf = 0.01, kExponent = 0.57;
  return 3 + kJoint * static_cast<double>(s.robot->joints.size()) * std::pow(kOf / s.physics.accuracy, kExponent);
}

/// Solves of a run of `steps` steps with an integrator that divides them. Steps at the start are divided more than later ones,
/// and the more, the finer the accuracy (kStart). Later steps have the rate of the second half of a trial.
double adaptive_solves(const Scenario& s, double us, double steps) {
  constexpr double kStart = 0.6;    // exponent of the accuracy
  constexpr std::size_t kFew = 32;  // steps of a trial from which a rate can be seen
  const double step = s.physics.step, accuracy = s.physics.accuracy;
  const double typical = typical_solves(accuracy, step) * step, least = 3;
  const std::vector<double> solves = coarse_solves(s, us + heap_us(s));
  const std::size_t last = solves.size() - 1;
  const auto start = [&](std::size_t n) {
    return std::max(least * static_cast<double>(n), solves[n] * std::pow(kCoarse / accuracy, kStart));
  };
  if (last < 2) return typical * steps;
  if (steps <= static_cast<double>(last)) return start(static_cast<std::size_t>(steps));
  if (last < kFew) return start(last) + std::max(typical, solves_of_many(s)) * (steps - static_cast<double>(last));
  const std::size_t half = last / 2;
  const double found = (solves[last] - solves[half]) / static_cast<double>(last - half);
  const double rate = std::max(least, typical * found / (typical_solves(kCoarse, step) * step));
  return start(half) + rate * (steps - static_cast<double>(half));
}

/// CPU time of the steps and of the companions, s.
double steps_seconds(const Scenario& s) {
  const StepCost* const cost = cost_of(s);
  if (cost == nullptr) return 0;
  const double us = step_us(*cost, s), steps = std::ceil(s.duration / s.physics.step - 1e-9);
  if (s.physics.adapts()) return 1e-6 * us * companions(s) * adaptive_solves(s, us, steps);
  return 1e-6 * us * steps_with_twin(s, steps);
}

}  // namespace

double estimated_seconds(const Scenario& scenario, const RowsNeeded& rows) {
  constexpr double kProcess = 0.03;  // s: start of the program, page of a small robot
  const double steps = steps_seconds(scenario);
  return steps > 0 ? kProcess + start_seconds(scenario, false) + steps + row_seconds(rows) : 0;
}

double estimated_seconds_in_study(const Scenario& scenario) {
  constexpr double kRun = 0.03;  // s: statistics and verdict of a small robot
  const double steps = steps_seconds(scenario);
  return steps > 0 ? kRun + start_seconds(scenario, true) + steps : 0;
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
