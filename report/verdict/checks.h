// The checks of a verdict: each computes one check.
#pragma once
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "report/analysis/envelope.h"
#include "report/analysis/fall.h"
#include "report/analysis/motors.h"
#include "report/verdict/error_bar.h"
#include "report/verdict/evidence.h"
#include "report/verdict/trust.h"
#include "report/verdict/verdict.h"

namespace gaitlab::report {

/// Input of every check.
struct CheckedRun {
  const Scenario& scenario;
  const Recording& record;
  const Summary& summary;
  const Overlaps& overlaps;
  Motors motors = report::motors(scenario, 0);
  bool has_dc_motors = report::dc_motors(scenario);
  std::string motor_source = report::motor_source(scenario);
  std::optional<Fall> fall = summary.fall ? *summary.fall : report::fall(scenario, record);
  Evidence evidence = report::evidence(scenario, record, summary);
  std::vector<double> torque_errors = report::torque_errors(record);  ///< of each joint, share of its largest torque

  [[nodiscard]] const std::string& joint(std::size_t j) const { return scenario.robot->joints[j].name; }
  [[nodiscard]] const Limits& limits() const { return scenario.limits; }
  [[nodiscard]] bool driven() const { return !motors.of_joint.empty(); }
  /// Reason why checks on this column of ticks cannot be judged; empty: they can.
  [[nodiscard]] std::string unknown(TickColumn column) const;
};

/// Pass up to `pass`, warning up to `warn`, failure above and for NaN.
CheckStatus graded(double value, double pass, double warn);

/// The interval between the row of Recording::ticks before `time` and `time`, in which a peak of that row was reached.
std::pair<double, double> row_before(const Recording& record, double time);

/// Source of a threshold in the section `limits`; all defaults are chosen.
std::string threshold(const char* key, double value, double preset);

// Each function judges one check. Initially a check has its id, title and unit, is not judged and has no number and no text; a
// check that stays so was not judged, and its text gives the reason.
namespace checks {
void outcome(const CheckedRun& run, Check& made);
void height(const CheckedRun& run, Check& made);
void upright(const CheckedRun& run, Check& made);
void voltage(const CheckedRun& run, Check& made);
void current(const CheckedRun& run, Check& made);
void envelope(const CheckedRun& run, Check& made);
void speed(const CheckedRun& run, Check& made);
void heat(const CheckedRun& run, Check& made);
void gear_peak(const CheckedRun& run, Check& made);
void gear_continuous(const CheckedRun& run, Check& made);
void tracking(const CheckedRun& run, Check& made);
void stops(const CheckedRun& run, Check& made);
void collision(const CheckedRun& run, Check& made);
void battery(const CheckedRun& run, Check& made);
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
