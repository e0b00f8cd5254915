#include "app/study/verification_text.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>
#include <utility>
#include <vector>

#include "app/study/quantity_text.h"
#include "core/settings/node.h"
#include "core/settings/wording.h"
#include "studies/study/number.h"
#include "studies/study/scenarios.h"

namespace gaitlab::app {

namespace {

using studies::TrialKind;
using studies::Verification;
using studies::WorldCount;

std::string objective_cell(const Verification& v) {
  return v.objectives.empty() || std::isnan(v.objectives.front()) ? "-" : fmt::format("{:.4g}", v.objectives.front());
}

/// Table of the winner with each joint dead in turn; "" if the study has not asked for it.
std::string faults_text(const std::vector<Verification>& faults, const std::string& objective) {
  if (faults.empty()) return "";
  std::vector<std::vector<std::string>> rows{{"joint", objective, "verdict"}};
  for (const Verification& v : faults) rows.push_back({clipped(v.what()), objective_cell(v), name_of(v.verdict)});
  return fmt::format("run {} with a joint dead from t = 0:\n{}", faults.front().run, aligned(rows, 2));
}

std::string stands_text(const WorldCount& count) {
  return fmt::format("stands in {} of {}", count.stood, counted(count.of, "world"));
}

/// Parameters of a point: `  cpg.frequency 0.275, cpg.amplitude 0.91`.
std::string values_text(studies::Journal& journal, std::uint64_t run) {
  const std::vector<std::string> row = journal.row(run);
  const std::vector<std::string> names = journal.columns().all();
  std::string text;
  for (std::size_t k = 0; k < journal.head().parameters.size() && !row.empty(); ++k) {
    const studies::JournalParameter& p = journal.head().parameters[k];
    if (p.drawn) continue;
    const std::string& value = row[studies::place_in(names, journal.columns().parameters[k])];
    text += fmt::format("{}{} {}", text.empty() ? "  " : ", ", clipped(p.key),
                        p.words ? clipped(value) : fmt::format("{:.4g}", studies::number_of(value)));
  }
  return text.empty() ? "" : text + "\n";
}

/// Least and largest objective in the worlds of a point: `, 0.0139 to 0.0146 in the worlds`. Empty without worlds.
std::string in_worlds_text(const std::vector<Verification>& all, std::uint64_t run) {
  double least = std::numeric_limits<double>::infinity();
  double most = -least;
  for (const Verification& v : all) {
    if (v.run != run || !studies::is_world(v) || v.objectives.empty() || std::isnan(v.objectives.front())) continue;
    least = std::min(least, v.objectives.front());
    most = std::max(most, v.objectives.front());
  }
  return least <= most ? fmt::format(", {:.4g} to {:.4g} in the worlds", least, most) : "";
}

/// Text on a point: its runs with their objectives, and the reasons that reject it.
std::string point_text(studies::Journal& journal, const std::vector<Verification>& all, std::uint64_t run) {
  const std::string unit = objective_unit(journal.head());
  std::string ways;
  std::string reasons;
  std::string below = values_text(journal, run);
  bool rejected = false;
  const WorldCount count = studies::counted_worlds(all, run);
  std::string share = count.of > 0 ? ", " + stands_text(count) : "";
  for (const Verification& v : all) {
    if (v.run != run || studies::is_world(v)) continue;
    rejected = rejected || !v.reason.empty();
    if (v.kind == TrialKind::worlds) {
      if (!v.reason.empty()) share = ", " + one_line(v.reason);
      continue;
    }
    ways += fmt::format("{}{} {}", ways.empty() ? "" : ", ", clipped(v.what()), objective_cell(v));
    if (!v.reason.empty())
      reasons += fmt::format("{}{}: {}", reasons.empty() ? "" : "; ", clipped(v.what()), one_line(v.reason));
    if (v.kind == TrialKind::quarter_step) {
      below +=
          "  the other engine's default step was too long at times (check step), so that its run with a quarter of that step "
          "counts\n";
    }
    if (v.kind == TrialKind::limit)
      below += fmt::format("  the gait stands; the study's step was too long: {}{}\n", objective_cell(v), unit);
  }
  if (!reasons.empty()) below += "  " + reasons + "\n";
  if (const std::string falls = falls_text(count); !falls.empty()) below += "  " + falls + "\n";
  ways += in_worlds_text(all, run);
  return fmt::format("run {} {}{} ({})\n{}", run, rejected ? "not verified" : "verified", share, ways, below);
}

/// True if the gears of the study's scenario can create energy, which those of the worlds cannot.
bool paper_gears(const studies::JournalHead& head) {
  const std::vector<studies::ScenarioText> all = studies::scenario_texts(head.scenario);
  const auto paper = [](const std::string& text) {
    Problems ignored;  // if the journal's scenario was changed, its gears are not known
    const std::optional<Node> root = parse_yaml(text, "scenario", ignored);
    const Node* actuator = root ? root->find("actuator") : nullptr;
    const Node* model = actuator == nullptr ? nullptr : actuator->find("efficiency_model");
    return model != nullptr && model->text == "paper";
  };
  return all.empty() ? paper(head.scenario) : std::ranges::any_of(all, paper, &studies::ScenarioText::text);
}

/// Guard of the check that is the first cause of a fall, as in `guards: {voltage: {margin: 0.1}}`; "" if no cause is a check.
std::string guard_text(const studies::JournalHead& head, const WorldCount& count) {
  for (const Verification& fall : count.falls) {
    const bool known =
        std::ranges::find(head.quantities, "margin." + fall.check, &studies::Quantity::name) != head.quantities.end();
    if (known) return fmt::format("a guard with a margin, `guards: {{{}: {{margin: 0.1}}}}`, or ", fall.check);
  }
  return "";
}

}  // namespace

std::string falls_text(const WorldCount& count) {
  std::vector<std::pair<std::string, std::string>> causes;  // each cause once, with its worlds
  for (const Verification& v : count.falls) {
    const auto at = std::ranges::find(causes, v.reason, [](const auto& one) { return one.first; });
    const std::string name = clipped(v.name);
    if (at == causes.end()) {
      causes.emplace_back(v.reason, name);
    } else {
      at->second += ", " + name;
    }
  }
  std::vector<std::string> falls;
  for (const auto& [cause, names] : causes) falls.push_back(fmt::format("{}: {}", names, one_line(cause)));
  if (count.fell_drawn > 0)
    falls.push_back(fmt::format("{}in {} of {}", falls.empty() ? "" : "and ", count.fell_drawn, counted(count.drawn, "draw")));
  const bool named = !count.falls.empty();
  return falls.empty() ? "" : fmt::format("falls {}{}", named ? "by " : "", fmt::join(falls, "; "));
}

std::string nearest_text(studies::Journal& journal) {
  const std::vector<Verification> all = journal.verifications();
  const auto share = std::ranges::find(all, TrialKind::worlds, &Verification::kind);
  if (share == all.end()) return "";
  const WorldCount count = studies::counted_worlds(all, share->run);
  const bool most = count.stood < count.of / 2;
  return fmt::format("run {} is nearest: it {}; {}; to search gaits with a reserve, take {}`robust: true`{}", share->run,
                     one_line(share->reason), falls_text(count), guard_text(journal.head(), count),
                     most && paper_gears(journal.head())
                         ? "; gears are directional in every world: `set: [actuator.efficiency_model=directional]` "
                           "has such gears in the search"
                         : "");
}

std::string verification_text(studies::Journal& journal) {
  std::vector<Verification> all = journal.verifications();
  std::vector<Verification> faults;
  const auto is_fault = [](const Verification& v) { return v.kind == TrialKind::dead_joint; };
  std::ranges::copy_if(all, std::back_inserter(faults), is_fault);
  std::erase_if(all, is_fault);
  std::string text;
  for (std::size_t k = 0; k < all.size(); ++k) {
    if (k == 0 || all[k].run != all[k - 1].run) text += point_text(journal, all, all[k].run);
  }
  if (!text.empty() && std::ranges::any_of(all, studies::is_world) && paper_gears(journal.head())) {
    text +=
        "  the worlds have directional gears, but the runs have the paper's, so that a run with another friction or supply can "
        "end differently from its world\n";
  }
  const std::string objective = objective_text(journal.head());
  return text.empty() ? "" : "verification of the best points (" + objective + "):\n" + text + faults_text(faults, objective);
}

}  // namespace gaitlab::app
