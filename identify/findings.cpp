#include "identify/findings.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "core/laws/dc_motor.h"
#include "core/scenario/built_robot.h"
#include "core/settings/settings_numbers.h"
#include "core/settings/wording.h"
#include "identify/log_check.h"

namespace gaitlab::identify {

namespace {

constexpr double kTrade = 0.9;     // correlation; chosen
constexpr double kWide = 0.5;      // half width of an interval as a share of the value; chosen
constexpr double kShare = 0.1;     // of the time at the limit; the number
constexpr double kFar = 2;         // times the median error of the logs; chosen
constexpr double kStrange = 0.5;   // of the span of the angles; chosen
constexpr double kReached = 0.98;  // of a limit; chosen

/// A measurement that separates two keys.
struct Remedy {
  const char *one, *other, *text;
};
constexpr const char* kSwing = "needed: a log that swings without torque (`on` = 0)";
constexpr Remedy kRemedies[] = {
    {"actuator.no_load_speed", "actuator.viscous_friction", kSwing},
    {"actuator.stall_torque", "actuator.load_friction", "needed: a load lowered slowly, with another mass"},
    {"actuator.stall_torque", "actuator.no_load_speed", "needed: fast motion without a load"},
    {"actuator.dry_friction", "actuator.viscous_friction", "needed: slow and fast motion in one log"},
    {"actuator.rotor_inertia", "controller.latency", "needed: a step of the set point at a high sampling rate"},
};

/// `free`: a fitted log swings without torque.
const char* remedy(const std::string& one, const std::string& other, bool free) {
  for (const Remedy& row : kRemedies) {
    if (free && row.text == kSwing) continue;
    if ((row.one == one && row.other == other) || (row.one == other && row.other == one)) return row.text;
  }
  return "needed: a log that depends on one of them only";
}

/// True if a log has rows without torque.
bool swings_free(const BenchLog& log) {
  return std::ranges::any_of(log.scenario.changes, [](const Change& change) {
    return std::ranges::any_of(change.faults, [](const JointFault& fault) { return fault.kind == FaultKind::open; });
  });
}

class Findings {
 public:
  Findings(const Identified& made, const std::vector<BenchLog>& logs, const std::vector<Key>& keys)
      : made_(made), logs_(logs), keys_(keys) {
    free_ = std::ranges::any_of(logs, [](const BenchLog& log) { return !log.held_out && swings_free(log); });
  }

  std::vector<std::string> take() {
    add_failures();
    add_missing();
    add_trades();
    add_wide();
    add_limits();
    add_logs();
    return std::move(all_);
  }

 private:
  template <class... Parts>
  void add(fmt::format_string<Parts...> text, Parts&&... parts) {
    all_.push_back(fmt::format(text, std::forward<Parts>(parts)...));
  }
  [[nodiscard]] bool fitted(const std::string& name) const {
    return std::ranges::any_of(made_.keys, [&](const IdentifiedKey& one) { return one.fitted && keys_[one.key].name == name; });
  }

  void add_failures() {
    if (made_.starts > 1 && 2 * made_.agreed < made_.starts) {
      add("{} of {} starts end within 2 % of the best: there may be a better fit; state ranges, as in --fit KEY=LOW:HIGH",
          made_.agreed, made_.starts);
    }
    for (const Logged kind : made_.kinds) {
      for (const bool held_out : {false, true}) {
        const auto before = mean_error(logs_, made_.before, kind, held_out);
        const auto after = mean_error(logs_, made_.after, kind, held_out);
        if (before && *after > *before) {
          add("the {} of {} logs is further off than by the bench: do not use the numbers",
              logged_kinds()[static_cast<std::size_t>(kind)].key, held_out ? "held-out" : "fitted");
        }
      }
    }
    for (std::size_t l = 0; l < logs_.size(); ++l) {
      for (const report::JointLogErrors& joint : made_.before[l].errors->joints) {
        for (const Logged kind : made_.kinds) {
          const auto& error = joint.of(kind);
          if (!error || !(error->mae > kStrange * error->span)) continue;
          const char* const name = logged_kinds()[static_cast<std::size_t>(kind)].key;
          add("log {}: the {} of the bench is off by {:.2g} times the span of the log; look at unit, sign and zero of {} and "
              "goal, and at the column `on`",
              logs_[l].name, name, error->mae / error->span, name);
        }
      }
    }
  }

  void add_missing() {
    if (std::ranges::none_of(logs_, &BenchLog::held_out))
      add("no log is held out: the error is that of the logs from which the numbers were taken");
    if (made_.kinds == std::vector{Logged::angle} && fitted("actuator.stall_torque")) {
      const auto bare = std::ranges::find_if_not(logs_, &BenchLog::has_duty);
      add("angles alone are compared{}: stall_torque is right only as far as the controller's gain is, because their product "
          "moves the joint",
          bare == logs_.end() ? "" : fmt::format(", because log {} has no duty", bare->name));
    }
    const SettingsNumbers numbers(logs_[0].scenario.actuator);
    if (const auto* supply = numbers.find("u_max"); supply != nullptr && !(supply->value[0] > 0)) {
      add("actuator.u_max is 0: the supply is taken to be the voltage of the data sheet; state the volts of the bench, to "
          "which stall_torque is proportional");
    }
    if (logs_[0].efficiency && (fitted("actuator.stall_torque") || fitted("actuator.no_load_speed"))) {
      add("no log has a current: currents and their checks rest on the efficiency of the bench. Its stall current does not "
          "follow from these logs");
    }
    if (!free_ && fitted("actuator.viscous_friction"))
      add("no fitted log swings without torque (`on` = 0): friction and back EMF act together in all of them");
  }

  void add_trades() {
    const std::vector<std::size_t>& of = made_.best.at.keys;
    for (Eigen::Index i = 0; i < made_.correlation.rows(); ++i) {
      for (Eigen::Index j = 0; j < i; ++j) {
        const double r = made_.correlation(i, j);
        if (std::abs(r) < kTrade) continue;
        const std::string& one = keys_[of[static_cast<std::size_t>(j)]].name;
        const std::string& other = keys_[of[static_cast<std::size_t>(i)]].name;
        add("{} and {} trade (correlation {:.2f}); {}", one, other, r, remedy(one, other, free_));
      }
    }
  }

  void add_wide() {
    for (const IdentifiedKey& one : made_.keys) {
      const double half = (one.high - one.low) / 2;
      const Key& key = keys_[one.key];
      if (one.at_bound) {
        add("{} is at a bound of its range, {:.4g} to {:.4g}{}{}; without an interval", key.name, key.low, key.high,
            key.unit.empty() ? "" : " ", key.unit);
      } else if (one.fitted && half > kWide * std::abs(one.value)) {
        add("{} is known to +- {:.2g}{}{} only", key.name, half, key.unit.empty() ? "" : " ", key.unit);
      }
    }
  }

  void add_limits() {
    const std::unique_ptr<Actuator> motors = make_motors(logs_[0].scenario);
    const DcMotor* const dc = motors == nullptr ? nullptr : motors->dc_motors();
    if (!fitted("actuator.i_max") || dc == nullptr) return;
    const auto limit =
        std::ranges::find_if(made_.keys, [&](const IdentifiedKey& one) { return keys_[one.key].name == "actuator.i_max"; });
    const auto reached = [&](const Compared& run) { return run.largest_current >= kReached * limit->value; };
    if (std::ranges::none_of(made_.after, reached)) add("actuator.i_max: no log reaches it; its value is a lower bound");
  }

  void add_logs() {
    for (const BenchLog& log : logs_) {
      if (!log.left_out.empty()) add("log {}: {} left out as spikes", log.name, row_list(log.left_out));
    }
    std::vector<double> errors;
    for (const Compared& run : made_.after) errors.push_back(error_of(run, made_.kinds[0]));
    std::vector<double> sorted = errors;
    const auto middle = sorted.begin() + static_cast<std::ptrdiff_t>(sorted.size() / 2);
    std::ranges::nth_element(sorted, middle);
    for (std::size_t l = 0; l < logs_.size(); ++l) {
      if (errors[l] > kFar * *middle) {
        add("log {} is {:.1f} times as far off as the median log; look at it before the numbers are used", logs_[l].name,
            errors[l] / *middle);
      }
      const report::LogErrors& of = *made_.after[l].errors;
      const auto simulated = of.mean(&report::JointLogErrors::at_limit);
      const auto measured = of.mean(&report::JointLogErrors::measured_at_limit);
      if (simulated && measured && std::abs(*simulated - *measured) > kShare)
        add("log {}: at the limit for {:.2f} of the time, {:.2f} in the log", logs_[l].name, *simulated, *measured);
    }
  }

  const Identified& made_;
  const std::vector<BenchLog>& logs_;
  const std::vector<Key>& keys_;
  bool free_ = false;  ///< true if a fitted log swings without torque
  std::vector<std::string> all_;
};

}  // namespace

std::vector<std::string> findings(const Identified& made, const std::vector<BenchLog>& logs, const std::vector<Key>& keys) {
  return Findings(made, logs, keys).take();
}

}  // namespace gaitlab::identify
