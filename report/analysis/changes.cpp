#include "report/analysis/changes.h"

#include <fmt/format.h>

#include "core/settings/wording.h"

namespace gaitlab::report {

namespace {

std::string text_of(const JointFault& fault) {
  std::string text = fmt::format("{} {}", fmt::join(fault.joints, " "), name_of(fault.kind));
  if (fault.kind == FaultKind::none) text = fmt::format("{} without fault", fmt::join(fault.joints, " "));
  if (fault.kind == FaultKind::weak || fault.kind == FaultKind::lost) text += fmt::format(" {:.4g} %", 100 * fault.share);
  if (fault.kind == FaultKind::late) text += fmt::format(" {} s", number_text(fault.delay));
  return text;
}

}  // namespace

std::vector<ToldChange> told_changes(const Scenario& scenario, double end) {
  std::vector<ToldChange> all;
  for (const Change& change : scenario.changes) {
    if (change.t >= end) break;
    std::vector<std::string> parts;
    for (std::size_t i = 0; i < change.set.keys.size(); ++i) {
      std::string value = print_yaml(change.set.items[i]);
      while (!value.empty() && value.back() == '\n') value.pop_back();
      parts.push_back(fmt::format("{} {}", change.set.keys[i].first, clipped(value)));
    }
    for (const JointFault& fault : change.faults) parts.push_back(text_of(fault));
    all.push_back({change.t, fmt::format("{}", fmt::join(parts, ", "))});
  }
  return all;
}

}  // namespace gaitlab::report
