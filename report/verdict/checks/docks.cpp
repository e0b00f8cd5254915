// The checks `dock_tension`, `dock_shear`, `dock_bending` and `dock_torsion`: the loads of docks.
#include "core/dynamics/body_tree.h"
#include "core/model/docking.h"
#include "report/verdict/checks/loads.h"

namespace gaitlab::report {

namespace {

constexpr double kNothing = 1e-9;  // N, N m; smaller loads are rounding errors

/// A load of docks, by its check.
struct DockCheck {
  const char *id, *unit, *title, *load, *does, *gentler;
  double Connector::*limit;
  [[nodiscard]] const char* column() const { return id + std::string_view("dock_").size(); }
};
constexpr const char* kSofter = "a softer landing, or stronger connectors";
constexpr const char* kFewer = "fewer modules in the air at a time, or stronger connectors";
/// The checks of docks, in the order of DockQuantity.
constexpr DockCheck kDockChecks[] = {
    {"dock_tension", "N", "Docks are not pulled apart", "tension", "pulled apart", kSofter, &Connector::tension},
    {"dock_shear", "N", "Docks do not shear", "shear force", "sheared", kSofter, &Connector::shear},
    {"dock_bending", "N m", "Docks are not bent open", "bending moment", "bent", kFewer, &Connector::bending},
    {"dock_torsion", "N m", "Docks are not twisted", "torsion moment", "twisted", kFewer, &Connector::torsion}};

const DockCheck& load_of(DockQuantity quantity) { return kDockChecks[static_cast<std::size_t>(quantity)]; }

/// Largest load of a dock, its time and its limit.
struct DockPeak {
  std::size_t module = 0;
  double value = 0, time = 0, limit = kUnknown;
  double first = kUnknown;  ///< s, time when the load first exceeded the limit
  [[nodiscard]] bool limited() const { return limit > 0; }
  [[nodiscard]] double share() const { return value / limit; }
};

DockPeak peak_of(const LoadWindow& window, std::size_t module, DockQuantity quantity, double limit) {
  const Series values = window.series(fmt::format("dock.{}.{}", module, load_of(quantity).column()));
  DockPeak peak{module, values.empty() ? kUnknown : -std::numeric_limits<double>::infinity(), kUnknown, limit};
  for (std::size_t row = window.start; row < values.size(); ++row) {
    double value = quantity == DockQuantity::tension ? values[row] : std::abs(values[row]);
    if (std::abs(value) < kNothing) value = 0;
    if (value > limit && std::isnan(peak.first)) peak.first = window.time(row);
    if (!(value > peak.value)) continue;
    peak.value = value;
    peak.time = window.time(row);
  }
  return peak;
}

double stated(const Connector& connector, DockQuantity quantity) {
  const double limit = connector.*load_of(quantity).limit;
  return limit > 0 ? limit : kUnknown;
}

/// The connector of a dock that has the smaller limit.
Connector weaker(const Robot& robot, std::size_t module, DockQuantity quantity) {
  const auto [own, parents] = connectors_at(robot, module);
  return stated(parents, quantity) < stated(own, quantity) || std::isnan(stated(own, quantity)) ? parents : own;
}

/// Peaks of all docks in the whole run, because an opened dock stays open.
std::vector<DockPeak> dock_peaks(const Recording& record, std::size_t modules, DockQuantity quantity,
                                 const std::vector<double>& limits) {
  const LoadWindow window(record);
  std::vector<DockPeak> peaks;
  for (std::size_t m = 1; m < modules; ++m)
    peaks.push_back(peak_of(window, m, quantity, m < limits.size() ? limits[m] : kUnknown));
  return peaks;
}

/// Sets the worst dock of the check, and the dock that is first beyond its limit. Returns the worst.
DockPeak take_worst(const std::vector<DockPeak>& peaks, Check& made) {
  const auto less = [](const DockPeak& a, const DockPeak& b) {
    if (a.limited() != b.limited()) return b.limited();
    return a.limited() ? a.share() < b.share() : a.value < b.value;
  };
  const DockPeak worst = *std::ranges::max_element(peaks, less);
  made.value = worst.value;
  made.from = made.to = worst.time;
  made.part = Part::dock;
  made.worst = fmt::format("m{}", worst.module);
  for (const DockPeak& peak : peaks) {
    if (made.first <= peak.first || std::isnan(peak.first)) continue;
    made.first = peak.first;
    made.first_part = fmt::format("m{}", peak.module);
  }
  return worst;
}

void judge_dock(const CheckedRun& run, Check& made) {
  const DockQuantity quantity = *dock_quantity(made.id);
  judge_docks(run.scenario, run.record, quantity, dock_limits(*run.scenario.robot, quantity), made);
  if (made.status == CheckStatus::not_judged || run.torque_errors.empty()) return;
  // All docks get the torque error of the worst joint, so that the dock with the least margin decides.
  const ErrorBar bar = ErrorBar::around(made.worst, made.value / made.limit, std::ranges::max(run.torque_errors));
  widen(run.scenario, {&bar, 1}, made);
}

}  // namespace

std::optional<DockQuantity> dock_quantity(std::string_view check) {
  const auto at = std::ranges::find(kDockChecks, check, [](const DockCheck& one) { return std::string_view(one.id); });
  return at == std::end(kDockChecks) ? std::nullopt : std::optional(static_cast<DockQuantity>(at - kDockChecks));
}

std::vector<double> dock_limits(const Robot& robot, DockQuantity quantity) {
  std::vector<double> limits;
  for (std::size_t m = 0; m < robot.modules.size(); ++m) limits.push_back(stated(weaker(robot, m, quantity), quantity));
  return limits;
}

void judge_docks(const Scenario& scenario, const Recording& record, DockQuantity quantity, const std::vector<double>& limits,
                 Check& made) {
  const std::size_t modules = scenario.robot->modules.size();
  if (left_open(made, modules < 2 ? "the robot has no dock" : unknown_loads(scenario, record))) return;
  const std::vector<DockPeak> peaks = dock_peaks(record, modules, quantity, limits);
  const DockPeak worst = take_worst(peaks, made);
  const DockCheck& is = load_of(quantity);
  if (std::isnan(worst.value) && !worst.limited()) {
    made.text = "the module types do not state the largest loads of docks";
    return;
  }
  made.text = worst.value > 0 ? fmt::format("{}'s dock is {} by up to {:.3g} {}", made.worst, is.does, worst.value, is.unit)
                              : fmt::format("no dock is {}", is.does);
  if (!worst.limited()) {
    made.text += "; the module types do not state the largest loads of docks";
    return;
  }
  made.limit = worst.limit;
  made.source = weaker(*scenario.robot, worst.module, quantity).source;
  if (made.source.empty()) made.source = kNoSource;
  made.parts = static_cast<std::size_t>(std::ranges::count_if(peaks, [](const DockPeak& p) { return p.share() > 1; }));
  made.status = graded(worst.share(), scenario.limits.warn_share, 1);
  const auto unstated = std::ranges::count_if(peaks, [](const DockPeak& p) { return !p.limited(); });
  made.text += fmt::format(
      ", {} of what it holds{}{}", texts::percent(std::max(0.0, worst.share())),
      chosen(made.source) ? " by a chosen figure" : "",
      unstated > 0 ? fmt::format("; {} of {} docks are not judged: their largest loads are not stated", unstated, peaks.size())
                   : "");
}

std::vector<CheckKind> checks::docks() {
  std::vector<CheckKind> rows;
  for (const DockCheck& one : kDockChecks) {
    rows.push_back({one.id, CheckGroup::structure, one.unit, one.title,
                    fmt::format("largest {} of a dock at control ticks, compared with its rating", one.load),
                    "above the rating", "above limits.warn_share of the rating", CheckSpan::whole_run, "robot", one.gentler,
                    judge_dock, false, true, true, Lost::extreme});
  }
  return rows;
}

}  // namespace gaitlab::report
