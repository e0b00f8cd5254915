#include "report/analysis/row_statistics.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <initializer_list>
#include <limits>

#include "core/plugin/plugin_instance.h"
#include "core/recording/motor_limit.h"
#include "report/analysis/envelope.h"

namespace gaitlab::report {

namespace {

constexpr double kNotKnown = std::numeric_limits<double>::quiet_NaN();
constexpr double kOnTick = 1e-6;  // share of a control period: rows within this distance of a control tick count as at the tick

/// Quantities of a joint whose trace columns are needed to compute a column of ticks.
std::initializer_list<const char*> needs(TickColumn column) {
  static constexpr std::initializer_list<const char*> kTorque{"torque"}, kError{"setpoint", "angle"},
      kLimit{"torque", "saturation"}, kSaturation{"saturation"}, kSpeed{"speed"}, kEnvelope{"torque", "speed"},
      kCurrent{"current"}, kVoltage{"voltage"};
  switch (column) {
    case kErrorPeak:
      return kError;
    case kPeakLimit:
      return kLimit;
    case kVoltageLimited:
    case kCurrentLimited:
      return kSaturation;
    case kSpeedPeak:
      return kSpeed;
    case kEnvelopePeak:
      return kEnvelope;
    case kCurrentSquare:
    case kCurrentPeak:
      return kCurrent;
    case kVoltagePeak:
      return kVoltage;
    default:
      return kTorque;
  }
}

/// State of the motors of all joints at one instant.
struct Moment {
  explicit Moment(std::size_t joints)
      : torque(joints), speed(joints), error(joints), voltage(joints), current(joints), saturation(joints), used(joints) {}
  std::vector<double> torque, speed, error, voltage, current;  ///< N m, rad/s, rad, V, A
  std::vector<double> saturation, used;                        ///< motor state as in saturation_of; share of the available
                                                               ///< torque
};

/// Motor states at the rows of a trace, and just after them.
class Moments {
 public:
  Moments(const Scenario& scenario, const Recording& record)
      : joints_(scenario.robot->joints.size()), period_(scenario.control_period), available_(scenario), t_(record.series("t")) {
    const auto all = [&](const char* quantity) {
      std::vector<Series> of_joints;
      for (std::size_t j = 0; j < joints_; ++j) {
        of_joints.push_back(record.joint(j, quantity));
        if (of_joints.back().empty() && scenario.robot->joints[j].driven()) return std::vector<Series>();
      }
      return of_joints;
    };
    command_ = all("voltage_command");
    setpoint_ = all("setpoint");
    angle_ = all("angle");
    torque_ = all("torque");
    speed_ = all("speed");
    voltage_ = all("voltage");
    current_ = all("current");
    saturation_ = all("saturation");
  }

  /// State recorded in the row, under the command in force before the time of the row.
  [[nodiscard]] Moment at(std::size_t row) const {
    Moment now(joints_);
    for (std::size_t j = 0; j < joints_; ++j) {
      now.torque[j] = value(torque_, j, row);
      now.speed[j] = value(speed_, j, row);
      now.error[j] = value(setpoint_, j, row) - value(angle_, j, row);
      now.voltage[j] = value(voltage_, j, row);
      now.current[j] = value(current_, j, row);
      now.saturation[j] = value(saturation_, j, row);
    }
    use(now);
    return now;
  }

  /// State just after the row, under the command stored in the next row, if that command covers the whole interval.
  [[nodiscard]] Moment begun(std::size_t row) const {
    Moment now = at(row);
    if (!one_command(row)) return now;
    for (std::size_t j = 0; j < joints_; ++j) now.error[j] = value(setpoint_, j, row + 1) - value(angle_, j, row);
    if (command_.empty() || speed_.empty()) return now;
    std::vector<double> command(joints_);
    std::vector<double> ignored(joints_);
    for (std::size_t j = 0; j < joints_; ++j) command[j] = value(command_, j, row + 1);
    Moment given(joints_);
    available_.actuator().effort(command, now.speed, given.torque, ignored);
    available_.actuator().electrical(command, now.speed,
                                     {given.voltage, given.current, given.saturation, ignored, ignored, ignored});
    if (!torque_.empty()) now.torque = given.torque;
    if (!voltage_.empty()) now.voltage = given.voltage;
    if (!current_.empty()) now.current = given.current;
    if (!saturation_.empty()) now.saturation = given.saturation;
    use(now);
    return now;
  }

 private:
  /// Value in a row; 0 if the column is missing for a joint without a motor.
  static double value(const std::vector<Series>& of, std::size_t joint, std::size_t row) {
    return of.empty() ? kNotKnown : of[joint].empty() ? 0.0 : of[joint][row];
  }

  /// True if no control tick is inside the interval after the row.
  [[nodiscard]] bool one_command(std::size_t row) const {
    return t_[row + 1] / period_ - kOnTick <= std::floor(t_[row] / period_ + kOnTick) + 1;
  }

  /// Computes `used`: torque / torque available at that speed in the direction of the torque.
  void use(Moment& now) const {
    now.used.assign(joints_, kNotKnown);
    if (torque_.empty() || speed_.empty()) return;
    std::vector<double> most(joints_);
    std::vector<double> least(joints_);
    available_.at(now.speed, most, least);
    for (std::size_t j = 0; j < joints_; ++j) {
      const double torque = std::abs(now.torque[j]);
      const double there = now.torque[j] < 0 ? -least[j] : most[j];
      now.used[j] = !available_.known(j) ? 0.0 : torque < there ? torque / there : torque > 0 ? 1.0 : 0.0;
    }
  }

  std::size_t joints_;
  double period_;
  AvailableTorque available_;
  Series t_;
  std::vector<Series> command_, setpoint_, angle_, torque_, speed_, voltage_, current_, saturation_;
};

/// Fills a joint's part of a row of ticks, for the interval of h seconds between two instants. `before` is the joint's part in
/// the previous row, whose integrals are continued.
void fill_row(const Moment& from, const Moment& to, std::size_t j, double h, In before, Out row) {
  const auto peak = [&](std::vector<double> Moment::*of) { return std::max(std::abs((from.*of)[j]), std::abs((to.*of)[j])); };
  const auto integral = [&](auto value) { return h / 2 * (value(from) + value(to)); };
  const auto square = [&](std::vector<double> Moment::*of) {
    return integral([&](const Moment& m) { return (m.*of)[j] * (m.*of)[j]; });
  };
  const auto limited = [&](MotorLimit limit) {
    return integral([&](const Moment& m) {
      return std::isnan(m.saturation[j]) ? kNotKnown : motor_limit(m.saturation[j]) == limit ? 1.0 : 0.0;
    });
  };
  const bool at_start = std::abs(from.torque[j]) >= std::abs(to.torque[j]);
  row[kTorquePeak] = peak(&Moment::torque);
  row[kPeakLimit] = (at_start ? from : to).saturation[j];
  row[kTorqueSquare] = before[kTorqueSquare] + square(&Moment::torque);
  row[kVoltageLimited] = before[kVoltageLimited] + limited(MotorLimit::voltage);
  row[kCurrentLimited] = before[kCurrentLimited] + limited(MotorLimit::current);
  row[kSpeedPeak] = peak(&Moment::speed);
  row[kErrorPeak] = peak(&Moment::error);
  row[kEnvelopePeak] = peak(&Moment::used);
  row[kCurrentSquare] = before[kCurrentSquare] + square(&Moment::current);
  row[kVoltagePeak] = peak(&Moment::voltage);
  row[kCurrentPeak] = peak(&Moment::current);
}

}  // namespace

void fill_ticks_from_rows(const Scenario& scenario, Recording& record) try {
  const std::size_t joints = scenario.robot->joints.size();
  if (!record.joints.empty() || !record.ticks.columns.empty()) return;
  if (scenario.actuator.entry == nullptr || joints == 0 || record.rows() < 2) return;
  const Moments moments(scenario, record);
  const Series t = record.series("t");
  Trace ticks;
  ticks.columns = tick_columns(joints);
  ticks.values.assign(ticks.columns.size() * record.rows(), 0.0);
  const auto row_of = [&](std::size_t k) { return Out(ticks.values).subspan(k * ticks.columns.size(), ticks.columns.size()); };
  row_of(0)[0] = t[0];
  for (std::size_t k = 1; k < record.rows(); ++k) {
    const Moment from = moments.begun(k - 1);
    const Moment to = moments.at(k);
    const Out row = row_of(k);
    row[0] = t[k];
    for (std::size_t j = 0; j < joints; ++j) {
      if (!scenario.robot->joints[j].driven()) continue;
      const std::size_t at = 1 + j * kTickColumns;
      fill_row(from, to, j, t[k] - t[k - 1], row_of(k - 1).subspan(at, kTickColumns), row.subspan(at, kTickColumns));
    }
  }
  record.ticks = std::move(ticks);
  record.ticks_of_rows = true;
} catch (const PluginError&) {  // an actuator that throws may have ended the run, which reports it; the values are not known
}

std::string lacking(const Recording& record, const Robot& robot, TickColumn column) {
  for (const char* const quantity : needs(column)) {
    for (std::size_t j = 0; j < robot.joints.size(); ++j) {
      if (robot.joints[j].driven() && record.joint(j, quantity).empty()) return fmt::format("joint.{}.{}", j, quantity);
    }
  }
  return "";
}

std::string rows_sentence(const Recording& record) {
  if (!record.ticks_of_rows) return "";
  const Series t = record.series("t");
  return fmt::format("judged from the trace's rows, one per {:.3g} ms: a peak between two rows is not seen",
                     1000 * (t[1] - t[0]));
}

std::vector<BeyondRange> beyond_range(const Robot& robot, const Recording& record) {
  std::vector<BeyondRange> all;
  for (const JointStatistics& joint : record.joints) all.push_back({joint.range_worst, joint.range_share});
  if (!all.empty()) return all;
  const Series t = record.series("t");
  for (std::size_t j = 0; j < robot.joints.size(); ++j) {
    const Series angle = record.joint(j, "angle");
    if (angle.size() < 2) return {};
    BeyondRange beyond;
    for (std::size_t k = 0; k < angle.size(); ++k) {
      const double excess = std::max(angle[k] - robot.joints[j].hi, robot.joints[j].lo - angle[k]);
      if (!(excess > 0)) continue;
      beyond.worst = std::max(beyond.worst, excess);
      if (k > 0) beyond.share += (t[k] - t[k - 1]) / (t.back() - t[0]);
    }
    all.push_back(beyond);
  }
  return all;
}

}  // namespace gaitlab::report
