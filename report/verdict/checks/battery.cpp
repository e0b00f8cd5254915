// The checks `brownout` and `battery`: voltage and current of the supply.
#include "report/analysis/bus.h"
#include "report/verdict/checks/checked_run.h"

namespace gaitlab::report {

namespace {

constexpr const char* kNoSupply = "the scenario states no supply";
constexpr const char* kNoNumbers = "the run has no finite numbers of the supply";
constexpr const char* kSpread = "joints that start one after another, or a battery with less resistance";

/// Sets Check::first to the first time at which the bus is below `least`, and Check::first_part to the joint that was first
/// without the voltage of its command then.
void find_first(const CheckedRun& run, double least, Check& made) {
  const Trace& bus = run.record.supply;
  for (std::size_t k = 1; k < bus.rows(); ++k) {
    if (bus.at(k, kLeastVoltage) >= least && bus.at(k, kHeld) > 0) continue;
    made.first = bus.at(k, 0);
    for (std::size_t j = 0; j < run.scenario.robot->joints.size() && made.first_part.empty(); ++j) {
      const Series limited = run.record.tick(j, kVoltageLimited);
      if (k < limited.size() && limited[k] > limited[k - 1]) made.first_part = run.joint(j);
    }
    return;
  }
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
  made.value = supply.voltage - use->voltage_least;
  made.limit = supply.voltage - supply.least;
  made.source = "supply.least";
  made.from = made.to = use->least_time;
  made.status = use->held && made.value <= made.limit ? CheckStatus::pass : CheckStatus::fail;
  made.text = use->held ? fmt::format("the bus sags to {:.3g} V of {:.3g} V", use->voltage_least, supply.voltage)
                        : fmt::format("the supply cannot give what the motors take: no voltage from 0 to {:.3g} V balances",
                                      supply.voltage);
  if (made.status == CheckStatus::pass) return;
  find_first(run, supply.least, made);
  if (use->held) made.text += fmt::format(", and the electronics stop below {:.3g} V", supply.least);
  if (!made.first_part.empty()) made.text += fmt::format("; {} is the first joint without its voltage", made.first_part);
  made.remedy = kSpread;
}

void judge_current(const CheckedRun& run, Check& made) {
  const Supply& supply = run.scenario.supply;
  made.text = kNoSupply;
  const std::optional<BusUse> use = bus_use(run.record, run.summary.judged.first_row);
  if (!supply.any()) return;
  made.text = kNoNumbers;
  if (!use) return;
  made.text = "the supply states no largest current (supply.current)";
  if (!(supply.current > 0)) return;
  made.value = use->current_rms;
  made.limit = supply.current;
  made.source = "supply.current";
  made.status = graded(made.value / made.limit, run.limits().warn_share, 1);
  if (made.status == CheckStatus::pass && use->current_peak > made.limit) made.status = CheckStatus::warn;
  made.text = fmt::format("the motors take {:.3g} A RMS and at most {:.3g} A from the supply, {} of its largest current",
                          made.value, use->current_peak, texts::percent(made.value / made.limit));
}

}  // namespace

std::vector<CheckKind> checks::battery() {
  return {{"brownout", CheckGroup::motor, "V", "Supply holds its voltage",
           "largest drop of the bus below supply.voltage, at control ticks, compared with the drop to supply.least",
           "to less than supply.least, or if no voltage satisfies the law of the bus", "", CheckSpan::whole_run, "supply.least",
           kSpread, judge_voltage, false, false, false, Lost::extreme},
          {"battery", CheckGroup::motor, "A", "Supply gives the current",
           "current of the supply at control ticks of the window, RMS, compared with its largest continuous current",
           "above supply.current", "above limits.warn_share of it, or with a peak above it", CheckSpan::window,
           "supply.current", "a gentler gait, or a larger battery", judge_current, false, false, true}};
}

}  // namespace gaitlab::report
