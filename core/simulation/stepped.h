// Lane group that a caller steps from control tick to control tick.
#pragma once
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "core/simulation/action.h"
#include "core/simulation/simulation.h"

namespace gaitlab {

/// Scenarios side by side as in Simulation, without a recording, judgement or estimate of the torque error. Each lane has a
/// clock, so that one lane can restart while the others continue. Between calls every lane is at a control tick whose measured
/// values are taken. The set points of a run give the bits of this run.
///
/// A lane ends at the first control tick at or after `duration`, when it diverges, or when a plugin throws. It then stays where
/// it started until restart(). tick() allocates nothing.
class SteppedLanes {
 public:
  /// Throws the errors of Simulation's constructor, and InputError if ContactModel::complete_state is false for the contact
  /// law.
  explicit SteppedLanes(std::span<const Scenario> lanes);

  /// Begins the control tick with these actions, one per lane, and simulates to the next tick.
  void tick(std::span<const Action> actions);
  [[nodiscard]] bool ended(std::size_t lane) const;
  /// Outcome of a lane that has ended.
  [[nodiscard]] const Outcome& outcome(std::size_t lane) const;
  [[nodiscard]] double time(std::size_t lane) const;  ///< s, since the start of the lane

  [[nodiscard]] Measured measured(std::size_t lane) const;
  /// Set points of the last tick before faults of its `at`, by joint, rad.
  [[nodiscard]] const std::vector<double>& asked(std::size_t lane) const;
  void read(std::size_t lane, RobotState& out) const;   ///< true state
  void loads(std::size_t lane, Out by_body) const;      ///< normal forces of the ground, N
  [[nodiscard]] double energy(std::size_t lane) const;  ///< J that its motors have drawn

  /// Ends a lane with Ended::stopped.
  void stop(std::size_t lane, std::string reason);
  void restart(std::size_t lane);
  /// Restarts from another state. Everything else is as at the start of the scenario.
  void restart(std::size_t lane, const RobotState& start);

  /// Numbers whose copy is a snapshot of a lane. They fit every lane with an equal scenario.
  [[nodiscard]] std::size_t size(std::size_t lane) const;
  void save(std::size_t lane, Out to) const;
  /// True if load() accepts these numbers: their count, the clock and the segment of `at` are possible.
  [[nodiscard]] bool fits(std::size_t lane, In from) const;
  void load(std::size_t lane, In from);

 private:
  template <class Part>
  void each(std::size_t lane, Part part) const;
  void arrive();

  Simulation simulation_;
  std::int64_t steps_per_tick_;
  std::vector<std::vector<double>> start_;  ///< by lane, as from save()
};

}  // namespace gaitlab
