// Evidence that the word `feasible` requires: the run is long enough, the ground carries the robot, and the numbers are
// accurate.
#pragma once
#include <string>
#include <vector>

#include "core/laws/dc_motor.h"
#include "core/scenario/scenario.h"
#include "report/analysis/gait.h"
#include "report/analysis/summary.h"

namespace gaitlab::report {

/// Largest errors of a trusted run, in addition to most_torque_error(): energy residual / energy drawn, and share of the time
/// when even the shortest steps miss the accuracy.
inline constexpr double kTrustedResidual = 0.05, kTrustedCoarse = 0.1;
/// Largest error of a limit cycle for which one period is enough. With a larger error, kPeriodsNeeded periods of the set points
/// are required after the start of the gait (core/recording/limit_cycle.h); the judged window leaves out the first of them.
inline constexpr double kSettled = 0.01;
inline constexpr double kLeastTime = 2;  ///< s, least duration if the set points do not repeat
/// Least change of a set point in a gait, as a share of its range: a little more than a set point still rises after
/// SetPointTimes::full_size.
inline constexpr double kMoves = 0.025;
/// Largest torque error at which a failure beyond its error bar (Check::certain) still decides the verdict.
inline constexpr double kMostError = 0.5;

/// A missing piece of evidence.
struct Lack {
  std::string text = {};    ///< sentence about what is missing; empty if nothing is. It names the setting to change if `remedy`
                            ///< is empty
  std::string key = {};     ///< key of the setting at which messages are placed
  std::string remedy = {};  ///< advice; set only if no other message is printed at the same setting
  std::string set = {};     ///< setting that supplies the evidence, in the form of --set; empty if none is known
  [[nodiscard]] bool empty() const { return text.empty(); }
  [[nodiscard]] std::string sentence() const { return text + (remedy.empty() ? "" : "; " + remedy); }
};

struct Evidence {
  /// The run does not show the gait: it has less than a period of its limit cycle, three periods of its set points after
  /// the start of the gait, or 2 s; the set points grow, drift or do not change.
  Lack not_shown;
  Lack not_possible;          ///< a number of the scenario is impossible and not accepted (plausibility.h)
  Lack not_borne;             ///< the ground carries less than half of the weight
  Lack not_trusted;           ///< an error exceeds one of the constants above, or a motor creates energy
  bool inexact = false;       ///< true if not_trusted is only a torque error of at most kMostError
  bool falls_freely = false;  ///< true if nothing can carry the robot: no ground, no gravity, or no contact elements
  bool repeats = false;       ///< true if the set points repeat
  std::string rests_on;       ///< extent of the run: `3 periods of 4 s`, or `the 18 s of the run; the set points do not repeat`
  /// Limits that the scenario changes, and implausible numbers that it accepts: `limits: torque_error 1 in the scenario, 0.05
  /// by default`. Empty without them.
  std::string conditions;
  /// The missing pieces of evidence, the most important one first. An impossible number is returned alone, and so is a free
  /// fall, because neither accuracy nor time helps then.
  [[nodiscard]] std::vector<const Lack*> lacks() const {
    if (!not_possible.empty()) return {&not_possible};
    std::vector<const Lack*> all;
    for (const Lack* one : {&not_trusted, &not_shown, &not_borne}) {
      if (!one->empty() && (!falls_freely || one == &not_borne)) all.push_back(one);
    }
    return all;
  }
};

/// Sentence on a motor that creates energy; empty for other motors.
std::string makes_energy(const DcMotor& motor, const std::string& joint);

/// Collects the evidence. Throws PluginError.
Evidence evidence(const Scenario& scenario, const Recording& record, const Summary& summary);

}  // namespace gaitlab::report
