// Limits of a joint's motor in a panel of curves.
#pragma once
#include <vector>

#include "core/recording/motor_limit.h"
#include "report/figures/paper/paper_panel.h"

namespace gaitlab::report {

struct MotorLimitMarks {
  struct Reached {
    MotorLimit limit;
    double from, to;  ///< s
  };
  std::vector<Reached> reached;  ///< from the first row at the limit to the row after the last
  std::vector<double> rest;      ///< N m, plus or minus the torque at rest, if the joint's torque comes near

  void shade(const Plot& plot) const;
  /// Lines at the torque at rest.
  void draw(const Plot& plot, Side torque) const;
  void add_to(std::vector<LegendEntry>& legend) const;
};

MotorLimitMarks motor_limits(const PaperRun& run, std::size_t joint, const RowRange& rows);

}  // namespace gaitlab::report
