#include "report/verdict/load_checks.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/dynamics/body_tree.h"
#include "core/model/docking.h"
#include "core/model/pattern.h"
#include "report/analysis/legs.h"
#include "report/analysis/motion.h"
#include "report/analysis/motors.h"
#include "report/verdict/number_texts.h"

namespace gaitlab::report {

namespace {

constexpr double kNothing = 1e-9;  // N, N m: smaller loads are rounding
constexpr double kUnknown = std::numeric_limits<double>::quiet_NaN();
constexpr double kLeastWay = 0.01;  // m: on a shorter way the robot does not walk, and shares of slip and creep have no meaning
constexpr double kMostCreep = 0.02;

struct DockWords {
  const char *column, *unit, *does;
};

DockWords words(DockQuantity quantity) {
  switch (quantity) {
    case DockQuantity::tension:
      return {"tension", "N", "pulled apart"};
    case DockQuantity::shear:
      return {"shear", "N", "sheared"};
    case DockQuantity::bending:
      return {"bending", "N m", "bent"};
    default:
      return {"torsion", "N m", "twisted"};
  }
}

/// Rows of Recording::loads within the judged window, and the row before the window.
struct Window {
  const Trace& loads;
  std::size_t start = 0;

  /// Window that covers the whole run.
  explicit Window(const Recording& record) : loads(record.loads) {}
  /// Judged window of a run. Row indices in Recording::loads and Recording::ticks are equal.
  Window(const Recording& record, const Summary& summary)
      : loads(record.loads), start(std::min(summary.judged.first_row, std::max<std::size_t>(record.loads.rows(), 1) - 1)) {}
  [[nodiscard]] Series series(const std::string& name) const {
    const std::size_t at = loads.find(name);
    return at < loads.columns.size() && loads.rows() > 0 ? Series(loads, at) : Series();
  }
  /// Increase within the window of a sum that starts at t = 0.
  [[nodiscard]] double grown(const Series& sum) const { return sum.empty() ? kUnknown : sum.back() - sum[start]; }
  [[nodiscard]] double time(std::size_t row) const { return loads.at(row, 0); }
};

/// Reason why the loads of feet and docks are not known. Empty if they are.
std::string unknown(const Scenario& scenario, const Recording& record) {
  if (const ContactModel& contact = scenario.contact.model(); !contact.element_forces) {
    return fmt::format("not available with contact.law: {}, which yields impulses that do not all act at contact elements",
                       contact.text);
  }
  if (record.loads.rows() < 2)
    return "loads were not recorded: `gaitlab run`, `test` and `swap` record them, unless a run ends at once";
  return "";
}

std::string unknown_of_feet(const Scenario& scenario, const Recording& record) {
  if (scenario.base != Base::floating || !scenario.ground.exists()) return "judged only for a floating base on a ground";
  return unknown(scenario, record);
}

/// Largest load of a dock, its time and its limit.
struct DockPeak {
  std::size_t module = 0;
  double value = 0, time = 0, limit = kUnknown;
  double first = kUnknown;  ///< s, time when the load first exceeded the limit
  [[nodiscard]] bool limited() const { return limit > 0; }
  [[nodiscard]] double share() const { return value / limit; }
};

DockPeak peak_of(const Window& window, std::size_t module, DockQuantity quantity, double limit) {
  const Series values = window.series(fmt::format("dock.{}.{}", module, words(quantity).column));
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
  const double limit = quantity == DockQuantity::tension   ? connector.tension
                       : quantity == DockQuantity::shear   ? connector.shear
                       : quantity == DockQuantity::bending ? connector.bending
                                                           : connector.torsion;
  return limit > 0 ? limit : kUnknown;
}

/// The connector of a dock that has the smaller limit.
Connector weaker(const Robot& robot, std::size_t module, DockQuantity quantity) {
  const auto [own, parents] = connectors_at(robot, module);
  return stated(parents, quantity) < stated(own, quantity) || std::isnan(stated(own, quantity)) ? parents : own;
}

}  // namespace

std::optional<GearPeak> gear_load(const Recording& record, std::size_t joint, double limit) {
  const std::size_t column = record.loads.find(fmt::format("gear.{}.torque", joint));
  if (column == record.loads.columns.size() || record.loads.rows() == 0) return {};
  const Series torque(record.loads, column);
  const Series time(record.loads, 0);
  GearPeak peak;
  for (std::size_t row = 0; row < torque.size(); ++row) {
    const double now = std::abs(torque[row]);
    if (limit > 0 && now > limit && !peak.beyond) peak.beyond = time[row];
    if (!(now > peak.torque)) continue;
    peak.torque = now;
    peak.time = time[row];
  }
  return peak;
}

std::vector<double> dock_limits(const Robot& robot, DockQuantity quantity) {
  std::vector<double> limits;
  for (std::size_t m = 0; m < robot.modules.size(); ++m) limits.push_back(stated(weaker(robot, m, quantity), quantity));
  return limits;
}

namespace {

/// Peaks of all docks in the whole run, because an opened dock stays open.
std::vector<DockPeak> dock_peaks(const Recording& record, std::size_t modules, DockQuantity quantity,
                                 const std::vector<double>& limits) {
  const Window window(record);
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

}  // namespace

void judge_docks(const Scenario& scenario, const Recording& record, DockQuantity quantity, const std::vector<double>& limits,
                 Check& made) {
  const std::size_t modules = scenario.robot->modules.size();
  made.text = modules < 2 ? "the robot has no dock" : unknown(scenario, record);
  if (!made.text.empty()) return;
  const std::vector<DockPeak> peaks = dock_peaks(record, modules, quantity, limits);
  const DockPeak worst = take_worst(peaks, made);
  const DockWords are = words(quantity);
  if (std::isnan(worst.value) && !worst.limited()) {
    made.text = "the module types do not state what a dock holds";
    return;
  }
  made.text = worst.value > 0 ? fmt::format("{}'s dock is {} by up to {:.3g} {}", made.worst, are.does, worst.value, are.unit)
                              : fmt::format("no dock is {}", are.does);
  if (!worst.limited()) {
    made.text += "; the module types do not state what a dock holds";
    return;
  }
  made.limit = worst.limit;
  made.source = weaker(*scenario.robot, worst.module, quantity).source;
  if (made.source.empty()) made.source = kNoSource;
  made.parts = static_cast<std::size_t>(std::ranges::count_if(peaks, [](const DockPeak& p) { return p.share() > 1; }));
  made.status = worst.share() <= scenario.limits.warn_share ? CheckStatus::pass
                : worst.share() <= 1                        ? CheckStatus::warn
                                                            : CheckStatus::fail;
  const auto unstated = std::ranges::count_if(peaks, [](const DockPeak& p) { return !p.limited(); });
  made.text += fmt::format(
      ", {} of what it holds{}{}", texts::percent(std::max(0.0, worst.share())),
      chosen(made.source) ? " by a chosen figure" : "",
      unstated > 0 ? fmt::format("; {} of {} docks are not judged: what they hold is not stated", unstated, peaks.size()) : "");
}

namespace {

/// True if the robot goes that far (m) in the judged window. If it does not, the check says so and is not judged.
bool walks(double way, Check& made) {
  made.text = fmt::format("the robot goes {}: less than {} is not walking", texts::length(way), texts::length(kLeastWay));
  return way >= kLeastWay;
}

}  // namespace

void judge_slip(const Scenario& scenario, const Recording& record, const Summary& summary, Check& made) {
  made.text = unknown_of_feet(scenario, record);
  if (!made.text.empty()) return;
  const Window window(record, summary);
  const double way = window.grown(window.series("path"));
  const double slip = window.grown(window.series("slip"));
  std::vector<std::size_t> feet;  // bodies of the feet
  std::size_t worst = 0;
  double farthest = 0;
  for (const Column& column : record.loads.columns) {
    if (!glob("foot.*.slid", column.name)) continue;
    const std::string body = column.name.substr(5, column.name.size() - 10);
    const std::vector<Body>& bodies = scenario.robot->bodies;
    const auto at = static_cast<std::size_t>(std::ranges::find(bodies, body, &Body::name) - bodies.begin());
    const double slid = window.grown(window.series(column.name));
    if (at == bodies.size()) continue;
    if (slid > farthest) {
      farthest = slid;
      worst = feet.size();
      made.part = Part::foot;
      made.worst = body;
    }
    feet.push_back(at);
  }
  if (!walks(way, made)) return;
  made.value = slip / way;
  made.limit = scenario.limits.slip;
  made.status = made.value <= made.limit ? CheckStatus::pass : CheckStatus::warn;  // NaN also warns
  made.from = window.time(window.start);
  made.to = window.loads.at(window.loads.rows() - 1, 0);
  made.text = made.worst.empty() ? "no foot slides under load"
                                 : fmt::format("under load the weight slides {}, {} of the way of {}; farthest foot {}, {}",
                                               texts::length(slip), texts::percent(made.value), texts::length(way),
                                               foot_names(scenario, feet)[worst], texts::length(farthest));
}

void judge_creep(const Scenario& scenario, const Recording& record, const Summary& summary, Check& made) {
  made.text = unknown_of_feet(scenario, record);
  if (!made.text.empty()) return;
  const Window window(record, summary);
  const Motion m = motion(record);
  const double creep = std::hypot(window.grown(window.series("creep.x")), window.grown(window.series("creep.y")));
  made.text = "the run has no creep of feet, or no poses at control ticks";
  if (std::isnan(creep) || m.x.size() != window.loads.rows() || m.y.size() != m.x.size()) return;
  const double travel = std::hypot(m.x.back() - m.x[window.start], m.y.back() - m.y[window.start]);
  if (!walks(travel, made)) return;
  made.value = creep / travel;
  made.limit = kMostCreep;
  made.status = made.value <= made.limit ? CheckStatus::pass : CheckStatus::warn;
  made.from = window.time(window.start);
  made.to = window.time(window.loads.rows() - 1);
  made.text = fmt::format("feet that hold creep {}, {} of the travel of {}", texts::length(creep), texts::percent(made.value),
                          texts::length(travel));
  if (made.status == CheckStatus::warn)
    made.text += fmt::format("; contact.slip_speed: {:.3g} would halve it", scenario.contact.penalty.v_lim / 2);
}

void judge_stability(const Scenario& scenario, const Recording& record, const Summary& summary, Check& made) {
  made.text = scenario.ground.is_plane() ? unknown_of_feet(scenario, record) : "judged only on a plane without boxes";
  if (!made.text.empty()) return;
  const Window window(record, summary);
  const Series margin = window.series("stability");
  made.text = "no foot bears a load";
  std::size_t seen = 0;
  std::size_t outside = 0;
  std::size_t aloft = 0;
  for (std::size_t row = window.start + 1; row < margin.size(); ++row) {
    if (std::isnan(margin[row])) {
      ++aloft;
      continue;
    }
    ++seen;
    if (margin[row] < 0) ++outside;
    if (margin[row] >= made.value) continue;  // false if no value was found yet
    made.value = margin[row];
    made.from = made.to = window.time(row);
  }
  if (seen == 0) return;
  made.status = CheckStatus::pass;
  made.text =
      made.value >= 0 && aloft > 0
          ? fmt::format(
                "a note: no foot bears a load for {} of the time; else the centre of mass stays {} within the "
                "support polygon",
                texts::percent(static_cast<double>(aloft) / static_cast<double>(aloft + seen)), texts::length(made.value))
      : made.value >= 0
          ? fmt::format("statically stable: the centre of mass stays {} within the support polygon", texts::length(made.value))
          : fmt::format(
                "a note: the centre of mass comes {} out of the support polygon, and is out of it {} of the "
                "time on the ground, as it may be in a dynamic gait",
                texts::length(-made.value), texts::percent(static_cast<double>(outside) / static_cast<double>(seen)));
}

}  // namespace gaitlab::report
