#include "report/figures/paper/paper_panel.h"

#include <fmt/format.h>

#include <algorithm>
#include <limits>

#include "core/model/pattern.h"
#include "core/scenario/sections.h"
#include "core/settings/joint_patterns.h"
#include "core/settings/wording.h"

namespace gaitlab::report {

namespace {

constexpr double kSlack = 1e-9;  // s, tolerance, because the time of a row is a number of steps times the step

}  // namespace

void PanelSource::problem(std::vector<std::string> path, const std::string& text) const {
  path.insert(path.begin(), {"panels", std::to_string(number)});
  problems.add(recipe.place(path), text);
}

const PaperRun& PanelSource::run() const {
  const auto found = std::ranges::find(runs, panel().run, &PaperRun::name);
  return found == runs.end() ? runs.front() : *found;
}

PanelSource::Stretch PanelSource::stretch(double end) const {
  const PanelRecipe& asked = panel();
  if (asked.to > end + kSlack) {
    problem({"to"}, fmt::format("`to` is {}, beyond the end of the run at {}", with_unit(asked.to, "s"), with_unit(end, "s")));
  } else if (asked.from >= end) {
    problem({"from"},
            fmt::format("`from` is {}, not before the end of the run at {}", with_unit(asked.from, "s"), with_unit(end, "s")));
  }
  return {asked.from, asked.to > 0 ? asked.to : end};
}

RowRange PanelSource::rows(std::span<const double> time) const {
  const std::size_t before = problems.size();
  const Stretch asked = stretch(run().recording.simulated);
  const RowRange rows = rows_within(time, asked.from, asked.to);
  if (problems.size() == before && rows.last - rows.first < 2) {
    problem({panel().from > 0 ? "from" : "to"},
            fmt::format("the run has fewer than two rows from {} to {}; expected a longer interval", with_unit(asked.from, "s"),
                        with_unit(asked.to, "s")));
  }
  return rows;
}

std::vector<std::size_t> PanelSource::joints() const {
  const Robot& robot = *run().scenario.robot;
  const std::vector<std::string> names = joint_names(robot);
  std::vector<bool> chosen(names.size(), false);
  for (std::size_t k = 0; k < panel().joints.size(); ++k) {
    const std::string& pattern = panel().joints[k];
    bool any = false;
    std::string passive;
    for (std::size_t j = 0; j < names.size(); ++j) {
      const bool meant = !joints_of(pattern, {names[j]}, run().scenario.groups).empty();
      if (!meant && !glob(pattern, std::to_string(j))) continue;
      if (robot.joints[j].driven()) {
        chosen[j] = any = true;
      } else {
        passive = names[j];
      }
    }
    if (any) continue;
    problem({"joints", std::to_string(k)}, passive.empty() ? "no joint " + in_quotes(pattern) + offer(pattern, names, "joints")
                                                           : "joint " + passive + " has no motor");
  }
  std::vector<std::size_t> numbers;
  for (std::size_t j = 0; j < names.size(); ++j) {
    if (chosen[j]) numbers.push_back(j);
  }
  return numbers;
}

std::optional<JointLoad> PanelSource::load(std::size_t joint) const {
  JointLoad load{run().recording.joint(joint, "speed"), run().recording.joint(joint, "torque")};
  if (!load.speed.empty() && !load.torque.empty()) return load;
  problem({"kind"}, fmt::format("run {} has no joint.{}.{}: simulate it with trace.columns: [joint.*]", in_quotes(run().name),
                                joint, load.torque.empty() ? "torque" : "speed"));
  return {};
}

Style curve_style(std::size_t n) {
  struct Line {
    std::string_view colour, dash;
  };
  constexpr Line kLines[] = {{colour::kBlue, ""},         {colour::kVermillion, "8 3"},    {colour::kBlack, "2 2.5"},
                             {colour::kGreen, "9 3 2 3"}, {colour::kPurple, "5 2"},        {colour::kSky, "14 3"},
                             {colour::kOrange, ""},       {colour::kBlue, "2 2"},          {colour::kVermillion, ""},
                             {colour::kBlack, "8 3"},     {colour::kGreen, "14 3 2 3"},    {colour::kPurple, "2 3"},
                             {colour::kSky, ""},          {colour::kOrange, "9 3 2 3 2 3"}};
  const Line& line = kLines[n % std::size(kLines)];
  return {.stroke = line.colour, .width = 1.6, .dash = line.dash};
}

RowRange rows_within(std::span<const double> time, double from, double to) {
  RowRange rows;
  while (rows.first < time.size() && time[rows.first] < from - kSlack) ++rows.first;
  rows.last = rows.first;
  while (rows.last < time.size() && (to <= 0 || time[rows.last] <= to + kSlack)) ++rows.last;
  return rows;
}

std::vector<double> row_times(const Recording& recording) {
  std::vector<double> time(recording.rows());
  for (std::size_t row = 0; row < time.size(); ++row) time[row] = recording.trace.at(row, 0);
  return time;
}

Trace data_table(const std::vector<DataColumn>& columns) {
  Trace table;
  std::size_t rows = 0;
  for (const DataColumn& column : columns) {
    table.columns.push_back({column.name, {}, {}});
    rows = std::max(rows, column.values.size());
  }
  for (std::size_t row = 0; row < rows; ++row) {
    for (const DataColumn& column : columns)
      table.values.push_back(row < column.values.size() ? column.values[row] : std::numeric_limits<double>::quiet_NaN());
  }
  return table;
}

std::string with_unit_after(const std::string& name, const std::string& unit) {
  return unit.empty() ? name : name + " [" + unit + "]";
}

double regular_width(std::string_view text, double size) { return print_width(text, size); }

Axis time_axis(double from, double to) { return {.ticks = ticks_within(from, to, 8), .title = "time (s)"}; }

double texts_beside(const Ticks& ticks) { return 8 + widest_text(ticks, kPrint.text, regular_width); }

double legend_head(std::span<const LegendEntry> entries, const Edges& edges) {
  return entries.empty() ? 8 : draw_legend(nullptr, entries, edges.left, edges.right, 13, kPrintLegend) + 11;
}

void draw_legend_above(Canvas& canvas, std::span<const LegendEntry> entries, const PlotArea& area) {
  const double head = legend_head(entries, {area.left, area.right});
  draw_legend(&canvas, entries, area.left, area.right, area.top - head + 13, kPrintLegend);
}

}  // namespace gaitlab::report
