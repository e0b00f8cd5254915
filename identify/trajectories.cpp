#include "identify/trajectories.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <numbers>

#include "core/errors.h"
#include "core/math/functions.h"

namespace gaitlab::identify {

namespace {

constexpr double kPi = std::numbers::pi;
constexpr double kOfSweep = 2.0 / 3;                  // share of A, because a fast arm overshoots; chosen
constexpr double kSlower = 0.62, kFaster = 0.38;      // shares of A; chosen
constexpr double kRatio = 3.5;                        // of the two frequencies, so that no pattern returns soon; chosen
constexpr double kOfSpeed = 0.5;                      // share of V; chosen
constexpr double kLifted = 1.0 / 3, kReleased = 0.5;  // shares of D; chosen

/// Refuses a sweep that the rows do not show.
void check(const TrajectorySettings& of) {
  constexpr double kLeastTurns = 2, kLeastRows = 20;  // chosen
  const double size = kOfSweep * of.amplitude;
  const double turns = of.speed * of.duration / (4 * kPi * size);  // a D^2 / (2 pi)
  if (turns < kLeastTurns) {
    throw InputError(SourceLocation{"gaitlab new log"},
                     fmt::format("a speed of {:.4g} rad/s is reached after {:.2g} turns of the sweep; expected at least {}: a "
                                 "smaller --amplitude, or a longer --duration",
                                 of.speed, turns, kLeastTurns));
  }
  const double rows = of.rate * 2 * kPi * size / of.speed;
  if (rows < kLeastRows) {
    throw InputError(SourceLocation{"gaitlab new log"},
                     fmt::format("the fastest turn of the sweep has {:.2g} rows; expected at least {}: a larger --rate or "
                                 "--amplitude",
                                 rows, kLeastRows));
  }
}

double raised(double phase) { return (1 - math::cos(phase)) / 2; }

}  // namespace

std::vector<Trajectory> trajectories(const TrajectorySettings& of) {
  check(of);
  const double A = of.amplitude, D = of.duration;
  const double a = of.speed / (2 * kOfSweep * A * D);
  const double w = kOfSpeed * of.speed / (A * (kSlower + kFaster * kRatio));
  std::vector<Trajectory> all{
      {"sweep", "a sine that becomes faster: line of the motor, inertia of the rotor, latency", {}, {}, {}},
      {"sines", "a sum of two sines: the same numbers in another motion", {}, {}, {}},
      {"drop", "lifted, then released without torque: friction apart from the motor", {}, {}, {}},
      {"slow", "lifted and lowered slowly: the share that the gears take under load", {}, {}, {}}};
  const auto rows = static_cast<std::size_t>(std::llround(D * of.rate));
  for (std::size_t k = 0; k <= rows; ++k) {
    const double t = static_cast<double>(k) / of.rate;
    const double goals[] = {kOfSweep * A * math::sin(a * t * t),
                            A * (kSlower * math::sin(w * t) + kFaster * math::sin(kRatio * w * t)),
                            A * raised(kPi * std::min(1.0, t / (kLifted * D))), A * raised(2 * kPi * t / D)};
    for (std::size_t i = 0; i < all.size(); ++i) {
      all[i].t.push_back(t);
      all[i].goal.push_back(goals[i]);
      all[i].on.push_back(all[i].name != std::string("drop") || t < kReleased * D);
    }
  }
  return all;
}

std::string trajectory_text(const Trajectory& trajectory) {
  std::string text =
      fmt::format("# {}\n# t: s; goal: rad; on: 1, or 0 while the servo has no torque\nt,goal,on\n", trajectory.about);
  for (std::size_t k = 0; k < trajectory.t.size(); ++k) {
    const double goal = std::abs(trajectory.goal[k]) < 5e-7 ? 0 : trajectory.goal[k];  // without -0.000000
    fmt::format_to(std::back_inserter(text), "{:.6f},{:.6f},{:d}\n", trajectory.t[k], goal, trajectory.on[k] ? 1 : 0);
  }
  return text;
}

}  // namespace gaitlab::identify
