#include "app/study/study_quantities.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "core/settings/wording.h"
#include "report/verdict/number_texts.h"
#include "report/verdict/quantities.h"
#include "report/verdict/verdict.h"
#include "studies/study/number.h"

namespace gaitlab::app {

namespace {

constexpr std::string_view kMargin = "margin.";

/// Checks that have no number, or whose number cannot have another limit.
constexpr std::array kUnlimited{"outcome", "battery", "evidence", "field"};

bool limited(const report::CheckKind& kind) {
  return std::ranges::find(kUnlimited, std::string_view(kind.id)) == kUnlimited.end();
}

/// Margin of a check as a quantity. A check without a margin has -1 if it fails, if it warns and cannot fail, or if evidence is
/// missing; otherwise NaN, because it does not apply to the run.
double margin(const report::Check& check) {
  if (!std::isnan(check.margin)) return check.status == report::CheckStatus::pass ? std::max(0.0, check.margin) : check.margin;
  const auto kind =
      std::ranges::find_if(report::check_kinds(), [&](const report::CheckKind& one) { return one.id == check.id; });
  const bool beyond = check.status == (kind->can_fail() ? report::CheckStatus::fail : report::CheckStatus::warn);
  const bool missing = check.id == "evidence" && check.status != report::CheckStatus::pass;
  return beyond || missing ? -1 : std::nan("");
}

double margin_against(const report::Check& check, double limit) {
  if (!check.criteria.empty()) return check.margin_of(limit);
  return report::Criterion{check.value, limit, check.unit, check.least}.margin();
}

/// A quantity that is computed from the verdict: `feasible`, `margin`, `margin.ID`, `margin.ID[LIMIT]`.
class OfVerdict {
 public:
  static std::optional<OfVerdict> find(const std::string& name) {
    OfVerdict found;
    if (name == "feasible" || name == "margin") {
      found.whole_ = name;
      return found;
    }
    if (!name.starts_with(kMargin)) return {};
    found.check_ = name.substr(kMargin.size());
    if (const std::size_t open = found.check_.find('['); open != std::string::npos && found.check_.ends_with(']')) {
      found.limit_ = studies::number_of(found.check_.substr(open + 1, found.check_.size() - open - 2));
      found.check_.resize(open);
    }
    const auto known = [&](const report::CheckKind& kind) { return found.check_ == kind.id; };
    if (std::ranges::none_of(report::check_kinds(), known)) return {};
    return found;
  }
  /// True if the quantity needs more than Loads::judged.
  [[nodiscard]] bool of_all_loads() const {
    const auto kind = std::ranges::find_if(report::check_kinds(), [&](const report::CheckKind& k) { return check_ == k.id; });
    return limit_ && kind->of_all_loads;
  }
  [[nodiscard]] double value(const report::Verdict& verdict) const {
    if (whole_ == "feasible") return verdict.word == report::Word::feasible ? 1 : 0;
    if (whole_ == "margin") return verdict.tightest() == nullptr ? std::nan("") : verdict.tightest()->margin;
    const report::Check& check = *std::ranges::find(verdict.checks, check_, &report::Check::id);
    return limit_ ? margin_against(check, *limit_) : margin(check);
  }

 private:
  std::string whole_, check_;
  std::optional<double> limit_;
};

void offer_verdict(studies::QuantityOffer& offer) {
  offer.common.push_back({"feasible", "", "1 if the verdict is `feasible`, else 0."});
  offer.common.push_back({"margin", "", "Least margin of the checks that can fail: 0 or more where all are kept."});
  for (const report::CheckKind& kind : report::check_kinds()) {
    offer.common.push_back({std::string(kMargin) + kind.id, "",
                            fmt::format("Margin of check {} ({}): room to its limit as a share of the limit, negative beyond "
                                        "it; -1 of a warning without a limit.",
                                        kind.id, kind.definition)});
    offer.checks.push_back({kind.id, kind.unit, kind.definition, kind.can_fail(), limited(kind)});
  }
}

studies::Quantity offered(const report::Quantity& quantity) {
  return {quantity.name, quantity.number->unit, quantity.meaning()};
}

std::optional<report::Quantity> find_quantity(const std::string& name, const Robot& robot) {
  const auto at = std::ranges::find(report::quantities(), name, &report::Quantity::name);
  if (at != report::quantities().end()) return *at;
  const std::size_t open = name.find('[');
  if (open == std::string::npos || !name.ends_with(']')) return {};
  const std::string joint = name.substr(open + 1, name.size() - open - 2);
  for (std::size_t j = 0; j < robot.joints.size(); ++j) {
    if (robot.joints[j].name == joint) return report::joint_quantity(name.substr(0, open), robot, j);
  }
  return {};
}

}  // namespace

bool depends_on_estimate(const std::string& quantity) {
  const std::string_view name = quantity.starts_with(kMargin) ? std::string_view(quantity).substr(kMargin.size()) : quantity;
  return name == "feasible" || name == "evidence" ||
         std::ranges::any_of(std::array{"torque_e", "predictable", "spread."},
                             [&](const char* begin) { return name.starts_with(begin); });
}

bool is_gone(const std::string& quantity) { return quantity == "verdict_excess"; }

studies::QuantityOffer quantity_offer() {
  studies::QuantityOffer offer;
  for (const report::Quantity& quantity : report::quantities()) offer.common.push_back(offered(quantity));
  offer_verdict(offer);
  for (const report::SummaryNumber& number : report::summary_numbers()) {
    if (number.of_joint != nullptr) offer.of_joints.push_back({report::short_name(number), number.unit, number.definition});
  }
  for (const report::Quantity& quantity : report::quantities()) {
    if (report::known_so_far(quantity)) offer.so_far.push_back(quantity.name);
  }
  for (const report::SummaryNumber& number : report::summary_numbers()) {
    const std::string name = number.of_joint != nullptr ? report::short_name(number) : "";
    const auto known = [&](const report::Quantity& quantity) { return quantity.name == name; };
    // False for a name like energy.electrical, which the whole run has too.
    const bool own = std::ranges::none_of(report::quantities(), known);
    if (!name.empty() && own && report::known_so_far({name, &number, report::Quantity::Of::joint}))
      offer.so_far.push_back(name);
  }
  offer.value_so_far = [](const std::string& name, const std::string& joint, const Scenario& scenario,
                          const Recording& so_far) {
    const std::optional<report::Quantity> quantity =
        find_quantity(joint.empty() ? name : name + "[" + joint + "]", *scenario.robot);
    return quantity ? report::value_so_far(*quantity, scenario, so_far) : std::nan("");
  };
  return offer;
}

namespace {

/// Quantity of each column for a robot. Nothing for a column of the verdict, and for a joint that the robot does not have.
using QuantityColumns = std::vector<std::optional<report::Quantity>>;

QuantityColumns quantity_columns(const std::vector<studies::Quantity>& columns, const Robot& robot) {
  QuantityColumns quantities;
  for (const studies::Quantity& column : columns) quantities.push_back(find_quantity(column.name, robot));
  return quantities;
}

std::vector<std::string> names_of_joints(const Robot& robot) {
  std::vector<std::string> names;
  for (const auto& joint : robot.joints) names.push_back(joint.name);
  return names;
}

/// The deciding check and its part, as in `voltage of m5/passive`; the word of a verdict without one.
std::string cause(const report::Verdict& verdict) {
  const auto decisive = std::ranges::find(verdict.checks, verdict.decided_by, &report::Check::id);
  if (decisive == verdict.checks.end()) return name_of(verdict.word);
  const std::string check = report::texts::spaced(decisive->id);
  return decisive->worst.empty() ? check : fmt::format("{} of {}", check, decisive->worst);
}

}  // namespace

studies::Measure quantity_measure(const std::vector<studies::Quantity>& columns, const Scenario& scenario) {
  const QuantityColumns usual = quantity_columns(columns, *scenario.robot);
  Problems problems;
  for (std::size_t k = 0; k < columns.size(); ++k) {
    if (!usual[k] && !OfVerdict::find(columns[k].name) && !is_gone(columns[k].name))
      problems.add(SourceLocation{"study.db"}, "the quantity " + in_quotes(columns[k].name) + " is not known to this program");
  }
  problems.raise();
  std::vector<std::optional<OfVerdict>> of_verdict;
  for (const studies::Quantity& column : columns) of_verdict.push_back(OfVerdict::find(column.name));
  // The robot of another scenario of the study may have the same joints with other numbers.
  const auto measure = [columns, usual, of_verdict, joints = names_of_joints(*scenario.robot)](const Scenario& of,
                                                                                               const Recording& recording) {
    const QuantityColumns quantities = names_of_joints(*of.robot) == joints ? usual : quantity_columns(columns, *of.robot);
    const report::Summary summary = report::summarise(of, recording, 0);
    studies::Measured measured;
    const report::Verdict verdict = report::verdict(of, recording, summary, report::overlaps(of, recording));
    for (std::size_t k = 0; k < columns.size(); ++k) {
      measured.quantities.push_back(quantities[k]   ? quantities[k]->value({of, recording, summary})
                                    : of_verdict[k] ? of_verdict[k]->value(verdict)
                                                    : std::nan(""));
    }
    measured.verdict = name_of(verdict.word);
    measured.why = verdict.why();
    measured.cause = cause(verdict);
    return measured;
  };
  Records reads = report::kVerdictReads;
  if (std::ranges::any_of(of_verdict, [](const std::optional<OfVerdict>& one) { return one && one->of_all_loads(); }))
    reads.loads = Loads::recorded;
  return {measure, reads};
}

}  // namespace gaitlab::app
