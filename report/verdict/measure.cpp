#include "report/verdict/measure.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>

#include "report/verdict/numbers/number_texts.h"

namespace gaitlab::report {

namespace {

constexpr std::string_view kMarginOf = "margin.";

/// Margin of a check as a quantity. A check without a margin has -1 if it fails, if it warns and cannot fail, or if evidence is
/// missing; otherwise NaN, because it does not apply to the run.
double margin(const Check& check) {
  if (!std::isnan(check.margin)) return check.status == CheckStatus::pass ? std::max(0.0, check.margin) : check.margin;
  const auto kind = std::ranges::find_if(check_kinds(), [&](const CheckKind& one) { return one.id == check.id; });
  const bool beyond = check.status == (kind->can_fail() ? CheckStatus::fail : CheckStatus::warn);
  const bool missing = check.id == "evidence" && check.status != CheckStatus::pass;
  return beyond || missing ? -1 : std::nan("");
}

double margin_against(const Check& check, double limit) {
  if (!check.criteria.empty()) return check.margin_of(limit);
  return Criterion{check.value, limit, check.unit, check.least}.margin();
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
    if (!name.starts_with(kMarginOf)) return {};
    found.check_ = name.substr(kMarginOf.size());
    if (const std::size_t open = found.check_.find('['); open != std::string::npos && found.check_.ends_with(']')) {
      double limit = 0;
      const char* const end = found.check_.data() + found.check_.size() - 1;
      const auto [read, failure] = std::from_chars(found.check_.data() + open + 1, end, limit);
      if (failure != std::errc() || read != end) return {};
      found.limit_ = limit;
      found.check_.resize(open);
    }
    const auto known = [&](const CheckKind& kind) { return found.check_ == kind.id; };
    if (std::ranges::none_of(check_kinds(), known)) return {};
    return found;
  }
  /// True if the quantity needs more than Loads::judged.
  [[nodiscard]] bool of_all_loads() const {
    const auto kind = std::ranges::find_if(check_kinds(), [&](const CheckKind& k) { return check_ == k.id; });
    return limit_ && kind->of_all_loads;
  }
  [[nodiscard]] double value(const Verdict& verdict) const {
    if (whole_ == "feasible") return verdict.word == Word::feasible ? 1 : 0;
    if (whole_ == "margin") return verdict.tightest() == nullptr ? std::nan("") : verdict.tightest()->margin;
    const Check& check = *std::ranges::find(verdict.checks, check_, &Check::id);
    return limit_ ? margin_against(check, *limit_) : margin(check);
  }

 private:
  std::string whole_, check_;
  std::optional<double> limit_;
};

QuantityText text_of(const SummaryQuantity& quantity) { return {quantity.name, quantity.number->unit, quantity.meaning()}; }

}  // namespace

std::vector<QuantityText> common_quantities() {
  std::vector<QuantityText> all;
  for (const SummaryQuantity& quantity : quantities()) all.push_back(text_of(quantity));
  all.push_back({"feasible", "", "1 if the verdict is `feasible`, else 0."});
  all.push_back({"margin", "", "Least margin of the checks that can fail: 0 or more if none of them fails."});
  for (const CheckKind& kind : check_kinds()) {
    all.push_back(
        {std::string(kMarginOf) + kind.id, "",
         fmt::format("Margin of check {} ({}): distance to its limit as a share of the limit, negative beyond it; -1 for a "
                     "warning without a limit.",
                     kind.id, kind.definition)});
  }
  return all;
}

std::vector<QuantityText> quantities_of_joints() {
  std::vector<QuantityText> all;
  for (const SummaryNumber& number : summary_numbers()) {
    if (number.of_joint != nullptr) all.push_back({short_name(number), number.unit, number.definition});
  }
  return all;
}

std::optional<SummaryQuantity> find_quantity(const std::string& name, const Robot& robot) {
  const auto at = std::ranges::find(quantities(), name, &SummaryQuantity::name);
  if (at != quantities().end()) return *at;
  const std::size_t open = name.find('[');
  if (open == std::string::npos || !name.ends_with(']')) return {};
  const std::string joint = name.substr(open + 1, name.size() - open - 2);
  for (std::size_t j = 0; j < robot.joints.size(); ++j) {
    if (robot.joints[j].name == joint) return joint_quantity(name.substr(0, open), robot, j);
  }
  return {};
}

std::optional<QuantityText> describe_quantity(const std::string& name, const Robot& robot) {
  if (const std::optional<SummaryQuantity> found = find_quantity(name, robot)) return text_of(*found);
  if (!OfVerdict::find(name)) return {};
  for (QuantityText& one : common_quantities()) {
    if (one.name == name.substr(0, name.find('['))) return QuantityText{name, one.unit, one.meaning};
  }
  return {};
}

double margin_quantity(const std::string& name, const Check& check) {
  const std::optional<OfVerdict> found = OfVerdict::find(name);
  Verdict alone;
  alone.checks.push_back(check);
  return found && name.starts_with(std::string(kMarginOf) + check.id) ? found->value(alone) : std::nan("");
}

namespace {

/// Quantity of each column for a robot. Nothing for a column of the verdict, and for a joint that the robot does not have.
using QuantityColumns = std::vector<std::optional<SummaryQuantity>>;

QuantityColumns quantity_columns(const std::vector<std::string>& names, const Robot& robot) {
  QuantityColumns quantities;
  for (const std::string& name : names) quantities.push_back(find_quantity(name, robot));
  return quantities;
}

std::vector<std::string> names_of_joints(const Robot& robot) {
  std::vector<std::string> names;
  for (const auto& joint : robot.joints) names.push_back(joint.name);
  return names;
}

}  // namespace

RunMeasure run_measure(const std::vector<std::string>& names, const Robot& robot) {
  std::vector<std::optional<OfVerdict>> of_verdict;
  for (const std::string& name : names) of_verdict.push_back(OfVerdict::find(name));
  // The robot of another scenario may number the same joints differently.
  const auto measured = [names, usual = quantity_columns(names, robot), of_verdict, joints = names_of_joints(robot)](
                            const Scenario& of, const Recording& recording) {
    const QuantityColumns columns = names_of_joints(*of.robot) == joints ? usual : quantity_columns(names, *of.robot);
    const Summary summary = summarise(of, recording, 0);
    MeasuredRun run;
    const Verdict verdict = report::verdict(of, recording, summary, overlaps(of, recording));
    for (std::size_t k = 0; k < names.size(); ++k) {
      run.quantities.push_back(columns[k]      ? columns[k]->value({of, recording, summary})
                               : of_verdict[k] ? of_verdict[k]->value(verdict)
                                               : std::nan(""));
    }
    run.verdict = verdict.word;
    run.why = verdict.why();
    run.check = verdict.decided_by;
    const auto decisive = std::ranges::find(verdict.checks, verdict.decided_by, &Check::id);
    if (decisive != verdict.checks.end()) run.part = decisive->worst;
    return run;
  };
  Records reads = kVerdictReads;
  if (std::ranges::any_of(of_verdict, [](const std::optional<OfVerdict>& one) { return one && one->of_all_loads(); }))
    reads.loads = Loads::recorded;
  return {measured, reads};
}

}  // namespace gaitlab::report
