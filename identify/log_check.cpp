#include "identify/log_check.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <nlohmann/json.hpp>

#include "core/files/csv_table.h"
#include "core/laws/dc_motor.h"
#include "core/scenario/built_robot.h"
#include "core/settings/wording.h"

namespace gaitlab::identify {

namespace {

constexpr double kTooFast = 4;         // the number
constexpr std::size_t kMostSpike = 5;  // rows; chosen: a few lost packets of a bus

/// Adds the jumps of an angle. `usual` is the usual time between rows: times that a computer stamps may be closer.
void add_jumps(const std::vector<double>& t, const std::vector<double>& angle, double usual, Jumps& to) {
  const auto far = [&](std::size_t from, std::size_t row) {
    return std::abs(angle[row] - angle[from]) > to.fastest * std::max(t[row] - t[from], usual);
  };
  std::size_t good = 0;
  while (good + 1 < angle.size() && far(good, good + 1)) ++good;
  std::vector<std::size_t> rows;
  for (std::size_t row = 0; row < good; ++row) rows.push_back(row);
  const auto end = [&](bool back) {
    if (!back || rows.size() > kMostSpike) {
      to.steps.push_back(rows[0]);
    } else {
      to.spikes.insert(to.spikes.end(), rows.begin(), rows.end());
    }
    rows.clear();
  };
  if (!rows.empty()) end(true);
  for (std::size_t row = good + 1; row < angle.size(); ++row) {
    if (far(good, row)) {
      rows.push_back(row);
      continue;
    }
    // In a longer time the motor could turn to a new angle.
    if (!rows.empty()) end(std::abs(angle[row] - angle[good]) < std::abs(angle[row] - angle[rows.back()]));
    good = row;
  }
  if (!rows.empty()) end(rows.size() == 1);  // the last row alone may be a spike
}

/// Faults of the numbers of a log, by the motor that it should be of.
class LogCheck {
 public:
  LogCheck(const BenchLog& log, Problems& problems) : log_(log), numbers_(*log.scenario.measured.log), problems_(problems) {
    const double row = numbers_.t.back() / static_cast<double>(numbers_.t.size() - 1);
    if (row > kSlow) {
      problems_.add({log_.file}, fmt::format("the rows are {:.3g} s apart; expected times in s, with a row at least every {} s",
                                             row, kSlow));
      return;
    }
    const std::unique_ptr<Actuator> motors = make_motors(log.scenario);
    const DcMotor* const dc = motors == nullptr ? nullptr : motors->dc_motors();
    for (const MeasuredLog::OfJoint& joint : numbers_.joints) {
      if (dc != nullptr) motor_ = &dc[joint.joint];
      name_ = log.scenario.robot->joints[joint.joint].name;
      if (const auto& angle = joint.of(Logged::angle); !angle.empty()) check_angle(angle);
      if (const auto& current = joint.of(Logged::current); !current.empty() && dc != nullptr) check_current(current);
      if (const auto& duty = joint.of(Logged::duty); !duty.empty()) check_duty(duty);
    }
    if (plausible_) check_jumps();
  }

 private:
  static double largest(const std::vector<double>& values) {
    return std::abs(*std::ranges::max_element(values, {}, [](double one) { return std::abs(one); }));
  }
  template <class... Parts>
  void add(fmt::format_string<Parts...> text, Parts&&... parts) {
    plausible_ = false;
    problems_.add({log_.file}, fmt::format("joint {}: ", name_) + fmt::format(text, std::forward<Parts>(parts)...));
  }

  void check_angle(const std::vector<double>& angle) {
    const auto [low, high] = std::ranges::minmax_element(angle);
    const double span = *high - *low;
    if (span < kStill) return add("the angle spans {:.3g} rad; expected a motion of at least {:.3g} rad", span, kStill);
    const bool whole = std::ranges::all_of(angle, [](double one) { return one == std::round(one); });
    if (span > kTurns && whole) {
      return add(
          "the angles are whole numbers from {:.6g} to {:.6g}, which look like ticks; expected rad, with the ticks per rad "
          "as scale, such as 651.9 for 4096 per turn",
          *low, *high);
    }
    if (span > kTurns)
      return add("the angles span {:.4g}, which look like degrees; expected rad, with 57.29578 as scale", span);
  }

  void check_jumps() {
    const Jumps jumps = jumps_of(log_.scenario);
    const std::string faster = fmt::format("an angle jumps faster than {:.3g} rad/s, {:.0f} times the speed of the motor, at ",
                                           jumps.fastest, kTooFast);
    if (!jumps.steps.empty()) {
      problems_.add({log_.file},
                    faster + row_list(jumps.steps) + ", and stays there: an encoder that wraps, or a zero that moved");
    } else if (!jumps.spikes.empty()) {
      problems_.add({log_.file}, faster + row_list(jumps.spikes) + "; remove these rows, or leave them out with --drop-spikes");
    }
  }

  void check_current(const std::vector<double>& current) {
    if (const double most = largest(current); most > kTooMuch * motor_->u_max / motor_->R) {
      add("the current reaches {:.4g} A, {:.0f} times that of the stalled motor; expected A: mA have 1000 as scale", most,
          most / (motor_->u_max / motor_->R));
    }
  }

  void check_duty(const std::vector<double>& duty) {
    if (const double most = largest(duty); most > kWhole)
      add("the duty reaches {:.4g}; expected at most 1, with the number of full duty as scale, such as 885 or 100", most);
  }

  static constexpr double kSlow = 0.2;    // s; chosen: a servo moves within some 0.1 s
  static constexpr double kStill = 0.02;  // rad, some ticks of 12 bits; chosen
  static constexpr double kTurns = 50;    // rad, 8 turns; chosen: no hinge of a robot's gait turns further
  static constexpr double kTooMuch = 50;  // of the stall current; chosen between a wrong data sheet and mA
  static constexpr double kWhole = 1.05;  // chosen: rounding of a PWM
  const BenchLog& log_;
  const MeasuredLog& numbers_;
  Problems& problems_;
  const DcMotor* motor_ = nullptr;
  std::string name_;
  bool plausible_ = true;  ///< false after a fault of the numbers of a column
};

}  // namespace

Jumps jumps_of(const Scenario& scenario) {
  Jumps all;
  const MeasuredLog& log = *scenario.measured.log;
  const std::unique_ptr<Actuator> motors = make_motors(scenario);
  const DcMotor* const dc = motors == nullptr ? nullptr : motors->dc_motors();
  if (dc == nullptr) return all;
  std::vector<double> apart;
  for (std::size_t k = 1; k < log.t.size(); ++k) apart.push_back(log.t[k] - log.t[k - 1]);
  const auto middle = apart.begin() + static_cast<std::ptrdiff_t>(apart.size() / 2);
  std::ranges::nth_element(apart, middle);
  for (const MeasuredLog::OfJoint& joint : log.joints) {
    const DcMotor& motor = dc[joint.joint];
    if (joint.of(Logged::angle).empty() || !(motor.Ks > 0)) continue;
    all.fastest = kTooFast * motor.u_max / (motor.Ks * motor.gear);
    add_jumps(log.t, joint.of(Logged::angle), *middle, all);
  }
  for (std::vector<std::size_t>* const rows : {&all.spikes, &all.steps}) {
    std::ranges::sort(*rows);
    rows->erase(std::unique(rows->begin(), rows->end()), rows->end());  // clang 14 cannot compile ranges::unique
  }
  return all;
}

std::string row_list(const std::vector<std::size_t>& rows) {
  std::vector<std::string> all;
  for (const std::size_t row : rows) all.push_back(std::to_string(row + 1));
  return fmt::format("row{} {}", rows.size() == 1 ? "" : "s", joined(all));
}

std::string without_rows(const std::string& text, const std::vector<std::size_t>& rows) {
  const CsvTable table(text);
  if (text.find('{') < text.find(table.names()[0])) {  // JSON, as CsvTable reads it
    auto json = nlohmann::ordered_json::parse(text);
    auto& entries = json["entries"];
    for (auto row = rows.rbegin(); row != rows.rend(); ++row) entries.erase(*row);
    return json.dump() + "\n";
  }
  std::vector<int> lines;
  for (const std::size_t row : rows) lines.push_back(table.line(row));
  std::string left;
  int line = 0;
  for (std::size_t from = 0; from < text.size();) {
    const std::size_t end = std::min(text.find('\n', from), text.size() - 1) + 1;
    left += std::ranges::binary_search(lines, ++line) ? "\n" : text.substr(from, end - from);
    from = end;
  }
  return left;
}

void check_logs(const std::vector<BenchLog>& logs) {
  Problems problems;
  std::map<std::string, std::string> known;  // names of the logs by hash
  for (const BenchLog& log : logs) {
    const auto [at, is_new] = known.try_emplace(log.hash, log.file);
    if (!is_new) problems.add({log.file}, "has the rows of " + at->second + "; name each log once");
    LogCheck(log, problems);
  }
  problems.raise();
}

}  // namespace gaitlab::identify
