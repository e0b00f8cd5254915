// Environments of a learner: episodes of scenarios, stepped together from outside.
#pragma once
#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "core/scenario/scenario.h"
#include "core/simulation/stepped.h"
#include "kit/episode_columns.h"

namespace gaitlab {
namespace kit {

/// Part of an action; the parts of an action follow one another. `setpoint` and `residual` are in rad, `command` in the unit of
/// the controller, with a number per driven joint. `steering` has one per value of a steering sensor, in its unit (Action).
enum class ActionPart { setpoint, residual, steering, command };

}  // namespace kit

template <>
struct EnumNames<kit::ActionPart> {
  using enum kit::ActionPart;
  static constexpr EnumName<kit::ActionPart> kTable[] = {
      {setpoint, "setpoint"}, {residual, "residual"}, {steering, "steering"}, {command, "command"}};
};

namespace kit {

struct EpisodeSettings {
  std::vector<ActionPart> action{ActionPart::setpoint};
  std::int64_t every = 1;  ///< control ticks per action
  int threads = 1;
  std::size_t lanes = 0;  ///< as BatchSettings::lanes
  bool record = false;    ///< true if set points are kept for set_points()
};

/// Environments, one per scenario. They share engine, step, control period and structure of the robot (can_share). An
/// environment has the same bits alone and beside any others, for any number of threads and lanes. After its end it keeps its
/// last rows until restart(). An object belongs to one thread at a time. Throws InputError at `overrides[i]` for a scenario
/// that does not fit the first one, InputError for a robot without motors and for steering without its sensor, and the errors
/// of SteppedLanes.
class Episodes {
 public:
  Episodes(std::vector<Scenario> scenarios, EpisodeSettings settings);

  [[nodiscard]] std::size_t size() const { return scenarios_.size(); }
  [[nodiscard]] const Scenario& scenario(std::size_t i) const { return scenarios_[i]; }
  [[nodiscard]] const std::vector<std::size_t>& driven() const { return driven_; }  ///< joints with a motor
  [[nodiscard]] const std::vector<ActionPart>& parts() const { return settings_.action; }
  /// Joints and steered values, the columns of an action.
  [[nodiscard]] const std::vector<std::string>& action_columns() const { return action_columns_; }
  [[nodiscard]] const std::vector<EpisodeColumn>& observed() const { return observed_; }
  [[nodiscard]] const std::vector<EpisodeColumn>& true_columns() const { return true_columns_; }

  /// Steps all environments that have not ended by `every` control ticks, or to their end. `actions` has a row per environment.
  /// The caller has checked it with problem_of().
  void step(In actions);
  /// First fault of `actions`, or "": a number that is not finite, or an angle that no hinge with a range has.
  [[nodiscard]] std::string problem_of(In actions) const;
  /// Ends an environment that has not ended.
  void stop(std::size_t i, const std::string& reason);
  /// Puts environments back to their start. With `starts`, one per environment of `which`, that is the state at the start.
  void restart(std::span<const std::size_t> which, std::span<const Initial> starts = {});

  /// A row per environment.
  [[nodiscard]] In observations() const { return observations_; }
  [[nodiscard]] In truth() const { return truth_; }
  [[nodiscard]] bool running() const;  ///< true if an environment has not ended
  /// "" for an environment that has not ended, else `done`, `diverged`, `plugin` or `stopped`.
  [[nodiscard]] std::string ended(std::size_t i) const;
  /// Reason of the end, with its time; "" before the end and after `done`.
  [[nodiscard]] const std::string& message(std::size_t i) const { return outcomes_[i].message; }

  /// Set points of the environment since its start, a row of all joints per control tick, rad. Empty if they are not kept.
  [[nodiscard]] const std::vector<double>& set_points(std::size_t i) const { return kept_[i].set_points; }
  /// Names of the steered values, empty if the action has none, and a row of them per control tick as set_points().
  [[nodiscard]] const std::vector<std::string>& steering() const { return steering_; }
  [[nodiscard]] const std::vector<double>& steered(std::size_t i) const { return kept_[i].steering; }
  [[nodiscard]] const RobotState& state(std::size_t i) const { return states_[i]; }  ///< at its last row
  [[nodiscard]] const Initial& start(std::size_t i) const { return starts_[i]; }     ///< at its last start

  /// Everything that changes, as bytes. restore() gives the same numbers again in another object with the same scenarios and
  /// settings, also in another process of this build. Throws InputError for other bytes.
  [[nodiscard]] std::string snapshot() const;
  void restore(const std::string& bytes);

 private:
  struct Place {
    std::size_t group = 0, lane = 0;
  };
  struct Kept {
    std::vector<double> set_points, steering;
  };
  [[nodiscard]] SteppedLanes& group(std::size_t i) const { return *groups_[places_[i].group]; }
  void name_actions();
  void make_groups();
  void step_group(std::size_t group, In actions);
  void read(std::size_t i);
  [[nodiscard]] std::string head() const;

  std::vector<Scenario> scenarios_;
  EpisodeSettings settings_;
  std::vector<std::size_t> driven_;
  std::vector<std::string> steering_;  ///< names of the values of steering sensors
  std::vector<std::string> action_columns_;
  std::vector<EpisodeColumn> observed_, true_columns_;
  std::vector<std::unique_ptr<SteppedLanes>> groups_;
  std::vector<std::size_t> first_, lanes_;  ///< by group: first environment, and number of lanes (the last may be unused)
  std::vector<Place> places_;               ///< by environment
  std::vector<double> observations_, truth_;
  std::vector<Outcome> outcomes_;
  std::vector<char> ended_;
  std::vector<Kept> kept_;
  std::vector<Initial> starts_;
  std::vector<std::vector<std::size_t>> leg_bodies_;
  std::vector<RobotState> states_;
  std::vector<std::vector<double>> load_;  ///< scratch, by environment and body, N
  /// Scratch, by group: the parts of the actions by lane, part and joint (or steered value), and views of them by lane.
  std::vector<std::vector<double>> parts_;
  std::vector<std::vector<Action>> actions_;
};

}  // namespace kit
}  // namespace gaitlab
