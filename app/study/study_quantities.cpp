#include "app/study/study_quantities.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "core/settings/wording.h"
#include "report/verdict/hopeless.h"
#include "report/verdict/measure.h"

namespace gaitlab::app {

namespace {

constexpr std::string_view kMargin = "margin.";

/// Checks that have no number, or whose number cannot have another limit.
constexpr std::array kUnlimited{"outcome", "evidence", "field"};

bool limited(const report::CheckKind& kind) {
  return std::ranges::find(kUnlimited, std::string_view(kind.id)) == kUnlimited.end();
}

studies::Quantity offered(report::QuantityText&& text) {
  return {std::move(text.name), std::move(text.unit), std::move(text.meaning)};
}

}  // namespace

bool depends_on_estimate(const std::string& quantity) {
  const std::string_view name = quantity.starts_with(kMargin) ? std::string_view(quantity).substr(kMargin.size()) : quantity;
  return name == "feasible" || name == "evidence" ||
         std::ranges::any_of(std::array{"torque_e", "predictable", "spread."},
                             [&](const char* begin) { return name.starts_with(begin); });
}

studies::QuantityOffer quantity_offer() {
  studies::QuantityOffer offer;
  for (report::QuantityText& text : report::common_quantities()) offer.common.push_back(offered(std::move(text)));
  for (const report::CheckKind& kind : report::check_kinds())
    offer.checks.push_back({kind.id, kind.unit, kind.definition, kind.can_fail(), limited(kind)});
  for (report::QuantityText& text : report::quantities_of_joints()) offer.of_joints.push_back(offered(std::move(text)));
  for (const report::SummaryQuantity& quantity : report::quantities()) {
    if (report::known_so_far(quantity)) offer.so_far.push_back(quantity.name);
  }
  for (const report::SummaryNumber& number : report::summary_numbers()) {
    const std::string name = number.of_joint != nullptr ? report::short_name(number) : "";
    const auto known = [&](const report::SummaryQuantity& quantity) { return quantity.name == name; };
    // False for a name like energy.electrical, which is also a number of the whole run.
    const bool own = std::ranges::none_of(report::quantities(), known);
    if (!name.empty() && own && report::known_so_far({name, &number, report::SummaryQuantity::Of::joint}))
      offer.so_far.push_back(name);
  }
  offer.value_so_far = [](const std::string& name, const std::string& joint, const Scenario& scenario,
                          const Recording& so_far) {
    const std::optional<report::SummaryQuantity> quantity =
        report::find_quantity(joint.empty() ? name : name + "[" + joint + "]", *scenario.robot);
    return quantity ? report::value_so_far(*quantity, scenario, so_far) : std::nan("");
  };
  offer.lost_so_far = [](std::span<const studies::MarginGuard> guards, const Scenario& scenario, const Recording& so_far) {
    std::vector<report::NeededMargin> needed;
    for (const studies::MarginGuard& guard : guards) needed.push_back({guard.check, guard.name, guard.least});
    report::LostCheck lost = report::lost_check(needed, scenario, so_far);
    return studies::Cause{std::move(lost.check), std::move(lost.part)};
  };
  return offer;
}

studies::Measure quantity_measure(const std::vector<studies::Quantity>& columns, const Scenario& scenario) {
  Problems problems;
  std::vector<std::string> names;
  for (const studies::Quantity& column : columns) {
    names.push_back(column.name);
    if (!report::describe_quantity(column.name, *scenario.robot))
      problems.add(SourceLocation{"study.db"}, "the quantity " + in_quotes(column.name) + " is not known to this program");
  }
  problems.raise();
  const report::RunMeasure of_run = report::run_measure(names, *scenario.robot);
  const auto measure = [measured = of_run.measured](const Scenario& of, const Recording& recording) {
    report::MeasuredRun run = measured(of, recording);
    return studies::RunMeasured{
        std::move(run.quantities), run.verdict, std::move(run.why), {std::move(run.check), std::move(run.part)}};
  };
  return {measure, of_run.reads};
}

}  // namespace gaitlab::app
