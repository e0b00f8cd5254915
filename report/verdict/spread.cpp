#include "report/verdict/spread.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "core/simulation/batch.h"
#include "report/analysis/collisions.h"
#include "report/verdict/number_texts.h"
#include "report/verdict/trust.h"

namespace gaitlab::report {

namespace {

/// A rollout: its recording, and the results computed from it.
struct Rolled {
  const Recording& record;
  const Summary& summary;
  const Verdict& verdict;
};

double largest(const Recording& record, double JointStatistics::*member) {
  double most = 0;
  for (const JointStatistics& joint : record.joints) most = std::max(most, joint.*member);
  return most;
}

struct SpreadColumn {
  Column column;
  double (*value)(const Rolled& run);
};
const std::array kSpreadColumns{
    SpreadColumn{{"torque_peak", "N m", "largest motor torque of all joints"},
                 [](const Rolled& run) { return largest(run.record, &JointStatistics::torque_peak); }},
    SpreadColumn{{"torque_rms", "N m", "largest RMS of a motor torque of all joints"},
                 [](const Rolled& run) { return largest(run.record, &JointStatistics::torque_rms); }},
    SpreadColumn{{"distance", "m", "travel of the centre of mass"}, [](const Rolled& run) { return run.summary.distance; }},
    SpreadColumn{
        {kLeastMargin, "", "least margin of the checks that can fail"},
        [](const Rolled& run) { return run.verdict.tightest() == nullptr ? std::nan("") : run.verdict.tightest()->margin; }},
};

void add_row(const Rolled& run, Trace& to) {
  for (const SpreadColumn& one : kSpreadColumns) to.values.push_back(one.value(run));
  for (const Check& check : run.verdict.checks) to.values.push_back(check.margin);
}

}  // namespace

std::string margin_column(const std::string& check) { return "margin." + check; }

Trace spread(const Scenario& scenario, const Recording& record, const Summary& summary, const Verdict& verdict,
             std::atomic<bool>& stop) {
  const Predictability found = predictability(scenario, record);
  if (!record.outcome.done() || (found != Predictability::chaotic && found != Predictability::ill)) return {};
  const double by = found == Predictability::chaotic ? 1e-9 : 1e-6;
  Trace made;
  for (const SpreadColumn& one : kSpreadColumns) made.columns.push_back(one.column);
  for (const Check& check : verdict.checks)
    made.columns.push_back({margin_column(check.id), "", "margin of the verdict's check"});
  add_row({record, summary, verdict}, made);
  std::vector<Scenario> others(3, scenario);
  others[0].physics.gravity *= 1 + by;
  others[1].physics.gravity *= 1 - by;
  others[2].physics.refine(2);
  for (Scenario& other : others) {
    other.physics.estimate = Estimate::off;
    other.physics.estimated_by_others = true;
  }
  std::vector<Recording> records(others.size());
  bool began = true;
  const auto keep = [&](std::size_t k, RolloutEnd&& end) {
    began = began && end.refused.empty();
    records.at(k) = std::move(end.recording);
  };
  if (!run_all(others, {}, {Loads::recorded, false}, stop, keep) || !began) return {};
  for (std::size_t k = 0; k < others.size(); ++k) {
    const Summary own = summarise(others[k], records.at(k), 0);
    const Verdict judged = report::verdict(others[k], records.at(k), own, overlaps(others[k], records.at(k)));
    add_row({records.at(k), own, judged}, made);
  }
  return made;
}

std::string spread_text(const Trace& spread) {
  if (spread.rows() == 0) return "";
  const auto text = [&](const char* column, auto shown) {
    const std::optional<Between> found = between(spread, column);
    if (!found) return std::string("no number");
    const std::string low = shown(found->low);
    const std::string high = shown(found->high);
    return low == high ? low : low + " to " + high;
  };
  const auto torque = [](double value) { return fmt::format("{:.3g}", value); };
  return fmt::format(
      "of {} rollouts that differ by next to nothing the torque peaks at {} N m (RMS {}), the travel is {}, the least margin "
      "{}",
      spread.rows(), text("torque_peak", torque), text("torque_rms", torque), text("distance", texts::length),
      text(kLeastMargin, texts::percent));
}

std::optional<Between> between(const Trace& spread, const std::string& column) {
  const std::size_t at = spread.find(column);
  if (at == spread.columns.size() || spread.rows() == 0) return {};
  Between found{spread.at(0, at), spread.at(0, at)};
  for (std::size_t row = 0; row < spread.rows(); ++row) {
    const double value = spread.at(row, at);
    if (std::isnan(value)) return {};
    found = {std::min(found.low, value), std::max(found.high, value)};
  }
  return found;
}

}  // namespace gaitlab::report
