// The functions that compute the checks of a verdict, one function per check.
#pragma once
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "core/scenario/change_section.h"
#include "report/analysis/envelope.h"
#include "report/analysis/fall.h"
#include "report/analysis/motors.h"
#include "report/verdict/error_bar.h"
#include "report/verdict/evidence.h"
#include "report/verdict/trust.h"
#include "report/verdict/verdict.h"

namespace gaitlab::report {

/// Run data from which every check is computed.
struct CheckedRun {
  const Scenario& scenario;
  const Recording& record;
  const Summary& summary;
  const Overlaps& overlaps;
  Motors motors = report::motors(scenario, 0);
  bool has_dc_motors = report::dc_motors(scenario);
  std::string motor_source = report::motor_source(scenario);
  std::string motor_defaults = report::silent_defaults(scenario);
  std::optional<Fall> fall = summary.fall ? *summary.fall : report::fall(scenario, record);
  Evidence evidence = report::evidence(scenario, record, summary);
  std::vector<FaultSpan> faults = fault_spans(scenario);
  std::vector<double> torque_errors = report::torque_errors(record);  ///< RMS torque error of each joint, as a share of its
                                                                      ///< largest torque

  [[nodiscard]] const std::string& joint(std::size_t j) const { return scenario.robot->joints[j].name; }
  [[nodiscard]] const Limits& limits() const { return scenario.limits; }
  /// True if the joint has a fault in the span of a check, which does not judge it then.
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
};

/// Reason why a check of joints is not judged if every joint has a fault.
inline constexpr const char* kAllFaulty = "every joint has a fault";

/// Status `pass` up to `pass`, `warn` up to `warn`, and `fail` above and for NaN.
CheckStatus graded(double value, double pass, double warn);

/// Time interval from the preceding row of Recording::ticks to the row at `time`. A peak stored in the row at `time` was
/// reached in this interval.
std::pair<double, double> row_before(const Recording& record, double time);

/// Text for Check::source of a threshold in the section `limits`. It states if the threshold is the default (chosen) or a value
/// of the scenario.
std::string threshold(const char* key, double value, double preset);

// Each function judges one check. The check is passed in with id, title and unit, the status `not judged`, and neither number
// nor text. A function that cannot judge keeps this status and sets the text to the reason.
namespace checks {
void outcome(const CheckedRun& run, Check& made);
void height(const CheckedRun& run, Check& made);
void upright(const CheckedRun& run, Check& made);
void voltage(const CheckedRun& run, Check& made);
void current(const CheckedRun& run, Check& made);
void envelope(const CheckedRun& run, Check& made);
void speed(const CheckedRun& run, Check& made);
void stall(const CheckedRun& run, Check& made);
void heat(const CheckedRun& run, Check& made);
void gear_peak(const CheckedRun& run, Check& made);
void gear_continuous(const CheckedRun& run, Check& made);
void tracking(const CheckedRun& run, Check& made);
void stops(const CheckedRun& run, Check& made);
void collision(const CheckedRun& run, Check& made);
void in_ground(const CheckedRun& run, Check& made);
void progress(const CheckedRun& run, Check& made);
void setpoints(const CheckedRun& run, Check& made);
void start(const CheckedRun& run, Check& made);
void airborne(const CheckedRun& run, Check& made);
void field(const CheckedRun& run, Check& made);
void periodic(const CheckedRun& run, Check& made);
void evidence(const CheckedRun& run, Check& made);
void torque_error(const CheckedRun& run, Check& made);
void predictable(const CheckedRun& run, Check& made);
void ledger(const CheckedRun& run, Check& made);
void created(const CheckedRun& run, Check& made);
void supply(const CheckedRun& run, Check& made);
void step(const CheckedRun& run, Check& made);
void coarse(const CheckedRun& run, Check& made);
void law(const CheckedRun& run, Check& made);
}  // namespace checks

}  // namespace gaitlab::report
