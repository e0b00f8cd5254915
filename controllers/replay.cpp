#include "controllers/replay.h"

#include <algorithm>
#include <stdexcept>

#include "core/files/csv_table.h"

namespace gaitlab::controllers {

const char* const Replay::kManual =
    R"(The commands of a log, whatever angle and set point are: the motors get what the real motors got.

    u(t) = number in the column / scale, of the last row at or before t, sampled at control ticks

Time 0 is the first row; after the last row its command holds. Joints without a column have the command 0. `unit` is that of the
commands: V, N m, or duty, the share of the supply: a PWM of 885 at full duty has scale 885. `file` is a path relative to the
scenario, or the text itself. With a section `measured` of the same log, the difference that is left is
that of motor, friction and load alone, without the firmware. Set points do not act, so that check `tracking` says nothing.
Source: none; the input of output-error identification (L. Ljung, System Identification, Prentice Hall 1999).

    controller:
      type: replay
      unit: V
      columns: {m0/active: volts}
      file: |
        t,   volts
        0,   0
        0.5, 3)";

void Replay::Settings::fields(Fields& f) {
  static constexpr const char* kUnits[] = {"V", "N m", "duty"};
  f.file("file", file, "The log: a CSV with a line of names, then a line per row, or JSON with a list `entries`.");
  f.text("time", time, "Column of the times, s, which rise.");
  f.choice("unit", unit, kUnits, "Unit of the commands.");
  f.columns("columns", columns, "Column of a joint's commands. Scale: the number in the column for a command of 1.");
}

Replay::Replay(const RobotInfo& robot, const Settings& settings) : unit_(settings.unit), period_(robot.control_period) {
  const CsvTable log(settings.file);
  time_ = log.column(settings.time);
  if (time_.empty()) throw std::invalid_argument("the log has no rows");
  const double start = time_[0];
  for (std::size_t k = 0; k < time_.size(); ++k) {
    time_[k] -= start;
    if (k > 0 && !(time_[k] > time_[k - 1])) log.fail(k, settings.time, "times must rise");
  }
  std::vector<std::vector<double>> columns;
  for (const auto& [joint, column] : settings.columns) {
    if (joint < 0) continue;
    joints_.push_back(static_cast<std::size_t>(joint));
    columns.push_back(log.column(column.name, column.scale));
  }
  values_.reserve(time_.size() * joints_.size());
  for (std::size_t k = 0; k < time_.size(); ++k) {
    for (const std::vector<double>& column : columns) values_.push_back(column[k]);
  }
}

std::string_view Replay::command_unit() const { return unit_ == Unit::V ? "V" : unit_ == Unit::Nm ? "N m" : "duty"; }

void Replay::update(const Measured&, In, In, Out x, Out command) const {
  constexpr double kSameTime = 1e-9;  // s; rounding of times
  const auto next = std::upper_bound(time_.begin(), time_.end(), x[0] * period_ + kSameTime);
  x[0] += 1;
  const auto row = static_cast<std::size_t>(std::max<std::ptrdiff_t>(0, next - time_.begin() - 1));
  std::fill(command.begin(), command.end(), 0.0);
  for (std::size_t i = 0; i < joints_.size(); ++i) command[joints_[i]] = values_[row * joints_.size() + i];
}

}  // namespace gaitlab::controllers
