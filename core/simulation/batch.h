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
  std::size_t lanes = 0;  ///< largest number of lanes side by side; 0: as many as engine and processor allow
};

/// Runs every scenario to its end: CPG, controller and trace of each by itself at its ticks, the steps of several at once. The
/// scenarios may differ in everything; those with the same engine, integrator, step, kind of actuator and structure of the
/// robot share lane groups (can_share). A rollout has the same bits as when run alone: the result does not depend on threads,
/// lanes or the other rollouts, whether these have ended, diverged or are limited. end(i, recording) is called once for each
/// rollout, from several threads at once, in any order. A rollout that diverges or whose plugin throws is recorded up to that
/// step (Recording::outcome). Throws InputError if a scenario's step is refused or its plugin cannot be made: the first such
/// error, after all others have ended.
void run_batch(std::span<const Scenario> rollouts, const BatchSettings& settings,
               const std::function<void(std::size_t, Recording&&)>& end);

/// A rollout and the number that its maker gave it.
struct Rollout {
  std::size_t number = 0;
  Scenario scenario;
};

/// Result of a rollout: its `recording`, also if it diverged or its plugin threw (Recording::outcome), or the problems for
/// which it could not begin.
struct RolloutEnd {
  Rollout rollout;
  Recording recording = {};
  std::vector<Problem> refused = {};  ///< empty if it ran
};

/// Source of a batch's rollouts and receiver of their results.
struct BatchStream {
  /// The next rollout, or nothing when all were given. One call at a time.
  std::function<std::optional<Rollout>()> next;
  /// Called with the rollouts that run side by side from now on. One call at a time; may be empty.
  std::function<void(std::span<const Rollout>)> begin = {};
  /// Called for each rollout once every simulated second with its recording so far (Simulation::watch). Returns the reason to
  /// end it there, which becomes its outcome, or "". Called from several threads at once; may be empty.
  std::function<std::string(const Rollout&, const Recording& so_far)> watch = {};
  /// Called with the results of rollouts that ran side by side. From several threads at once, in any order.
  std::function<void(std::vector<RolloutEnd>&&)> end;
};

/// run_batch for any number of rollouts: a free thread takes the next ones that can share lanes among the first `look_ahead`
/// waiting ones; only these and the running ones exist at a time. Once `stop` is set no pack begins, and running rollouts end
/// at their next step without a call of `end`. Returns false if it was stopped. An exception of `next`, `begin` or `end` stops
/// the batch and is rethrown when all threads have ended.
bool run_pulled(const BatchStream& stream, const BatchSettings& settings, Records records, std::atomic<bool>& stop,
                std::size_t look_ahead = 64);

/// run_pulled for rollouts that all exist: calls `end(i, result of rollout i)` from several threads at once, in any order.
bool run_all(std::span<const Scenario> rollouts, const BatchSettings& settings, Records records, std::atomic<bool>& stop,
             const std::function<void(std::size_t, RolloutEnd&&)>& end);

/// run_batch for any number of rollouts, of which few exist at a time: `next()` gives the scenarios one by one, nothing at the
/// end; `digest(scenario, recording)` computes the result to keep, in several threads at once, and does not throw;
/// `sink(result)` receives the results in the order of next(), one at a time, for any number of threads and lanes. Throws what
/// run_batch or next() throws, after the sink has received all results before the first refused rollout.
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
      refused = std::current_exception();  // rethrown when the sink has received the results before it
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

/// Scenarios of a file with common overrides and overrides of each rollout, as of --set. Errors of all rollouts at once.
std::vector<Scenario> rollouts(const std::string& file, const std::vector<std::string>& sets,
                               std::span<const std::vector<std::string>> own, Catalog& catalog);

}  // namespace gaitlab
