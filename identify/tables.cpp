#include "identify/tables.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numeric>

#include "core/settings/wording.h"
#include "identify/servo_text.h"

namespace gaitlab::identify {

Rows error_rows(const Identified& made, const std::vector<BenchLog>& logs) {
  Rows rows{{"error", "", "logs", "bench", "identified"}};
  for (const Logged kind : made.kinds) {
    for (const bool held_out : {false, true}) {
      const auto before = mean_error(logs, made.before, kind, held_out);
      if (!before) continue;
      rows.push_back({logged_kinds()[static_cast<std::size_t>(kind)].key, held_out ? "held-out logs" : "fitted logs",
                      std::to_string(std::ranges::count(logs, held_out, &BenchLog::held_out)), error_text(*before, kind),
                      error_text(*mean_error(logs, made.after, kind, held_out), kind)});
    }
  }
  return rows;
}

Rows key_rows(const Identified& made, const std::vector<Key>& keys) {
  Rows rows{{"key", "value", "95 %", "unit", "bench", "error of left-out logs without it"}};
  for (const IdentifiedKey& one : made.keys) {
    const Key& key = keys[one.key];
    const std::string worth = std::isfinite(one.worth) ? fmt::format("{:+.0f} %", 100 * one.worth) : "-";
    rows.push_back({key.name, one.fitted ? number_text(one.value) : "as in the bench",
                    !one.fitted    ? "-"
                    : one.at_bound ? "at its bound"
                                   : fmt::format("{:.4g} to {:.4g}", one.low, one.high),
                    key.unit, fmt::format("{:.4g}", key.bench), worth});
  }
  return rows;
}

Rows correlation_rows(const Identified& made, const std::vector<Key>& keys) {
  const Eigen::Index count = made.correlation.rows();
  if (count < 2) return {};
  const auto known = [&](Eigen::Index k) { return made.correlation(k, k) > 0; };  // one at its bound does not vary
  const auto name = [&](Eigen::Index k) { return keys[made.best.at.keys[static_cast<std::size_t>(k)]].name; };
  Rows rows{{"key"}};
  for (Eigen::Index j = 0; j + 1 < count; ++j) rows[0].push_back(name(j));
  for (Eigen::Index i = 1; i < count; ++i) {
    std::vector<std::string>& row = rows.emplace_back(std::vector{name(i)});
    for (Eigen::Index j = 0; j + 1 < count; ++j) {
      const bool both = known(i) && known(j);
      row.push_back(j >= i ? "" : both ? fmt::format("{:.2f}", made.correlation(i, j)) : "-");
    }
  }
  return rows;
}

std::vector<std::size_t> worst_first(const Identified& made) {
  std::vector<std::size_t> order(made.after.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::ranges::stable_sort(order, std::greater<>(), [&](std::size_t l) { return error_of(made.after[l], made.kinds[0]); });
  return order;
}

Rows log_rows(const Identified& made, const std::vector<BenchLog>& logs) {
  Rows rows{{"log", "", "bench", "identified", "at the limit", "in the log"}};
  const auto text = [&](const Compared& run) { return error_text(error_of(run, made.kinds[0]), made.kinds[0]); };
  const auto share = [](const std::optional<double>& one) { return one ? fmt::format("{:.2f}", *one) : "-"; };
  for (const std::size_t l : worst_first(made)) {
    const report::LogErrors& errors = *made.after[l].errors;
    rows.push_back({logs[l].name, logs[l].held_out ? "held out" : "", text(made.before[l]), text(made.after[l]),
                    share(errors.mean(&report::JointLogErrors::at_limit)),
                    share(errors.mean(&report::JointLogErrors::measured_at_limit))});
  }
  return rows;
}

}  // namespace gaitlab::identify
