// The CPG of a scenario without its robot, for longer than a run.
#pragma once
#include <memory>
#include <utility>
#include <vector>

#include "core/recording/limit_cycle.h"
#include "core/recording/recording.h"
#include "core/scenario/scenario.h"

namespace gaitlab::report {

/// Set points of the driven joints at the control ticks of a run and after it.
struct LookAhead {
  /// Until the end of the run, rad, row-major; the later ones are not kept.
  std::vector<double> in_run;
  /// Extremes of each driven joint after the run, for three periods, or for as long as the run if no period is known; rad, and
  /// rad/s for a hinge without range, whose speed counts.
  std::vector<std::pair<double, double>> after_run;
  MotionCycle cycle;  ///< of the last part; not searched if a period is known
  double until = 0;   ///< s, end of the CPG alone
};

/// Simulates the CPG alone, once per CPG and length of the run: the last ones are kept, because many runs of a table, and the
/// judgements of one run, have the same CPG. `period`, s, belongs to the recorded set points; 0 if they have none. Then
/// three periods of the length `stated` are simulated, and a period is searched, for up to 120 s or five times the run.
/// Null if feedback changed a recorded set point, after a change of the run (section `at`), for a CPG of another language,
/// which takes long and may wait for a user, for a CPG that fails after the end of the run, for a run of more than 200 000
/// ticks, and if it was stopped (cpg_alone.h).
std::shared_ptr<const LookAhead> look_ahead(const Scenario& scenario, const Recording& record, double period, double stated);

/// True for each driven joint whose hinge has no range.
std::vector<bool> turning_freely(const Robot& robot);

/// Extremes of the set points (hinge with a range), or of their rates in steps of `spacing` s (hinge without range), of a joint
/// from one row to another of a row-major table; 0 also counts as a rate.
std::pair<double, double> extremes(const std::vector<double>& rows, std::size_t columns, std::size_t column, std::size_t first,
                                   std::size_t last, bool rates, double spacing);

}  // namespace gaitlab::report
