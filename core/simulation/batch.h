// Simulation of many rollouts in lane groups, which run in several threads.
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
  std::size_t lanes = 0;  ///< largest number of lanes per group; 0 means the largest number that engine and processor allow
};

/// Number of lanes for `wanted` rollouts: the smallest of the engine's widths that is enough for them, else the largest up to
/// `most` (0: no bound).
std::size_t lane_width(const Engine& engine, std::size_t wanted, std::size_t most);

/// Runs every scenario to its end. The scenarios may differ in everything. Scenarios with the same engine, integrator, step,
/// actuator plugin and structure of the robot share lane groups (can_share). The result of a rollout does not depend on
/// threads, lanes or other rollouts: it has the same bits as if the rollout ran alone. end(i, recording) is called once for
/// each rollout i, from several threads at once and in any order. If a rollout diverges or its plugin throws, the recording
/// ends at that step (Recording::outcome). Throws InputError if a step is refused or a plugin cannot be made. The error is that
/// of the first such scenario, and is thrown after all rollouts have ended.
void run_batch(std::span<const Scenario> rollouts, const BatchSettings& settings,
               const std::function<void(std::size_t, Recording&&)>& end);

/// A scenario to run and its number, which the caller assigns.
struct Rollout {
  std::size_t number = 0;
  Scenario scenario;
};

/// Result of a rollout. If the rollout began, `recording` is filled, even if the rollout diverged or its plugin threw
/// (Recording::outcome). Otherwise `refused` contains the problems.
struct RolloutEnd {
  Rollout rollout;
  Recording recording = {};
  std::vector<Problem> refused = {};  ///< empty if the rollout began
};

/// Functions that supply the rollouts of a batch and receive their results.
struct BatchStream {
  /// Returns the next rollout, or nothing after the last one. Called by one thread at a time.
  std::function<std::optional<Rollout>()> next;
  /// Called with the rollouts of a lane group before they run. Called by one thread at a time. The function may be empty.
  std::function<void(std::span<const Rollout>)> begin = {};
  /// Called for each rollout once every simulated second with its recording so far (Simulation::watch). Returns "" to continue,
  /// or the reason for ending the rollout, which becomes the outcome. Called from several threads at once. The function may be
  /// empty.
  std::function<std::string(const Rollout&, const Recording& so_far)> watch = {};
  /// Called with the results of the rollouts of a lane group, from several threads at once and in any order.
  std::function<void(std::vector<RolloutEnd>&&)> end;
};

/// run_batch for any number of rollouts, of which at most `look_ahead` wait (64 for large robots). A free thread takes the
/// first waiting rollout. It adds the waiting rollouts that can share lanes with the first one and whose CPG frequencies are
/// nearest. Robots in step touch the ground and reach their limits at the same times, so that the lanes divide their steps
/// together (docs/benchmarks.md). Once `stop` is set, no further lane group begins, and running rollouts end at their next step
/// without a call of `end`. Returns false if the batch was stopped. An exception of `next`, `begin` or `end` stops the batch
/// and is rethrown when all threads have ended.
bool run_pulled(const BatchStream& stream, const BatchSettings& settings, Records records, std::atomic<bool>& stop,
                std::size_t look_ahead = 512);

/// run_pulled for a complete list of rollouts. Calls `end(i, result of rollout i)` from several threads at once, in any order.
bool run_all(std::span<const Scenario> rollouts, const BatchSettings& settings, Records records, std::atomic<bool>& stop,
             const std::function<void(std::size_t, RolloutEnd&&)>& end);

/// run_batch for any number of rollouts; only few exist at a time. `next()` returns one scenario per call, and nothing at the
/// end. `digest(scenario, recording)` computes the result to keep; it is called by several threads at once and must not throw.
/// `sink(result)` receives the results one at a time in the order of next(), for any number of threads and lanes. Exceptions of
/// run_batch and next() are rethrown after the sink has received the results of all rollouts before the first refused one.
template <class Digest>
void run_stream(const std::function<std::optional<Scenario>()>& next, const BatchSettings& settings, Digest digest,
                const std::function<void(std::invoke_result_t<Digest, const Scenario&, Recording&&>&&)>& sink) {
  using Kept = std::invoke_result_t<Digest, const Scenario&, Recording&&>;
  constexpr std::size_t kGroups = 4;     // lane groups per thread, after which all threads wait for the slowest
  constexpr std::size_t kMostLanes = 8;  // largest number of lanes of any engine
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
      refused = std::current_exception();  // rethrown after the sink has received the earlier results
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

/// Makes one scenario per entry of `own` from a scenario file. `sets` are the overrides of all rollouts and own[i] the
/// overrides of rollout i, in the syntax of --set. Throws one InputError with the problems of all rollouts.
std::vector<Scenario> rollouts(const std::string& file, const std::vector<std::string>& sets,
                               std::span<const std::vector<std::string>> own, Catalog& catalog);

}  // namespace gaitlab
