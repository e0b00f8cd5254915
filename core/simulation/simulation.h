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
#include "core/simulation/records.h"
#include "core/simulation/simulation_error.h"
#include "core/simulation/step_error.h"

namespace gaitlab {

class PluginError;
struct Sample;
struct Rotors;

/// Whether two scenarios can be lanes of one simulation: they share engine, integrator, step, kind of actuator, base, and the
/// robot's structure: links, joints, and the link of each contact element.
bool can_share(const Scenario& a, const Scenario& b);

/// Whether the torque error of a run is estimated by whole rollouts beside it: such a run takes a pack of lanes alone.
bool estimated_by_rollouts(const Scenario& s);

/// Simulates one or more scenarios side by side, one per lane, each to its own end. Lanes may differ in everything except what
/// can_share requires, and a lane has the same bits as when run alone. Among several runs with an accuracy none has its torque
/// error estimated; a single one gets additional lanes for the estimate, which the caller does not see. Throws
/// std::invalid_argument if the lanes cannot share a simulation or the engine does not offer that number of lanes. The
/// constructor checks the step: InputError if h lambda > 1 for the standing robot, with the largest step allowed and the joint
/// or contact that sets it. step() does not allocate, except at control ticks if loads are recorded, and for robots with
/// hundreds of joints when a step is divided further than any before. If a lane diverges or its plugin throws, step() throws
/// SimulationError if the lane is alone; beside others the lane ends there, with its outcome().
class Simulation {
 public:
  explicit Simulation(std::span<const Scenario> lanes, Records records = {});
  ~Simulation();
  Simulation(const Simulation&) = delete;
  Simulation& operator=(const Simulation&) = delete;

  void step();
  [[nodiscard]] bool done() const;  ///< every lane has ended
  /// Outcome of a lane.
  [[nodiscard]] const Outcome& outcome(std::size_t lane) const;
  /// Sets a function that is called for each running lane once every simulated second, with its recording so far: rows, ticks,
  /// statistics of joints and time alone. It returns the reason to end the lane there, or "" to continue. The calls for a lane
  /// do not depend on the other lanes.
  void watch(std::function<std::string(std::size_t lane, const Recording& so_far)> watch) { watch_ = std::move(watch); }
  /// Steps to the end; `progress(share)` about 200 times; stops early (returns false) once `stop` is set.
  bool run(const std::function<void(double)>& progress = {}, const std::atomic<bool>* stop = nullptr);

  /// Everything that changes: step counter, plant, held set points and commands, plugins' states, the ledger's sums. A copy is
  /// a snapshot without the recording: a run that is put back continues to record. Throws InputError if the plant keeps more
  /// than that (Plant::state_is_complete).
  Out state();
  [[nodiscard]] std::int64_t step_number() const { return static_cast<std::int64_t>(state_[0]); }
  [[nodiscard]] RowsNeeded rows_needed(std::size_t lane) const;
  [[nodiscard]] double time() const { return static_cast<double>(step_number()) * h_ + within_; }
  /// Recording of lane `lane` so far, moved out: call it once, at the end.
  Recording take_recording(std::size_t lane);
  [[nodiscard]] const Stability& standing() const { return standing_; }

 private:
  struct Lane;
  enum class Role { run, companion };  ///< companion: records nothing, is not itself estimated, throws nothing in a step
  Simulation(std::span<const Scenario> lanes, Records records, Role role);

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
  void ask_watch();
  void watch_stability();
  void evaluate_motors(In speeds);
  In evaluate_available(const StepEffort::Part& part);
  void observe();
  [[nodiscard]] Rotors rotors(const Lane& lane) const;
  void read_state(Lane& lane, bool places);
  Sample& take_sample(Lane& lane, bool places);
  template <class Work>
  void guard(Lane& lane, Work work);
  void fail(Lane& lane, const SimulationError& error);
  void end(Lane& lane);
  void close(Lane& lane);
  void record_tick(Lane& lane);
  void take_statistics(Lane& lane);
  void record_loads(const std::function<bool(const Lane&)>& wanted);
  void record_loads(Lane& lane);
  [[nodiscard]] SimulationError stopped(const PluginError& error) const;
  [[nodiscard]] SimulationError diverged(const Lane& lane) const;

  std::vector<Scenario> scenarios_;  ///< one per lane
  std::size_t recorded_;             ///< the first of them are runs; the others are companions of the first
  Records records_;
  Role role_;
  double h_;
  std::int64_t steps_ = 0;  ///< number of steps of the longest lane
  std::unique_ptr<Actuator> actuator_;
  std::unique_ptr<Plant> plant_;
  std::vector<std::unique_ptr<Lane>> lanes_;
  StateLayout layout_;
  std::unique_ptr<Actuator> own_actuator_;  ///< actuator of the recorded lanes alone; nullptr: actuator_
  std::vector<double> numbers_;             ///< all changing numbers, those of apart_ included; empty in a separate companion
  Out state_;                               ///< the same; in a separate companion a part of the run's
  Out own_;                                 ///< state_ without the numbers of apart_ and step_error_
  std::vector<std::unique_ptr<Simulation>> apart_;        ///< companions that are separate simulations, not lanes of this one
  TwinWindows how_;                                       ///< times at which the twin runs beside this
  std::unique_ptr<StepError> step_error_;                 ///< nullptr: no estimate
  Out plant_state_, plant_history_, setpoint_, command_;  ///< parts of state_; joint * lanes + lane
  std::vector<double> voltage_, current_, saturation_, power_in_, copper_, gear_, torque_, slope_, available_,
      largest_;                   ///< scratch, elementwise; largest_: recorded lanes only
  FirstLanes first_;              ///< entries of the recorded lanes
  std::vector<double> saved_;     ///< scratch: copy of state_ during a row within a step
  std::vector<double> measured_;  ///< scratch: 1 for a lane in whose statistics a step counts, else 0
  std::vector<Lane*> ended_;      ///< scratch: lanes that end at the present row
  double within_ = 0;             ///< s: time of the present row after the start of the step
  Meter meter_;
  Stability standing_;
  std::function<std::string(std::size_t, const Recording&)> watch_;
  double asked_ = 0;  ///< s: time of the last call of watch_
};

}  // namespace gaitlab
