// The pattern generator of a scenario without its robot: set points and frequencies.
#pragma once
#include <atomic>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "core/plugin/sensor.h"
#include "core/scenario/scenario.h"
#include "core/simulation/cpg_integrator.h"

namespace gaitlab::report {

/// Times of the set points that the last CPG of a run states; all 0 without a CPG.
struct StatedTimes {
  double period = 0;     ///< s; if the CPG states none, 1 / least frequency (Hz) of a driven joint in its settings, or 0
  double full_size = 0;  ///< s, SetPointTimes::full_size
  /// s, full_size of a CPG without states, whose ramp has an end; 0 for other CPGs, whose states approach their full size for
  /// ever, mostly within the first period.
  double ramp = 0;
  bool by_cpg = false;  ///< true if the CPG states its period or its full size, so that its set points cannot change later
};
StatedTimes stated_times(const Scenario& scenario);

/// Frequencies above 0 of the driven joints among the settings of a CPG, Hz.
std::vector<double> frequencies(const Scenario& scenario, const PluginSelection& cpg);

/// Measured values that a CPG without a robot receives at every tick, the same for every joint and module. Values of steering
/// sensors are those of the run.
struct Feedback {
  double angle = 0;  ///< rad, added to the initial angle
  double speed = 0, torque = 0, touching = 0;
  double load = 0;  ///< N, of each joint
};

/// During its lifetime, `stop` ends CpgAlone::rows() in this thread, because a CPG of a user may be slow.
class StopsCpgAlone {
 public:
  explicit StopsCpgAlone(const std::atomic<bool>& stop);
  ~StopsCpgAlone();
  StopsCpgAlone(const StopsCpgAlone&) = delete;
  StopsCpgAlone& operator=(const StopsCpgAlone&) = delete;
  static bool asked();  ///< true if there is a `stop` and it is set
};

/// The first CPG of a scenario, called at the control ticks as in a run.
class CpgAlone {
 public:
  /// Throws PluginError.
  explicit CpgAlone(const Scenario& scenario, const Feedback& feedback = {});

  /// Set points of the driven joints, rad, row-major, from the first tick to at least `ticks`; fewer if it was stopped. Only
  /// new ticks are computed. Throws PluginError.
  const std::vector<double>& rows(std::int64_t ticks);
  /// The same, moved out of this object.
  std::vector<double> take() { return std::move(rows_); }

  /// The object that leave() stored last, if its scenario is equal; otherwise a new one. Warnings before a run and its
  /// judgement need the same ticks. Throws PluginError.
  static CpgAlone found(const Scenario& scenario);
  static void leave(const Scenario& scenario, CpgAlone alone);

 private:
  [[nodiscard]] Measured measured(double t) const;

  std::unique_ptr<Cpg> cpg_;
  std::vector<std::pair<std::unique_ptr<Sensor>, std::size_t>> steering_ = {};  ///< and their first channels
  double period_, step_;                                                        ///< s, of the control and of the CPG
  std::vector<bool> driven_ = {};
  std::vector<double> angle_ = {}, speed_, torque_, touching_, channels_, load_;
  std::vector<double> state_, setpoint_;
  CpgIntegrator integrator_;
  std::int64_t ticks_ = 0;
  std::vector<double> rows_ = {};
};

/// All numbers that the CPG alone depends on, except for the robot.
std::string key_of_cpg(const Scenario& scenario);

/// Extremes of the set points of a joint.
struct SetPointRange {
  std::size_t joint = 0;
  double least = 0, most = 0;  ///< rad
  double speed = 0;            ///< rad/s, largest difference of two successive set points, per control period
};

/// Extremes for every driven joint before the first change of the run, or in its first 2000 control periods, which take 0.1 s
/// of a large robot. Empty without a CPG, or if feedback changes a set point in the first 400 periods. Throws PluginError.
std::vector<SetPointRange> set_point_ranges(const Scenario& scenario);

}  // namespace gaitlab::report
