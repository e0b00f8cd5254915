// Many rollouts of one robot: side by side in lanes, and packs of lanes side by side in threads.
#pragma once
#include <functional>
#include <span>
#include <string>
#include <vector>

#include "core/simulation/simulation.h"

namespace gaitlab {

struct BatchSettings {
  int threads = 1;
  std::size_t lanes = 0;  ///< at most so many side by side; 0: as many as engine and processor allow
};

/// Runs every scenario to its end: CPG, controller and trace of each by itself at its ticks, the steps of several at once.
/// They may differ in everything; those that share engine, integrator, step, kind of actuator and the structure of the robot
/// share packs (can_share). A rollout has the bits it has alone: the result does not depend on threads, lanes
/// or the other rollouts, whether these have ended, diverged or are limited.
/// end(i, recording): once for each rollout, from several threads at once, in any order. What diverged, or whose plugin threw,
/// is recorded until there (Recording::outcome).
/// Throws InputError where a scenario's step is refused or its plugin cannot be made: the first such, after all others ended.
void run_batch(std::span<const Scenario> rollouts, const BatchSettings& settings,
               const std::function<void(std::size_t, Recording&&)>& end);

/// The scenario of a file with overrides in common and each rollout's own, as of --set. Errors of all rollouts at once.
std::vector<Scenario> rollouts(const std::string& file, const std::vector<std::string>& sets,
                               std::span<const std::vector<std::string>> own, Catalog& catalog);

}  // namespace gaitlab
