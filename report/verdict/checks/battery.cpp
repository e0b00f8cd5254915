// The checks `brownout` and `battery`: voltage and current of the supply.
#include "report/analysis/bus.h"
#include "report/verdict/checks/checked_run.h"

namespace gaitlab::report {

namespace {

constexpr const char* kNoSupply = "the scenario states no supply";
constexpr const char* kNoNumbers = "the run has no finite numbers of the supply";
constexpr const char* kSpread = "let the joints start one after another, or take a battery with less resistance";

/// Rows of the bus in which the electronics stop.
struct Down {
  std::size_t first = 0;  ///< first such row
  double time = 0;        ///< s, duration of all
};

Down down(const Trace& bus, double least) {
  Down made;
  for (std::size_t k = 1; k < bus.rows(); ++k) {
    if (bus.at(k, kLeastVoltage) >= least && bus.at(k, kHeld) > 0) continue;
    if (made.first == 0) made.first = k;
    made.time += bus.at(k, 0) - bus.at(k - 1, 0);
  }
  return made;
}

/// Joint with the largest current in a row of ticks; "" if none has any.
std::string largest_drawer(const CheckedRun& run, std::size_t row) {
  std::string name;
  double most = 0;
  for (std::size_t j = 0; j < run.scenario.robot->joints.size(); ++j) {
    const Series current = run.record.tick(j, kCurrentPeak);
    if (row >= current.size() || !(current[row] > kLarger * most)) continue;
    most = current[row];
    name = run.joint(j);
  }
  return name;
}

void judge_voltage(const CheckedRun& run, Check& made) {
  const Supply& supply = run.scenario.supply;
  made.text = kNoSupply;
  const std::optional<BusUse> use = bus_use(run.record, 0);
  if (!supply.any()) return;
  made.text = kNoNumbers;
  if (!use) return;
  made.text = "the supply states no least voltage (supply.least)";
  if (!(supply.least > 0) && use->held) return;
  made.value = use->held ? supply.voltage - use->voltage_least : supply.voltage;
  made.limit = supply.voltage - supply.least;
  made.source = "supply.least";
  made.from = made.to = use->least_time;
  made.status = use->held && made.value <= made.limit ? CheckStatus::pass : CheckStatus::fail;
  if (!use->held) {
    made.criteria = {{made.value, made.limit, made.unit}};
    made.margin = -1;
  }
  made.text = fmt::format("the bus sags to {:.4g} V of {:.4g} V", use->voltage_least, supply.voltage);
  if (made.status == CheckStatus::pass) return;
  const Down time = down(run.record.supply, supply.least);
  made.first = run.record.supply.at(time.first, 0);
  made.first_part = largest_drawer(run, time.first);
  made.text = use->held ? fmt::format("{}, below the {:.4g} V that the electronics need for {:.3g} s, first at {:.2f} s",
                                      made.text, supply.least, time.time, made.first)
                        : fmt::format("no voltage from 0 to {:.4g} V balances supply and motors, first at {:.2f} s",
                                      supply.voltage, made.first);
  if (!made.first_part.empty()) made.text += fmt::format("; {} draws the most then", made.first_part);
  made.remedy = kSpread;
}

void judge_current(const CheckedRun& run, Check& made) {
  const Supply& supply = run.scenario.supply;
  made.text = kNoSupply;
  const std::optional<BusUse> use = bus_use(run.record, run.summary.judged.first_row);
  const std::optional<BusUse> whole = bus_use(run.record, 0);
  if (!supply.any()) return;
  made.text = kNoNumbers;
  if (!use || !whole) return;
  made.text = "the supply states no largest current (supply.current)";
  if (!(supply.current > 0)) return;
  made.value = use->current_rms;
  made.limit = supply.current;
  made.source = "supply.current";
  made.status = graded(made.value / made.limit, run.limits().warn_share, 1);
  if (made.status == CheckStatus::pass && whole->current_peak > made.limit) made.status = CheckStatus::warn;
  made.text = fmt::format("the motors take {:.3g} A RMS and at most {:.3g} A from the supply, {} of its largest current",
                          made.value, whole->current_peak, texts::percent(made.value / made.limit));
}

}  // namespace

std::vector<CheckKind> checks::battery() {
  const auto concerns = [](const Scenario& scenario) { return scenario.supply.any(); };
  return {{"brownout", CheckGroup::run, "V", "Supply holds its voltage",
           "largest drop of the bus below supply.voltage, at control ticks, compared with the drop to supply.least",
           "to less than supply.least, or if no voltage satisfies the law of the bus", "", CheckSpan::whole_run, "supply.least",
           kSpread, judge_voltage, false, false, false, Lost::extreme, concerns},
          {"battery", CheckGroup::run, "A", "Supply gives the current",
           "current of the supply at control ticks of the window, RMS, compared with its largest continuous current",
           "above supply.current", "above limits.warn_share of it, or with a peak of the whole run above it", CheckSpan::window,
           "supply.current", "a gentler gait, or a larger battery", judge_current, false, false, true, Lost::never, concerns}};
}

}  // namespace gaitlab::report
