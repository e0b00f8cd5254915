// Many rollouts of one robot: side by side in lanes, and packs of lanes side by side in threads.
#pragma once
#include <algorithm>
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
