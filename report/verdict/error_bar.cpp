#include "report/verdict/error_bar.h"

#include <fmt/format.h>

#include <tuple>

#include "core/scenario/scenario.h"
#include "report/verdict/numbers/number_texts.h"
#include "report/verdict/trust.h"

namespace gaitlab::report {

void widen(const Scenario& scenario, std::span<const ErrorBar> bars, Check& made) {
  for (const ErrorBar& bar : bars) {
    if (bar.part == made.worst) made.error = bar.error;
  }
  made.certain = certain(bars);
  if (!too_close(bars)) return;
  const auto reach = [&](const ErrorBar& bar) { return std::tuple(bar.across(), bar.part == made.worst, bar.most); };
  const ErrorBar& named = *std::ranges::max_element(bars, {}, reach);
  std::string range = fmt::format("{} to {}", texts::percent(named.least), texts::percent(named.most));
  if (texts::percent(named.least) == texts::percent(named.most)) range = "slightly less or slightly more than 100 %";
  made.status = CheckStatus::too_close;
  made.text += named.part == made.worst
                   ? fmt::format("; with the error of the torques, this is {} of the limit", range)
                   : fmt::format("; joint {} takes, with the error of its torque, {} of its limit", named.part, range);
  const double error = std::max(named.error, scenario.limits.most_torque_error());
  made.remedy = "take " + torque_remedy(scenario, error);
  made.retry = finer_setting(scenario, error);
}

}  // namespace gaitlab::report
