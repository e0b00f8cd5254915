// Many rollouts of one robot: side by side in lanes, and packs of lanes side by side in threads.
#pragma once
#include <algorithm>
#include <atomic>
#include <exception>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <type_traits>
#include <vector>

#include "core/simulation/simulation.h"

namespace gaitlab {

struct BatchSettings {
  int threads = 1;
  std::size_t lanes = 0;  ///< at most so many side by side; 0: as many as engine and processor allow
};

/// Runs every scenario to its end: CPG, controller and trace of each by itself at its ticks, the steps of several at once.
/// They may differ in everything; those that share engine, integrator, step, kind of actuator and the structure of the robot
/// share lane groups (can_share). A rollout has the bits it has alone: the result does not depend on threads, lanes
/// or the other rollouts, whether these have ended, diverged or are limited.
/// end(i, recording): once for each rollout, from several threads at once, in any order. What diverged, or whose plugin threw,
/// is recorded until there (Recording::outcome).
/// Throws InputError where a scenario's step is refused or its plugin cannot be made: the first such, after all others ended.
void run_batch(std::span<const Scenario> rollouts, const BatchSettings& settings,
               const std::function<void(std::size_t, Recording&&)>& end);

/// A rollout under the number that its maker gives it.
struct Rollout {
  std::size_t number = 0;
  Scenario scenario;
};

/// How it ended: `recording`, also of one that diverged or whose plugin threw (Recording::outcome); or why it could not begin.
struct RolloutEnd {
  Rollout rollout;
  Recording recording = {};
  std::vector<Problem> refused = {};  ///< none: it ran
};

/// Where a batch takes its rollouts from and gives their ends to.
struct BatchStream {
  /// The next rollout, or nothing when all were given. One call at a time.
  std::function<std::optional<Rollout>()> next;
  /// Those that run side by side from now on. One call at a time; may be empty.
  std::function<void(std::span<const Rollout>)> begin = {};
  /// Asked of each once every simulated second, with what it has recorded so far (Simulation::watch): why it is to end there,
  /// which becomes its outcome, or "". From several threads at once; may be empty.
  std::function<std::string(const Rollout&, const Recording& so_far)> watch = {};
  /// Of those that ran side by side. From several threads at once, in any order.
  std::function<void(std::vector<RolloutEnd>&&)> end;
};

/// run_batch for any number of rollouts: as a thread becomes free it takes the next ones that can share lanes, of those it
/// looks ahead to (`look_ahead` of them, and those that run, exist at a time). Once `stop` is set, no pack begins, those that
/// run end at their next step, and nothing is told of them. False: it was stopped. What `next`, `begin` or `end` throw stops
/// the batch, and is thrown when all threads have ended.
bool run_pulled(const BatchStream& stream, const BatchSettings& settings, Loads loads, std::atomic<bool>& stop,
                std::size_t look_ahead = 64);

/// The same for any number of rollouts, of which few exist at a time: `next()` gives the scenarios one by one, nothing at the
/// end; `digest(scenario, recording)` makes of each what is kept, in several threads at once, and does not throw;
/// `sink(digest)` gets those in the order of next(), one at a time, whatever threads and lanes are. Throws what run_batch or
/// next() throws, after the sink has all before the first refused.
template <class Digest>
void run_stream(const std::function<std::optional<Scenario>()>& next, const BatchSettings& settings, Digest digest,
                const std::function<void(std::invoke_result_t<Digest, const Scenario&, Recording&&>&&)>& sink) {
  using Kept = std::invoke_result_t<Digest, const Scenario&, Recording&&>;
  constexpr std::size_t kGroups = 4;     // lane groups for each thread before all wait for the last of them
  constexpr std::size_t kMostLanes = 8;  // of any engine
  const std::size_t window = kGroups * kMostLanes * static_cast<std::size_t>(std::max(1, settings.threads));
  for (bool more = true; more;) {
    std::vector<Scenario> rollouts;
    std::exception_ptr refused;
    try {
      while (more && rollouts.size() < window) {
        std::optional<Scenario> one = next();
        more = one.has_value();
        if (one) rollouts.push_back(std::move(*one));
      }
    } catch (...) {
      refused = std::current_exception();  // thrown again when the sink has what came before
    }
    std::vector<std::optional<Kept>> kept(rollouts.size());
    try {
      run_batch(rollouts, settings,
                [&](std::size_t i, Recording&& recording) { kept[i] = digest(rollouts[i], std::move(recording)); });
    } catch (...) {
      refused = std::current_exception();
    }
    for (std::optional<Kept>& one : kept) {
      if (!one) break;
      sink(std::move(*one));
    }
    if (refused) std::rethrow_exception(refused);
  }
}

/// The scenario of a file with overrides in common and each rollout's own, as of --set. Errors of all rollouts at once.
std::vector<Scenario> rollouts(const std::string& file, const std::vector<std::string>& sets,
                               std::span<const std::vector<std::string>> own, Catalog& catalog);

}  // namespace gaitlab
