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
  /// Set points until the end of the run, rad, row-major; later ones are not stored.
  std::vector<double> in_run;
  /// Extremes of each driven joint's set points, rad, in three periods after the run, or in the length of the run if no period
  /// is known. For a hinge without range, extremes of their rates, rad/s.
  std::vector<std::pair<double, double>> after_run;
  MotionCycle cycle;  ///< cycle at the end of the simulated time; not searched if a period is known
  double until = 0;   ///< s, end of the CPG alone
};

/// Simulates the CPG alone, once per CPG and length of the run. The last results are kept, because many runs of a table, and
/// repeated judgements of one run, have the same CPG. `period`, s, is that of the recorded set points. If it is 0, three
/// periods of the length `stated` are simulated after the run, and a period is searched in up to 120 s or five times the run.
/// Null if feedback changed a recorded set point, if none is recorded, after a change of the run (section `at`), for a run of
/// more than 200 000 ticks, if the CPG fails after the end of the run, or if the simulation was stopped (cpg_alone.h). Null
/// also for a CPG of another language, because it takes long and may wait for a user.
std::shared_ptr<const LookAhead> look_ahead(const Scenario& scenario, const Recording& record, double period, double stated);

/// True for each driven joint whose hinge has no range.
std::vector<bool> turning_freely(const Robot& robot);

/// Smallest and largest value of column `column` in rows [first, last) of a row-major table of set points. With `rates`: of the
/// differences between successive rows divided by `spacing`, s; the range then always includes 0. Rates are for hinges without
/// a range.
std::pair<double, double> extremes(const std::vector<double>& rows, std::size_t columns, std::size_t column, std::size_t first,
                                   std::size_t last, bool rates, double spacing);

}  // namespace gaitlab::report
