// Warnings that the program prints after a run, for tests of their texts.
#pragma once
#include <string>
#include <vector>

#include "report/verdict/verdict.h"
#include "tests/program/fixture.h"

namespace gaitlab::test {

enum class About { all, gait, accuracy };

/// Texts and remedies of the checks that do not pass and have a remedy.
inline std::vector<std::string> messages(const Scenario& scenario, const Recording& record, About about = About::all) {
  const report::Verdict made =
      report::verdict(scenario, record, report::summarise(scenario, record, 0), report::overlaps(scenario, record));
  std::vector<std::string> texts;
  for (const report::Check& check : made.checks) {
    const bool accuracy = check.group == report::CheckGroup::trust;
    if (check.status == report::CheckStatus::pass || check.remedy.empty()) continue;
    if (about == About::all || (about == About::accuracy) == accuracy) texts.push_back(check.text + "; " + check.remedy);
  }
  return texts;
}

}  // namespace gaitlab::test
