// The checks `brownout` and `battery`: voltage and current of the supply.
#include <array>
#include <cmath>
#include <utility>

#include "core/scenario/buses.h"
#include "report/analysis/bus.h"
#include "report/verdict/checks/checked_run.h"

namespace gaitlab::report {

namespace {

constexpr const char* kNoSupply = "the scenario states no supply";
constexpr const char* kNoNumbers = "the run has no finite numbers of the supply";
constexpr const char* kSpread = "let the joints start one after another, or take a battery with less resistance";

/// A bus with its number in Recording::supply.
struct JudgedBus {
  const MotorBus& bus;
  std::size_t number;

  /// `supply.least`, or `battery.least` of a module type.
  [[nodiscard]] std::string key(const char* of) const {
    return fmt::format("{}.{}", bus.module.empty() ? "supply" : "battery", of);
  }
  /// " of m3", or "" for the supply of the scenario.
  [[nodiscard]] std::string of_module() const { return bus.module.empty() ? "" : " of " + bus.module; }
};

/// Rows of a bus in which the electronics stop.
struct Down {
  std::size_t first = 0;  ///< first such row
  double time = 0;        ///< s, duration of all
};

Down down(const Recording& record, const JudgedBus& of) {
  Down made;
  const Trace& rows = record.supply;
  for (std::size_t k = 1; k < rows.rows(); ++k) {
    const bool holds = record.bus(k, of.number, kHeld) > 0;
    if (record.bus(k, of.number, kLeastVoltage) >= of.bus.supply.least && holds) continue;
    if (made.first == 0) made.first = k;
    made.time += rows.at(k, 0) - rows.at(k - 1, 0);
  }
  return made;
}

/// Joint of a bus with the largest current in a row of ticks; "" if none has any.
std::string largest_drawer(const CheckedRun& run, const MotorBus& bus, std::size_t row) {
  std::string name;
  double most = 0;
  for (const std::size_t j : bus.joints) {
    const Series current = run.record.tick(j, kCurrentPeak);
    if (row >= current.size() || !(current[row] > kLarger * most)) continue;
    most = current[row];
    name = run.joint(j);
  }
  return name;
}

void judge_voltage(const CheckedRun& run, const JudgedBus& of, Check& made) {
  const Supply& supply = of.bus.supply;
  const std::optional<BusUse> use = bus_use(run.record, of.number, 0);
  made.text = kNoNumbers;
  if (!use) return;
  made.text = fmt::format("the {}{} states no least voltage ({})", of.bus.module.empty() ? "supply" : "battery", of.of_module(),
                          of.key("least"));
  if (!(supply.least > 0) && use->held) return;
  made.value = use->held ? supply.voltage - use->voltage_least : supply.voltage;
  made.limit = supply.voltage - supply.least;
  made.source = of.key("least");
  made.from = made.to = use->least_time;
  made.status = use->held && made.value <= made.limit ? CheckStatus::pass : CheckStatus::fail;
  if (!use->held) {
    made.criteria = {{made.value, made.limit, made.unit}};
    made.margin = -1;
  }
  made.text = fmt::format("the bus{} sags to {:.4g} V of {:.4g} V", of.of_module(), use->voltage_least, supply.voltage);
  if (made.status == CheckStatus::pass) return;
  const Down time = down(run.record, of);
  made.first = run.record.supply.at(time.first, 0);
  made.first_part = largest_drawer(run, of.bus, time.first);
  made.text = use->held
                  ? fmt::format("{}, below the {:.4g} V that the electronics need for {:.3g} s, first at {:.2f} s", made.text,
                                supply.least, time.time, made.first)
                  : fmt::format("no voltage from 0 to {:.4g} V balances {}{} and motors, first at {:.2f} s", supply.voltage,
                                of.bus.module.empty() ? "supply" : "the battery", of.of_module(), made.first);
  if (!made.first_part.empty()) made.text += fmt::format("; {} draws the most then", made.first_part);
  made.remedy = kSpread;
}

void judge_current(const CheckedRun& run, const JudgedBus& of, Check& made) {
  const Supply& supply = of.bus.supply;
  const std::optional<BusUse> use = bus_use(run.record, of.number, run.summary.judged.first_row);
  const std::optional<BusUse> whole = bus_use(run.record, of.number, 0);
  made.text = kNoNumbers;
  if (!use || !whole) return;
  made.text = fmt::format("the {}{} states no largest current ({})", of.bus.module.empty() ? "supply" : "battery",
                          of.of_module(), of.key("current"));
  if (!(supply.current > 0)) return;
  made.value = use->current_rms;
  made.limit = supply.current;
  made.source = of.key("current");
  made.status = graded(made.value / made.limit, run.limits().warn_share, 1);
  if (made.status == CheckStatus::pass && whole->current_peak > made.limit) made.status = CheckStatus::warn;
  made.text = fmt::format("the motors{} take {:.3g} A RMS and at most {:.3g} A from the {}, {} of its largest current",
                          of.of_module(), made.value, whole->current_peak, of.bus.module.empty() ? "supply" : "battery",
                          texts::percent(made.value / made.limit));
}

/// Judges each bus, and keeps the result of the worst.
template <void (*kJudge)(const CheckedRun&, const JudgedBus&, Check&)>
void judge_buses(const CheckedRun& run, Check& made) {
  const std::vector<MotorBus> all = buses(run.scenario);
  made.text = kNoSupply;
  const auto rank = [](const Check& of) {
    const double beyond = of.value / of.limit;
    constexpr std::array kOrder{CheckStatus::not_judged, CheckStatus::pass, CheckStatus::warn, CheckStatus::fail};
    return std::pair(std::ranges::find(kOrder, of.status) - kOrder.begin(), std::isnan(beyond) ? 0 : beyond);
  };
  const Check before = made;
  for (std::size_t number = 0; number < all.size(); ++number) {
    Check one = before;
    kJudge(run, {all[number], number}, one);
    if (number == 0 || rank(one) > rank(made)) made = one;
  }
}

}  // namespace

std::vector<CheckKind> checks::battery() {
  const auto concerns = [](const Scenario& scenario) { return !buses(scenario).empty(); };
  return {{"brownout", CheckGroup::run, "V", "Supply holds its voltage",
           "largest drop of the bus below supply.voltage, at control ticks, compared with the drop to supply.least",
           "to less than supply.least, or if no voltage satisfies the law of the bus", "", CheckSpan::whole_run, "supply.least",
           kSpread, judge_buses<judge_voltage>, false, false, false, Lost::extreme, concerns},
          {"battery", CheckGroup::run, "A", "Supply gives the current",
           "current of the supply at control ticks of the window, RMS, compared with its largest continuous current",
           "above supply.current", "above limits.warn_share of it, or with a peak of the whole run above it", CheckSpan::window,
           "supply.current", "a gentler gait, or a larger battery", judge_buses<judge_current>, false, false, true, Lost::never,
           concerns}};
}

}  // namespace gaitlab::report
