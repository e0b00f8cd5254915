// Results of a run as a text that shows every bit.
#pragma once
#include <fmt/format.h>

#include <array>
#include <bit>
#include <string>

#include "core/recording/trace.h"
#include "core/simulation/simulation.h"

namespace gaitlab::test {

/// Text that shows every bit of the results that must not depend on the trace rows: steps, ledger, statistics, errors, event.
inline std::string bits(const Recording& r) {
  std::string text = fmt::format("{} steps, {:a} s, {:a} solves, {:a} off, {:a} coarse, ledger", r.steps, r.simulated,
                                 r.tally.solves, r.tally.off, r.tally.coarse);
  for (const double x : {r.ledger.electrical, r.ledger.copper, r.ledger.gear, r.ledger.stored, r.ledger.contact,
                         r.ledger.friction, r.ledger.stops, r.ledger.hinges, r.ledger.dry}) {
    text += fmt::format(" {:a}", x);
  }
  for (const JointStatistics& joint : r.joints) {
    text += "\njoint";
    for (const double x : std::bit_cast<std::array<double, kJointStatistics.size()>>(joint)) text += fmt::format(" {:a}", x);
  }
  text += "\nerrors";
  for (const double x : r.tally.torque_error) text += fmt::format(" {:a}", x);
  text += fmt::format("\nevent {:a} {}", r.tally.event.time, r.tally.event.joint);
  return text;
}

/// Text that shows every bit of all results of a rollout.
inline std::string bits(const Recording& record, const std::string& outcome) {
  return fmt::format("{}: {} rows {} {} {}\n{}", outcome, record.trace.rows(), hash(record.trace), hash(record.rest),
                     hash(record.ticks), bits(record));
}

/// Runs a scenario alone, and returns the text that shows every bit of its results.
inline std::string alone(const Scenario& scenario) {
  Simulation simulation({&scenario, 1});
  std::string outcome = "done";
  try {
    simulation.run();
  } catch (const SimulationError& error) {
    outcome = error.what();
  }
  return bits(simulation.take_recording(0), outcome);
}

}  // namespace gaitlab::test
