#include "report/verdict/rolled.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace gaitlab::report {

namespace {

double largest(const Recording& record, double JointStatistics::*member) {
  double most = 0;
  for (const JointStatistics& joint : record.joints) most = std::max(most, joint.*member);
  return most;
}

struct RolledColumn {
  Column column;
  double (*value)(const Rolled& run);
};
const std::array kRolledColumns{
    RolledColumn{{"torque_peak", "N m", "largest motor torque over all joints"},
                 [](const Rolled& run) { return largest(run.record, &JointStatistics::torque_peak); }},
    RolledColumn{{"torque_rms", "N m", "largest RMS of a motor torque over all joints"},
                 [](const Rolled& run) { return largest(run.record, &JointStatistics::torque_rms); }},
    RolledColumn{{"distance", "m", "travel of the centre of mass"}, [](const Rolled& run) { return run.summary.distance; }},
    RolledColumn{
        {kLeastMargin, "", "least margin of the checks that can fail"},
        [](const Rolled& run) { return run.verdict.tightest() == nullptr ? std::nan("") : run.verdict.tightest()->margin; }},
};

}  // namespace

std::string margin_column(const std::string& check) { return "margin." + check; }

std::vector<Column> rolled_columns() {
  std::vector<Column> columns;
  for (const RolledColumn& one : kRolledColumns) columns.push_back(one.column);
  for (const CheckKind& kind : check_kinds()) columns.push_back({margin_column(kind.id), "", "margin of the verdict's check"});
  return columns;
}

std::vector<double> rolled_row(const Rolled& run) {
  std::vector<double> row;
  for (const RolledColumn& one : kRolledColumns) row.push_back(one.value(run));
  for (const Check& check : run.verdict.checks) row.push_back(check.margin);
  return row;
}

}  // namespace gaitlab::report
