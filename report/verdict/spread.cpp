#include "report/verdict/spread.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "core/simulation/batch.h"
#include "core/simulation/step_error.h"
#include "report/analysis/collisions.h"
#include "report/verdict/numbers/number_texts.h"
#include "report/verdict/rolled.h"
#include "report/verdict/trust.h"

namespace gaitlab::report {

Trace spread(const Scenario& scenario, const Recording& record, const Summary& summary, const Verdict& verdict,
             std::atomic<bool>& stop, const std::function<void()>& ended) {
  const Predictability found = predictability(scenario, record);
  if (!record.outcome.done() || (found != Predictability::chaotic && found != Predictability::ill)) return {};
  const double by = found == Predictability::chaotic ? StepError::kChaotic : StepError::kIll;
  Trace made;
  made.columns = rolled_columns();
  const auto add = [&](const Rolled& run) {
    const std::vector<double> row = rolled_row(run);
    made.values.insert(made.values.end(), row.begin(), row.end());
  };
  add({record, summary, verdict});
  std::vector<Scenario> others(kSpread, scenario);
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
    if (ended) ended();
  };
  if (!run_all(others, {}, {Loads::recorded, false}, stop, keep) || !began) return {};
  for (std::size_t k = 0; k < others.size(); ++k) {
    const Summary own = summarise(others[k], records.at(k), 0);
    const Verdict judged = report::verdict(others[k], records.at(k), own, overlaps(others[k], records.at(k)));
    add({records.at(k), own, judged});
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
      "in {} rollouts that differ by next to nothing, the torque peaks at {} N m (RMS {}), the travel is {} and the least "
      "margin is {}",
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
