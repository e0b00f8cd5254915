// The checks of a verdict: each fills in what one limit came to.
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

/// What every check reads.
struct CheckedRun {
  const Scenario& scenario;
  const Recording& record;
  const Summary& summary;
  const Overlaps& overlaps;
  Motors motors = report::motors(scenario, 0);
  bool has_dc_motors = report::dc_motors(scenario);
  std::string motor_source = report::motor_source(scenario);
  std::optional<Fall> fall = report::fall(scenario, record);
  Evidence evidence = report::evidence(scenario, record, summary);
  std::vector<double> torque_errors = report::torque_errors(record);  ///< of each joint, share of its largest torque

  [[nodiscard]] const std::string& joint(std::size_t j) const { return scenario.robot->joints[j].name; }
  [[nodiscard]] const Limits& limits() const { return scenario.limits; }
  [[nodiscard]] bool driven() const { return !motors.of_joint.empty(); }
  /// Why what needs this column of ticks cannot be judged; empty: it can.
  [[nodiscard]] std::string unknown(TickColumn column) const;
};

/// Up to `pass` a pass, up to `warn` a warning, above it, and where it is not a number, a failure.
CheckStatus graded(double value, double pass, double warn);

/// The stretch between the row of Recording::ticks before `time` and `time`, in which a peak of that row was reached.
std::pair<double, double> row_before(const Recording& record, double time);

/// Who says a threshold of the section `limits`; all of their defaults are chosen.
std::string threshold(const char* key, double value, double preset);

// A check comes with its id, title and unit, not judged, without a number and without a word; what stays so was not judged, and
// the text says why.
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
