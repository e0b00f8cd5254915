#include "core/recording/recording.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace gaitlab {

std::vector<double> Series::values() const {
  std::vector<double> all(size_);
  for (std::size_t row = 0; row < size_; ++row) all[row] = (*this)[row];
  return all;
}

const std::vector<std::string>& report_columns() {
  static const std::vector<std::string> kPatterns{"joint.*.setpoint",
                                                  "joint.*.angle",
                                                  "joint.*.measured",
                                                  "joint.*.torque",
                                                  "joint.*.saturation",
                                                  "base.?",
                                                  "base.q?",
                                                  "com.?",
                                                  "load.*",
                                                  "box.*.?",
                                                  "box.*.q?"};
  return kPatterns;
}

Series Recording::series(const std::string& column) const {
  for (const Trace* table : {&trace, &rest}) {
    const std::size_t at = table->find(column);
    if (at < table->columns.size() && table->rows() > 0) return {*table, at};
  }
  return {};
}

Series Recording::joint(std::size_t number, const char* quantity) const {
  return series(fmt::format("joint.{}.{}", number, quantity));
}

Series Recording::pose(const std::string& column) const {
  const std::size_t at = poses.find(column);
  return at < poses.columns.size() && poses.rows() > 0 ? Series(poses, at) : Series();
}

Series Recording::tick(std::size_t number, TickColumn column) const {
  const std::size_t columns = ticks.columns.size();
  if (ticked() == 0 || ticks.rows() < 2 || columns != 1 + ticked() * kTickColumns) return {};
  return Series(ticks, 1 + number * kTickColumns + column);
}

namespace {

/// Value of a row; NaN if the column is missing.
double at(const Series& series, std::size_t row) {
  return series.empty() ? std::numeric_limits<double>::quiet_NaN() : series[row];
}

}  // namespace

Vec3 Recording::com(std::size_t row) const {
  return {at(series("com.x"), row), at(series("com.y"), row), at(series("com.z"), row)};
}

bool Recording::has_states(const Robot& robot) const {
  for (const char* column : {"base.x", "base.y", "base.z", "base.qw", "base.qx", "base.qy", "base.qz"}) {
    if (series(column).empty()) return false;
  }
  for (std::size_t j = 0; j < robot.joints.size(); ++j) {
    if (joint(j, "angle").empty()) return false;
  }
  return true;
}

RobotState Recording::state(const Robot& robot, std::size_t row) const {
  const auto value = [&](const char* column) { return at(series(column), row); };
  RobotState s;
  s.position = Vec3(value("base.x"), value("base.y"), value("base.z"));
  s.orientation = Quat(value("base.qw"), value("base.qx"), value("base.qy"), value("base.qz"));
  for (std::size_t j = 0; j < robot.joints.size(); ++j) s.q.push_back(at(joint(j, "angle"), row));
  s.qd.assign(robot.joints.size(), 0.0);
  return s;
}

void AllRows::swap(Recording& r) {
  std::swap(trace, r.trace);
  std::swap(rest, r.rest);
}

namespace {

Trace every(std::size_t stride, const Trace& all) {
  Trace some;
  some.columns = all.columns;
  const std::size_t rows = all.rows();
  some.values.reserve((rows / stride + 2) * all.columns.size());
  for (std::size_t row = 0; row < rows; row = row + stride < rows || row + 1 == rows ? row + stride : rows - 1) {
    const std::span<const double> values = all.row(row);
    some.values.insert(some.values.end(), values.begin(), values.end());
    if (row / stride % 256 == 0) release(all.values);
  }
  return some;
}

}  // namespace

std::optional<AllRows> thin_rows(Recording& r, std::size_t most) {
  const std::size_t bytes = (r.trace.values.size() + r.rest.values.size()) * sizeof(double);
  const std::size_t stride = (bytes + most - 1) / most;
  if (stride <= 1) return {};
  r.hash_of_all = hash(r.trace);
  AllRows all{every(stride, r.trace), every(stride, r.rest), stride};
  all.swap(r);
  return all;
}

std::vector<Column> tick_columns(std::size_t joints) {
  std::vector<Column> columns{{"t", "s", "time"}};
  for (std::size_t j = 0; j < joints; ++j) {
    const auto add = [&](const char* name, const char* unit, const char* definition) {
      columns.push_back({fmt::format("joint.{}.{}", j, name), unit, definition});
    };
    add("torque_peak", "N m", "largest magnitude of the motor torque since the row before, over all steps");
    add("error_peak", "rad", "largest magnitude of set point minus angle since the row before, over all steps");
    add("peak_limit", "", "saturation of the motor at that torque: 0 none, 1 voltage, 2 current");
    add("torque_square", "N^2 m^2 s", "integral of the motor torque squared from t = 0, over all steps");
    add("voltage_limited", "s", "time at the voltage limit from t = 0, over all steps");
    add("current_limited", "s", "time at the current limit from t = 0, over all steps");
    add("speed_peak", "rad/s", "largest magnitude of the speed since the row before, over all steps");
    add("envelope_peak", "", "largest share of the torque that the actuator has at that speed, since the row before");
    add("current_square", "A^2 s", "integral of the current squared from t = 0, over all steps");
    add("voltage_peak", "V", "largest magnitude of the motor's voltage since the row before, over all steps");
    add("current_peak", "A", "largest magnitude of the motor's current since the row before, over all steps");
  }
  return columns;
}

std::vector<Column> pose_columns(std::size_t joints) {
  std::vector<Column> columns{{"t", "s", "time"}};
  for (const char* axis : {"x", "y", "z"})
    columns.push_back({fmt::format("base.{}", axis), "m", "origin of the base frame, world axes"});
  for (const char* part : {"qw", "qx", "qy", "qz"})
    columns.push_back({fmt::format("base.{}", part), "", "quaternion, base frame to world"});
  for (std::size_t j = 0; j < joints; ++j) columns.push_back({fmt::format("joint.{}.angle", j), "rad", "joint angle"});
  for (std::size_t j = 0; j < joints; ++j) {
    columns.push_back({fmt::format("joint.{}.setpoint", j), "rad",
                       "set point in force before the tick; the angle of a joint without a motor"});
  }
  for (const char* axis : {"x", "y", "z"}) columns.push_back({fmt::format("com.{}", axis), "m", "centre of mass, world axes"});
  columns.push_back({"load", "N", "normal force of the ground on the robot"});
  return columns;
}

void halve_ticks(Trace& ticks) {
  const std::size_t columns = ticks.columns.size();
  const std::size_t rows = ticks.rows();
  const auto row = [&](std::size_t k) { return Out(ticks.values).subspan(k * columns, columns); };
  std::size_t kept = 1;
  for (std::size_t k = 2; k < rows; k += 2, ++kept) {
    const Out before = row(k - 1);
    const Out now = row(k);
    for (std::size_t c = 1; c < columns; c += kTickColumns) {
      if (before[c + kTorquePeak] > now[c + kTorquePeak]) {
        now[c + kTorquePeak] = before[c + kTorquePeak];
        now[c + kPeakLimit] = before[c + kPeakLimit];
      }
      for (const TickColumn peak : {kErrorPeak, kSpeedPeak, kEnvelopePeak, kVoltagePeak, kCurrentPeak})
        now[c + peak] = std::max(before[c + peak], now[c + peak]);
    }
    std::ranges::copy(row(k), row(kept).begin());
  }
  ticks.values.resize(kept * columns);
}

std::vector<Column> supply_columns(const std::vector<std::string>& modules) {
  std::vector<Column> all{{"t", "s", "time"}};
  for (const std::string& module : modules) {
    const auto add = [&](const char* name, const char* unit, const char* definition) {
      all.push_back({module.empty() ? name : fmt::format("{}.{}", module, name), unit, definition});
    };
    add("voltage_least", "V", "least voltage of the bus since the previous row");
    add("current_peak", "A", "largest current of the supply since the previous row");
    add("held", "", "0 if no voltage satisfied the law of the bus since the previous row");
    add("charge", "A s", "charge drawn from t = 0");
    add("current_square", "A^2 s", "integral of current^2 from t = 0");
  }
  return all;
}

void keep_worst(const ColumnList& columns, In before, Out now) {
  for (std::size_t c = 0; c < columns.size(); ++c) {
    const std::string& name = columns[c].name;
    const bool worse = name == "stability" || name.ends_with("voltage_least") || name.ends_with("held")
                           ? before[c] < now[c] || (std::isnan(now[c]) && !std::isnan(before[c]))
                       : name.ends_with("current_peak")                           ? before[c] > now[c]
                       : !name.starts_with("dock.") && !name.starts_with("gear.") ? false
                       : name.ends_with(".tension")                               ? before[c] > now[c]
                                                                                  : std::abs(before[c]) > std::abs(now[c]);
    if (worse) now[c] = before[c];
  }
}

void halve_rows(Trace& table) {
  const std::size_t columns = table.columns.size();
  const std::size_t rows = table.rows();
  std::size_t kept = std::min<std::size_t>(1, rows);
  for (std::size_t k = 2; k < rows; k += 2, ++kept) {
    const auto row = [&](std::size_t index) { return Out(table.values).subspan(index * columns, columns); };
    keep_worst(table.columns, row(k - 1), row(k));
    std::ranges::copy(row(k), row(kept).begin());
  }
  table.values.resize(kept * columns);
}

}  // namespace gaitlab
