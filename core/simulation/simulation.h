// The loop: record, sense, command, advance, check. Owns the plant, the plugins and ALL state in one array.
#pragma once
#include <atomic>
#include <cstdint>
#include <functional>
#include <memory>
#include <span>
#include <vector>

#include "core/recording/recording.h"
#include "core/scenario/scenario.h"
#include "core/simulation/first_lanes.h"
#include "core/simulation/meter.h"
#include "core/simulation/plant.h"
#include "core/simulation/probes.h"
#include "core/simulation/simulation_error.h"
#include "core/simulation/step_error.h"

namespace gaitlab {

class PluginError;

/// What a run records: rows of numbers, which it keeps until its end.
struct RowsNeeded {
  double rows = 0, columns = 0;
  [[nodiscard]] double bytes() const { return 8 * rows * columns; }
};

/// Whether two scenarios can be lanes of one simulation: they share engine, integrator, step, kind of actuator, base, and the
/// robot's structure: links, joints, which link each contact element is on.
bool can_share(const Scenario& a, const Scenario& b);

/// Whether the torques of a run are estimated by whole rollouts beside it: it fills a pack of lanes by itself.
bool estimated_by_rollouts(const Scenario& s);

/// Whether Recording::loads is wanted: it takes the accelerations at every control tick.
enum class Loads { left_out, recorded };

/// Simulates one or more scenarios side by side, one per lane, each to its own end. All but what can_share asks may differ, and
/// a lane's bits are those it has alone, whatever the others hold; but of several runs with an accuracy none is estimated (one
/// alone takes lanes of its own for that, which the caller does not see). Throws std::invalid_argument where they do not share
/// it, or the engine has no such number of lanes. The constructor checks the step: InputError where h lambda > 1 for the
/// standing robot, naming the largest step allowed and the joint or contact that sets it. step() allocates nothing, but at
/// control ticks where loads are recorded. A lane that leaves
/// the numbers, or whose plugin throws, throws SimulationError if alone; beside others it ends there, with its outcome().
class Simulation {
 public:
  explicit Simulation(std::span<const Scenario> lanes, Loads loads = Loads::left_out);
  ~Simulation();
  Simulation(const Simulation&) = delete;
  Simulation& operator=(const Simulation&) = delete;

  void step();
  [[nodiscard]] bool done() const;  ///< every lane has ended
  /// How a lane ended.
  [[nodiscard]] const Outcome& outcome(std::size_t lane) const;
  /// Asked of each lane that runs, once every simulated second, with what it has recorded so far: rows, ticks, statistics
  /// of joints and time alone. Why the lane is to end there; "": it goes on. A lane is asked the same whatever the others are.
  void watch(std::function<std::string(std::size_t lane, const Recording& so_far)> watch) { watch_ = std::move(watch); }
  /// Steps to the end; `progress(share)` about 200 times; stops early (returns false) once `stop` is set.
  bool run(const std::function<void(double)>& progress = {}, const std::atomic<bool>* stop = nullptr);

  /// Everything that changes: step counter, plant, held set points and commands, plugins' states, the ledger's sums. A copy is
  /// a snapshot (what was recorded is not part of it: a run that is put back records on). Throws InputError where the plant
  /// keeps more than that (Plant::state_is_complete).
  Out state();
  [[nodiscard]] std::int64_t step_number() const { return static_cast<std::int64_t>(state_[0]); }
  [[nodiscard]] RowsNeeded rows_needed(std::size_t lane) const;
  [[nodiscard]] double time() const { return static_cast<double>(step_number()) * h_ + within_; }
  /// What lane `lane` has recorded so far, moved out: call it once, at the end.
  Recording take_recording(std::size_t lane);
  [[nodiscard]] const Stability& standing() const { return standing_; }

 private:
  struct Lane;
  enum class Role { run, companion };  ///< companion: records nothing, is not estimated itself, throws nothing in a step
  Simulation(std::span<const Scenario> lanes, Loads loads, Role role);

  static std::vector<Scenario> side_by_side(std::span<const Scenario> lanes, Role role);
  [[nodiscard]] bool recorded(const Lane& lane) const;
  [[nodiscard]] bool control_tick(const Lane& lane) const;
  [[nodiscard]] bool trace_tick(const Lane& lane) const;
  [[nodiscard]] bool any(bool (Simulation::*tick)(const Lane&) const) const;
  void record();
  void record(Lane& lane);
  void record_within_step();
  void sense();
  void command();
  void command(Lane& lane);
  void advance(double h, const std::function<bool(const Lane&)>& measured);
  void check();
  void check(Lane& lane);
  [[nodiscard]] bool fine(const Lane& lane) const;

  [[nodiscard]] PlantSettings plant_settings() const;
  [[nodiscard]] std::size_t state_size() const;
  void cut_state(Out numbers);
  void set_start();
  void place_at_start(Lane& lane);
  void check_standing();
  void make_estimate();
  [[nodiscard]] TwinWindows twin_windows() const;
  [[nodiscard]] std::vector<std::unique_ptr<Simulation>> rollouts_apart() const;
  void begin_window();
  void estimate();
  void estimate_in_window(bool asked, double t);
  void step_companion(int times);
  In torques_now();
  void set_recording(Lane& lane);
  void ask_watch();
  void watch_stability();
  void evaluate_motors(In speeds);
  void evaluate_available(In speeds, In torques);
  void observe();
  [[nodiscard]] double energy(const Lane& lane) const;
  [[nodiscard]] static double stop_torque(const Lane& lane, const RobotState& state, std::size_t joint);
  static void take_passive(const Lane& lane, Sample& sample);
  void read_state(Lane& lane, bool places);
  Sample& take_sample(Lane& lane, bool whole);
  template <class Work>
  void guard(Lane& lane, Work work);
  void fail(Lane& lane, const SimulationError& error);
  void end(Lane& lane);
  void close(Lane& lane);
  void record_tick(Lane& lane);
  void record_pose(Lane& lane);
  void record_loads(const std::function<bool(const Lane&)>& wanted);
  void record_loads(Lane& lane);
  [[nodiscard]] SimulationError stopped(const PluginError& error) const;
  [[nodiscard]] SimulationError diverged(const Lane& lane) const;

  std::vector<Scenario> scenarios_;  ///< of all lanes
  std::size_t recorded_;             ///< the first of them are runs; the others go beside the first, for its estimate
  Loads loads_;
  Role role_;
  double h_;
  std::int64_t steps_ = 0;  ///< of the longest lane
  std::unique_ptr<Actuator> actuator_;
  std::unique_ptr<Plant> plant_;
  std::vector<std::unique_ptr<Lane>> lanes_;
  StateLayout layout_;
  std::unique_ptr<Actuator> own_actuator_;                ///< of the lanes that are recorded; nullptr: of all
  std::vector<double> numbers_;                           ///< all that changes, apart_'s included; of those, empty
  Out state_;                                             ///< the same; of one apart, a part of the first's
  Out own_;                                               ///< without those of apart_ and step_error_
  std::vector<std::unique_ptr<Simulation>> apart_;        ///< rollouts beside this that are no lanes of it
  TwinWindows how_;                                       ///< the twin goes beside this
  std::unique_ptr<StepError> step_error_;                 ///< nullptr: nothing to estimate
  Out plant_state_, plant_history_, setpoint_, command_;  ///< parts of state_; joint * lanes + lane
  std::vector<double> voltage_, current_, saturation_, power_in_, copper_, gear_, torque_, slope_, available_,
      largest_;                   ///< scratch, elementwise; the last two of lanes that are recorded
  FirstLanes first_;              ///< of those
  std::vector<double> saved_;     ///< scratch: state_ while a row within a step is made
  std::vector<double> measured_;  ///< scratch: 1 for a lane whose figures a step counts for, else 0
  std::vector<Lane*> ended_;      ///< scratch: of those that end at that row
  double within_ = 0;             ///< s: how far into the step that row is
  Meter meter_;
  Stability standing_;
  std::function<std::string(std::size_t, const Recording&)> watch_;
  double asked_ = 0;  ///< s: when the watch was asked
};

/// Number of steps in `period`: the nearest integer, which the scenario's check has made exact to 1e-9.
std::int64_t whole(double period, double step);

}  // namespace gaitlab
