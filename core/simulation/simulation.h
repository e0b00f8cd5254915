// Simulation loop and owner of the plant, the plugins and ALL state in one array.
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

class FaultyActuator;
class PluginError;
class SteppedLanes;
struct Sample;
struct Rotors;

/// First difference that keeps two scenarios from being lanes of one simulation, or nullptr. Lanes share engine, integrator,
/// step, control period, actuator plugin, base, contact law and the structure of the robot: links, motors of joints, and the
/// link of each contact element.
const char* keeps_apart(const Scenario& a, const Scenario& b);
inline bool can_share(const Scenario& a, const Scenario& b) { return keeps_apart(a, b) == nullptr; }

/// True if the torque error of a run is estimated from whole rollouts beside it. Such a run needs a separate lane group.
bool estimated_by_rollouts(const Scenario& s);

/// Simulates one or more scenarios side by side, one per lane, each to its own end. Lanes may differ in everything that
/// can_share does not require to be equal. The results of each lane have the same bits as if the lane ran alone.
///
/// The torque error of a single run with an accuracy is estimated in additional lanes, which the caller does not see. If
/// several runs with an accuracy share a simulation, they have no such estimate.
///
/// The constructor throws std::invalid_argument if the lanes cannot share a simulation or the engine does not offer that number
/// of lanes. It throws InputError if h lambda > 1 for the standing robot. The message contains the largest allowed step and the
/// joint or contact that limits it.
///
/// step() allocates only at control ticks if loads are recorded, and for robots with hundreds of joints when a step is divided
/// further than any step before. If a lane diverges or its plugin throws, only this lane ends, with its outcome(). If there is
/// only one lane, step() throws SimulationError instead.
class Simulation {
 public:
  explicit Simulation(std::span<const Scenario> lanes, Records records = {});
  ~Simulation();
  Simulation(const Simulation&) = delete;
  Simulation& operator=(const Simulation&) = delete;

  void step();
  [[nodiscard]] bool done() const;  ///< true if every lane has ended
  [[nodiscard]] const Outcome& outcome(std::size_t lane) const;
  /// Sets a function that is called for each running lane once every simulated second. Only rows, ticks, joint statistics and
  /// time of the recording are then filled. The function returns "" to continue, or the reason for ending the lane. The calls
  /// for a lane do not depend on other lanes.
  void watch(std::function<std::string(std::size_t lane, const Recording& so_far)> watch) { watch_ = std::move(watch); }
  static constexpr double kWatchPeriod = 1;  ///< s, time between two calls of this function for a lane
  /// Steps to the end and calls `progress(share of the steps)` about 200 times. Returns false if `stop` was set before the end.
  bool run(const std::function<void(double)>& progress = {}, const std::atomic<bool>* stop = nullptr);

  /// All numbers that change: step counter, plant, present set points and commands, states of plugins, sums of the ledger. A
  /// copy is a snapshot without the recording. If the copy is written back, the run and its recording continue from there.
  /// Throws InputError if ContactModel::complete_state is false for the contact law.
  Out state();
  [[nodiscard]] std::int64_t step_number() const { return static_cast<std::int64_t>(state_[0]); }
  [[nodiscard]] RowsNeeded rows_needed(std::size_t lane) const;
  [[nodiscard]] double time() const { return static_cast<double>(step_number()) * h_ + within_; }
  /// Moves out the recording of lane `lane`. To be called once, at the end.
  Recording take_recording(std::size_t lane);
  [[nodiscard]] const Stability& standing() const { return standing_; }
  /// Solutions of the equations of motion so far; 0 if the engine does not count them.
  [[nodiscard]] double solves(std::size_t lane) const;

 private:
  friend SteppedLanes;
  struct Lane;
  /// Only a run is recorded and has an estimate. A companion is stepped beside a run, and `stepped` by SteppedLanes.
  enum class Role { run, companion, stepped };
  Simulation(std::span<const Scenario> lanes, Records records, Role role);

  static std::vector<Scenario> side_by_side(std::span<const Scenario> lanes, Role role);
  [[nodiscard]] bool recorded(const Lane& lane) const;
  /// Steps, and time, since the start of the lane.
  [[nodiscard]] std::int64_t step_of(const Lane& lane) const;
  [[nodiscard]] double time(const Lane& lane) const { return static_cast<double>(step_of(lane)) * h_ + within_; }
  [[nodiscard]] bool control_tick(const Lane& lane) const;
  [[nodiscard]] bool trace_tick(const Lane& lane) const;
  [[nodiscard]] bool any(bool (Simulation::*tick)(const Lane&) const) const;
  void record();
  void record(Lane& lane);
  void record_within_step();
  void sense();
  void sense(Lane& lane);
  void command();
  void command(Lane& lane);
  void prepare_faults();
  void apply_faults();
  void advance(double h, const std::function<bool(const Lane&)>& measured);
  void check();
  void check(Lane& lane);
  [[nodiscard]] bool fine(const Lane& lane) const;

  [[nodiscard]] PlantSettings plant_settings() const;
  [[nodiscard]] std::vector<std::size_t> rated_gears(const Lane& lane) const;
  [[nodiscard]] std::size_t state_size() const;
  void cut_state(Out numbers);
  void make_supplies();
  void set_start();
  void place_at_start(Lane& lane);
  void check_standing();
  void make_estimate();
  [[nodiscard]] TwinWindows twin_windows() const;
  [[nodiscard]] std::vector<std::unique_ptr<Simulation>> rollouts_apart() const;
  [[nodiscard]] std::vector<double> jumps() const;
  void begin_window();
  void add_to_means();
  void estimate();
  void estimate_in_window(bool asked, double t);
  void step_companion(int times);
  void ask_watch();
  void watch_stability();
  /// Commands that reach the motors, by joint * lanes + lane.
  [[nodiscard]] In commands() const { return bounded_ ? In(within_bound_) : In(command_); }
  void supply(Lane& lane);
  /// Speeds of the motors at the present state, by joint * lanes + lane.
  [[nodiscard]] In motor_speeds();
  void evaluate_motors(In speeds);
  void evaluate_torques(double within);
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
  void fill_loads(Lane& lane);
  void watch_docks();
  void watch_docks(const std::function<bool(const Lane&)>& wanted);
  [[nodiscard]] bool watches_docks(const Lane& lane) const;
  [[nodiscard]] int met_stop(const Lane& lane, std::size_t joint, In from) const;
  void watch_stops();
  void watch_stop(const Lane& lane, std::size_t joint, int side);
  [[nodiscard]] static SimulationError stopped(const PluginError& error, std::int64_t step, double t);
  [[nodiscard]] SimulationError diverged(const Lane& lane) const;

  std::vector<Scenario> scenarios_;  ///< one per lane
  std::size_t recorded_;             ///< number of lanes that are runs; all further lanes are companions of lane 0
  Records records_;
  Role role_;
  double h_;
  std::int64_t steps_ = 0;  ///< number of steps of the longest lane
  std::unique_ptr<Actuator> actuator_;
  /// Actuators with faults applied; nullptr if no fault of the scenarios changes motors or hinges.
  FaultyActuator *faulty_ = nullptr, *own_faulty_ = nullptr;
  std::vector<double> hold_;       ///< angles of stuck hinges of plant_, rad; NaN for others; empty like faulty_
  std::vector<double> stuck_for_;  ///< time that these hinges have been stuck, s, as in Plant::change_joints
  std::unique_ptr<Plant> plant_;
  std::vector<std::unique_ptr<Lane>> lanes_;
  std::vector<std::size_t> plays_;  ///< joints with play, of every lane
  StateLayout layout_;
  std::unique_ptr<Actuator> own_actuator_;  ///< actuator of the recorded lanes alone; nullptr if all lanes are recorded
  std::vector<double> numbers_;             ///< all changing numbers, including apart_; empty in a separate companion
  Out state_;                               ///< view of numbers_; in a separate companion, of a part of the run's numbers_
  Out own_;                                 ///< state_ without the numbers of apart_ and step_error_
  std::vector<std::unique_ptr<Simulation>> apart_;        ///< companions that are separate simulations, not lanes of this one
  TwinWindows how_;                                       ///< times at which the twin runs beside this simulation
  std::unique_ptr<StepError> step_error_;                 ///< nullptr without an estimate
  Out plant_state_, plant_history_, setpoint_, command_;  ///< parts of state_; the last two by joint * lanes + lane
  /// Parts of state_, empty without a supply or duties: bounds of the commands, and the commands within these bounds, by
  /// joint * lanes + lane, and voltage and current by bus * lanes + lane.
  Out bound_, within_bound_, bus_;
  std::vector<double> voltage_, current_, saturation_, power_in_, copper_, gear_, torque_, slope_, friction_, dry_, available_,
      largest_;                               ///< scratch by joint * lanes + lane; largest_ has the recorded lanes only
  std::vector<double> motor_speed_;           ///< result of motor_speeds(); empty without play
  std::size_t buses_ = 1;                     ///< largest number of buses of a lane
  bool bounded_ = false;                      ///< true if a lane has a supply, or a controller that commands duties
  bool rubs_ = false;                         ///< true if a joint has friction, or a gear whose torque jumps at rest
  FirstLanes first_;                          ///< entries of the recorded lanes
  std::vector<double> saved_;                 ///< scratch: copy of state_ while a row or loads within a step are recorded
  std::vector<double> end_, history_at_end_;  ///< scratch: plant at the end of a step while the loads within it are measured
  std::vector<double> measured_;              ///< scratch: 1 for a lane whose statistics include a step, else 0
  std::vector<Lane*> ended_;                  ///< scratch: lanes that end at the present row
  double within_ = 0;                         ///< s: time of the present row after the start of the step
  Meter meter_;
  Stability standing_;
  std::function<std::string(std::size_t, const Recording&)> watch_;
  double asked_ = 0;  ///< s: time of the last call of watch_
};

}  // namespace gaitlab
