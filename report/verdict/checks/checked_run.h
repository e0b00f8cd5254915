// Common parts of the files of checks: the judged run, the list of checks, and the functions that their judges share.
#pragma once
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "core/scenario/change_section.h"
#include "report/analysis/envelope.h"
#include "report/analysis/fall.h"
#include "report/analysis/motors.h"
#include "report/verdict/checks/list.h"
#include "report/verdict/error_bar.h"
#include "report/verdict/evidence.h"
#include "report/verdict/numbers/number_texts.h"
#include "report/verdict/trust.h"
#include "report/verdict/verdict.h"

namespace gaitlab::report {

/// Run data that every check uses.
struct CheckedRun {
  const Scenario& scenario;
  const Recording& record;
  const Summary& summary;
  const Overlaps& overlaps;
  Motors motors = report::motors(scenario, 0);
  bool has_dc_motors = report::dc_motors(scenario);
  std::string motor_source = report::motor_source(scenario);
  std::vector<Identification> identifications = report::identifications(scenario);  ///< by joint
  std::string motor_defaults = report::silent_defaults(scenario);
  std::optional<Fall> fall = summary.fall ? *summary.fall : report::fall(scenario, record);
  Evidence evidence = report::evidence(scenario, record, summary);
  std::vector<FaultSpan> faults = fault_spans(scenario);
  std::vector<double> torque_errors = report::torque_errors(record);  ///< RMS torque error of each joint, as a share of its
                                                                      ///< largest torque

  [[nodiscard]] const std::string& joint(std::size_t j) const { return scenario.robot->joints[j].name; }
  [[nodiscard]] const Limits& limits() const { return scenario.limits; }
  /// True if the joint has a fault in the span of a check. The check then does not judge the joint.
  [[nodiscard]] bool faulty(std::size_t joint, CheckSpan span) const;
  /// True for a joint with a motor and without a fault.
  [[nodiscard]] bool judges(std::size_t joint, CheckSpan span) const {
    return scenario.robot->joints[joint].driven() && !faulty(joint, span);
  }
  [[nodiscard]] bool driven() const { return !motors.of_joint.empty(); }
  /// Relative error of a joint's torque, which is also that of its current; 0 if not estimated.
  [[nodiscard]] double torque_error(std::size_t joint) const;
  /// Addition to the source of a threshold: the sources of the motor values.
  [[nodiscard]] std::string of_motors() const;
  /// Reason why checks that read this column of Recording::ticks cannot be judged; empty if they can.
  [[nodiscard]] std::string unknown(TickColumn column) const;
  /// Reason why collisions cannot be judged, for example bodies without a shape. Empty if they can.
  [[nodiscard]] std::string unknown_bodies() const;
};

// Texts of several checks.
inline constexpr const char* kAllFaulty = "every joint has a fault";
inline constexpr const char* kUndriven = "nothing drives the joints";
inline constexpr const char* kNoPoses = "the run has no poses";
inline constexpr const char* kMoreSupport = "take a gait with more support";
inline constexpr const char* kGentler =
    "a smaller amplitude or frequency, or a stronger motor; --demand computes how much is missing";
inline constexpr const char* kSmaller = "smaller amplitudes or offsets";
inline constexpr const char* kShorter = "a smaller physics.accuracy, or a smaller physics.step if one is given";

// A judge receives its check with id, title and unit, with the status `not judged`, and without numbers and text. A judge that
// cannot judge the run keeps this status and sets the text to the reason.

/// Sets the text to the reason why the check is not judged. Returns true if there is one.
bool left_open(Check& made, std::string reason);

/// Status `pass` up to `pass`, `warn` up to `warn`, and `fail` above and for NaN.
CheckStatus graded(double value, double pass, double warn);
/// Sets the status `pass` up to `limit`, and `warn` above and for NaN. Returns true if the check passes.
bool passes(Check& made, double limit);

/// Sets limit and source of a check to a threshold of the section `limits`.
void take_limit(Check& made, const char* key, double Limits::*member, const CheckedRun& run);
/// Text for Check::source of a threshold in the section `limits`. It states if the threshold is the default (chosen) or a value
/// of the scenario.
std::string threshold(const char* key, double value, double preset);

/// Sets the worst part of a check to a joint.
void name_joint(Check& made, const CheckedRun& run, std::size_t joint);

/// The check of a kind for a run (verdict.cpp).
Check judged_check(const CheckKind& kind, const CheckedRun& run);

/// Time interval from the preceding row of Recording::ticks to the row at `time`. A peak stored in the row at `time` was
/// reached in this interval.
std::pair<double, double> row_before(const Recording& record, double time);

}  // namespace gaitlab::report
