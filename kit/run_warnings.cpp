#include "kit/run_warnings.h"

#include <fmt/format.h>

#include "core/settings/wording.h"
#include "report/verdict/numbers/summary_text.h"
#include "report/verdict/trust.h"

namespace gaitlab::kit {

std::vector<report::Warning> start_warnings(const Scenario& scenario) {
  std::vector<report::Warning> all;
  if (const std::string warning = report::start_warning(scenario); !warning.empty())
    all.push_back({scenario.on_ground ? SourceLocation{scenario.file} : scenario.place("robot.position"), warning});
  for (report::Warning& doubt : report::setup_warnings(scenario)) all.push_back(std::move(doubt));
  return all;
}

std::vector<report::Warning> run_warnings(const Scenario& scenario, const Recording& recording,
                                          const report::Verdict& verdict) {
  if (!verdict.unstable.empty()) {
    const std::string text = verdict.unstable + "; take smaller gains, or a shorter controller.period";
    return {{scenario.nearest_place("controller.Kp"), text}};
  }
  std::vector<report::Warning> all;
  for (const report::Check& check : verdict.checks) {
    if (check.status == report::CheckStatus::pass || check.remedy.empty()) continue;
    // In a run that ended early, the checks of accuracy only show its failure.
    if (check.group == report::CheckGroup::trust && !recording.outcome.done()) continue;
    all.push_back({check.place, check.text + "; " + check.remedy});
  }
  if (const std::vector<std::string> names = report::not_finite(scenario, recording); !names.empty()) {
    all.push_back({SourceLocation{scenario.file},
                   fmt::format("the results for {} are not finite (printed as -, null in summary.json); check masses, lengths "
                               "and gains of the robot",
                               joined(names))});
  }
  return all;
}

bool needs_spread(const Scenario& scenario, const Recording& recording) {
  const report::Predictability found = report::predictability(scenario, recording);
  return found == report::Predictability::chaotic || found == report::Predictability::ill;
}

}  // namespace gaitlab::kit
