#include "app/study/study_figures.h"

#include <algorithm>
#include <cmath>

#include "core/settings/wording.h"
#include "report/verdict/figures.h"
#include "report/verdict/verdict.h"

namespace gaitlab::app {

namespace {

/// The verdict as a number, so that a search knows where it fails, and by how much.
constexpr const char* kExcess = "verdict_excess";

double verdict_excess(const report::Verdict& verdict) {
  const auto known = [](const report::Check& check) {
    return check.status == report::CheckStatus::fail ||
           (check.group == report::CheckGroup::motor && check.status != report::CheckStatus::not_judged);
  };
  if (std::ranges::none_of(verdict.checks, known)) return std::nan("");
  constexpr double kLeast = 1e-6;  // of a check that fails at its limit
  double sum = 0;
  for (const report::Check& check : verdict.checks) {
    if (check.status != report::CheckStatus::fail) continue;
    const double beyond = std::abs(check.value - check.limit) / (check.limit == 0 ? 1 : std::abs(check.limit));
    sum += std::isfinite(beyond) ? std::max(beyond, kLeast) : 1;
  }
  return sum;
}

studies::FigureName offered(const report::Figure& figure) { return {figure.name, figure.number->unit, figure.meaning()}; }

std::optional<report::Figure> find_figure(const std::string& name, const Robot& robot) {
  const auto at = std::ranges::find(report::figures(), name, &report::Figure::name);
  if (at != report::figures().end()) return *at;
  const std::size_t open = name.find('[');
  if (open == std::string::npos || !name.ends_with(']')) return {};
  const std::string joint = name.substr(open + 1, name.size() - open - 2);
  for (std::size_t j = 0; j < robot.joints.size(); ++j) {
    if (robot.joints[j].name == joint) return report::joint_figure(name.substr(0, open), robot, j);
  }
  return {};
}

}  // namespace

studies::FigureOffer figure_offer() {
  studies::FigureOffer offer;
  for (const report::Figure& figure : report::figures()) offer.common.push_back(offered(figure));
  offer.common.push_back(
      {kExcess, "",
       "Sum over the checks of the verdict that fail of how far each is beyond its limit, as a share of the limit; 0: none "
       "fails."});
  for (const report::SummaryNumber& number : report::summary_numbers()) {
    if (number.of_joint != nullptr) offer.of_joints.push_back({report::short_name(number), number.unit, number.definition});
  }
  for (const report::Figure& figure : report::figures()) {
    if (report::known_so_far(figure)) offer.so_far.push_back(figure.name);
  }
  for (const report::SummaryNumber& number : report::summary_numbers()) {
    const std::string name = number.of_joint != nullptr ? report::short_name(number) : "";
    const auto known = [&](const report::Figure& figure) { return figure.name == name; };
    const bool own = std::ranges::none_of(report::figures(), known);  // energy.electrical of a joint
    if (!name.empty() && own && report::known_so_far({name, &number, report::Figure::Of::joint})) offer.so_far.push_back(name);
  }
  offer.value_so_far = [](const std::string& name, const std::string& joint, const Scenario& scenario,
                          const Recording& so_far) {
    const std::optional<report::Figure> figure = find_figure(joint.empty() ? name : name + "[" + joint + "]", *scenario.robot);
    return figure ? report::value_so_far(*figure, scenario, so_far) : std::nan("");
  };
  return offer;
}

namespace {

/// Of a robot, by column; none: of the verdict, or of a joint that it does not have.
using FigureColumns = std::vector<std::optional<report::Figure>>;

FigureColumns figure_columns(const std::vector<studies::FigureName>& columns, const Robot& robot) {
  FigureColumns figures;
  for (const studies::FigureName& column : columns) figures.push_back(find_figure(column.name, robot));
  return figures;
}

std::vector<std::string> names_of_joints(const Robot& robot) {
  std::vector<std::string> names;
  for (const auto& joint : robot.joints) names.push_back(joint.name);
  return names;
}

}  // namespace

studies::Measure figure_measure(const std::vector<studies::FigureName>& columns, const Scenario& scenario) {
  const FigureColumns usual = figure_columns(columns, *scenario.robot);
  Problems problems;
  for (std::size_t k = 0; k < columns.size(); ++k) {
    if (!usual[k] && columns[k].name != kExcess)
      problems.add(SourceLocation{"study.db"}, "the figure " + in_quotes(columns[k].name) + " is not known to this program");
  }
  problems.raise();
  // Another robot, of another scenario of the study, may have the same joints under other numbers.
  return [columns, usual, joints = names_of_joints(*scenario.robot)](const Scenario& of, const Recording& recording) {
    const FigureColumns figures = names_of_joints(*of.robot) == joints ? usual : figure_columns(columns, *of.robot);
    const report::Summary summary = report::summarise(of, recording, 0);
    studies::Judged judged;
    const report::Verdict verdict = report::verdict(of, recording, summary, report::overlaps(of, recording));
    for (std::size_t k = 0; k < columns.size(); ++k) {
      const bool excess = columns[k].name == kExcess;
      judged.figures.push_back(figures[k] ? figures[k]->value({of, recording, summary})
                               : excess   ? verdict_excess(verdict)
                                          : std::nan(""));
    }
    judged.verdict = name_of(verdict.word);
    return judged;
  };
}

}  // namespace gaitlab::app
