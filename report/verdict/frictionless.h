// The word of a run without the friction that is only chosen (core/scenario/chosen_friction.h).
#pragma once
#include <atomic>
#include <functional>
#include <optional>
#include <string>

#include "report/verdict/verdict.h"

namespace gaitlab::report {

/// Runs and judges a scenario, and returns its word: `failed` if it ends early, nothing if `stop` was set. Deterministic.
/// `progress` is called as by Simulation::run. Throws InputError and PluginError.
std::optional<Word> word_of(const Scenario& scenario, const std::function<void(double)>& progress,
                            const std::atomic<bool>& stop);

/// Fills in Verdict::without_friction from the verdict.json of an earlier run, so that a report on its folder prints the same
/// sentence. Returns false and changes nothing if the file is damaged or belongs to another verdict: its word, window or
/// deciding check differ.
bool take_word_without_friction(Verdict& verdict, const std::string& json);

}  // namespace gaitlab::report
