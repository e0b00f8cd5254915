// Panel kinds `footfalls` and `views`, which show the footfall diagram and views of the robot.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "core/scenario/sections.h"
#include "core/settings/joint_patterns.h"
#include "core/settings/wording.h"
#include "report/figures/paper/paper_panel.h"
#include "report/figures/run/run_footfalls.h"
#include "report/figures/run/run_views.h"

namespace gaitlab::report {

namespace {

class FootfallsOfPanel final : public PaperPanel {
 public:
  explicit FootfallsOfPanel(const PanelSource& source) {
    const PaperRun& run = source.run();
    const std::vector<Leg> legs = legs_that_walk(run.scenario);
    const std::vector<double> time = row_times(run.recording);
    if (legs.empty() || time.empty()) {
      source.problem({"kind"}, "footfalls need a robot with legs (docs/modules.md), and a run with rows");
      return;
    }
    if (const std::string lacks = loads_of(run.scenario, run.recording, legs).lacks; !lacks.empty()) {
      source.problem({"kind"},
                     fmt::format("run {} lacks column {}, which shows the stance of a leg", in_quotes(run.name), lacks));
      return;
    }
    const std::size_t before = source.problems.size();
    const PanelSource::Stretch shown = source.stretch(time.back());
    if (source.problems.size() > before) return;
    from_ = shown.from;
    to_ = shown.to;
    rows_ = footfalls(run.scenario, run.recording, legs, time, from_);
    for (Footfall& row : rows_) {
      row.duty_factor = duty_factor(row.stances, from_, to_);
      std::erase_if(row.stances, [&](const Stance& s) { return s.to <= from_ || s.from >= to_; });
    }
  }

  [[nodiscard]] Margins margins() const override {
    double names = 0;
    for (const Footfall& row : rows_) names = std::max(names, print_width(row.name, 13));
    return {11 + names, 8 + text_width("0.00", 13) + 1};  // widths as in draw_footfalls
  }
  [[nodiscard]] double head(const Edges&) const override { return kFootfallHead; }
  [[nodiscard]] double body(const Edges&) const override {
    return footfall_height(rows_.size()) - kFootfallHead - kFootfallFoot;
  }
  [[nodiscard]] bool stretches() const override { return false; }

  void draw(Canvas& canvas, const PlotArea& area) const override { draw_footfalls(canvas, rows_, time_axis(from_, to_), area); }

  [[nodiscard]] Trace data() const override {
    std::vector<DataColumn> columns;
    for (const Footfall& row : rows_) {
      DataColumn from{row.name + " from [s]", {}};
      DataColumn to{row.name + " to [s]", {}};
      for (const Stance& stance : row.stances) {
        from.values.push_back(stance.from);
        to.values.push_back(stance.to);
      }
      columns.push_back(std::move(from));
      columns.push_back(std::move(to));
      columns.push_back({row.name + " duty factor", {row.duty_factor}});
    }
    return data_table(columns);
  }

 private:
  std::vector<Footfall> rows_;
  double from_ = 0, to_ = 0;
};

/// Index of the row nearest to a time; the earlier row if two are equally near. There must be a row.
std::size_t nearest_row(const std::vector<double>& time, double at) {
  std::size_t nearest = 0;
  for (std::size_t row = 1; row < time.size(); ++row) {
    if (std::abs(time[row] - at) < std::abs(time[nearest] - at) - 1e-9) nearest = row;
  }
  return nearest;
}

class ViewsOfPanel final : public PaperPanel {
 public:
  explicit ViewsOfPanel(const PanelSource& source) {
    const PaperRun& run = source.run();
    const PanelRecipe& panel = source.panel();
    const Robot& robot = *run.scenario.robot;
    const std::vector<double> time = row_times(run.recording);
    if (!run.recording.has_states(robot)) {
      source.problem({"kind"}, fmt::format("run {} has no poses of the robot", in_quotes(run.name)));
      return;
    }
    std::size_t joint = 0;
    if (!panel.joint.empty()) {
      const std::vector<std::string> names = joint_names(robot);
      joint = static_cast<std::size_t>(std::ranges::find(names, panel.joint) - names.begin());
      if (const std::string wrong = not_one_joint(panel.joint, names); !wrong.empty()) {
        source.problem({"joint"}, wrong);
        return;
      }
    }
    const Sight from = sight(run.scenario, run.recording);
    input_ = views_input(run.scenario, run.recording, from);
    for (std::size_t k = 0; k < panel.times.size(); ++k) {
      if (panel.times[k] > run.recording.simulated + 1e-9) {
        source.problem({"times", std::to_string(k)},
                       fmt::format("{} is beyond the end of the run at {}", with_unit(panel.times[k], "s"),
                                   with_unit(run.recording.simulated, "s")));
        continue;
      }
      const std::size_t row = nearest_row(time, panel.times[k]);
      View view = view_at(run.scenario, run.recording, from, row, joint);
      if (panel.joint.empty()) view.joint.reset();
      input_.views.push_back(std::move(view));
      states_.push_back(run.recording.state(robot, row));
    }
    names_ = joint_names(robot);
    if (!panel.legend) return;
    title_ = from.view;
    legend_ = views_legend(input_.views);
  }

  [[nodiscard]] Margins margins() const override {
    double times = 0;
    for (const View& view : input_.views) times = std::max(times, print_width(fmt::format("{:.6g} s", view.time), 13, true));
    return {10 + times, 4};
  }
  [[nodiscard]] std::string title() const override { return title_; }
  [[nodiscard]] double head(const Edges& edges) const override { return legend_.empty() ? 0 : legend_head(legend_, edges); }
  [[nodiscard]] double body(const Edges& edges) const override { return views_height(input_, edges); }
  [[nodiscard]] bool stretches() const override { return false; }
  [[nodiscard]] double foot() const override { return 0; }
  void draw(Canvas& canvas, const PlotArea& area) const override {
    draw_legend_above(canvas, legend_, area);
    draw_views(canvas, input_, {area.left, area.right}, area.top);
  }

  /// Poses of the robot in the views.
  [[nodiscard]] Trace data() const override {
    std::vector<DataColumn> columns{{"t [s]", {}},   {"base.x [m]", {}}, {"base.y [m]", {}}, {"base.z [m]", {}},
                                    {"base.qw", {}}, {"base.qx", {}},    {"base.qy", {}},    {"base.qz", {}}};
    for (const std::string& name : names_) columns.push_back({name + " angle [rad]", {}});
    for (std::size_t k = 0; k < states_.size(); ++k) {
      const RobotState& s = states_[k];
      std::vector<double> row{input_.views[k].time, s.position.x(),    s.position.y(),    s.position.z(),
                              s.orientation.w(),    s.orientation.x(), s.orientation.y(), s.orientation.z()};
      row.insert(row.end(), s.q.begin(), s.q.end());
      for (std::size_t c = 0; c < columns.size(); ++c) columns[c].values.push_back(row[c]);
    }
    return data_table(columns);
  }

 private:
  ViewsInput input_;
  std::vector<RobotState> states_;
  std::vector<std::string> names_;
  std::string title_;
  std::vector<LegendEntry> legend_;
};

void views_fields(PanelRecipe& panel, Fields& f) {
  f.numbers("times", panel.times, {"s", 0, kLongestTime, "Times at which the robot is drawn, from top to bottom."});
  f.text("joint", panel.joint, "Joint that an arrow marks.");
  f.flag("legend", panel.legend, "Legend of the colours of the bodies.");
}

const char* no_times(const PanelRecipe& panel) {
  return panel.times.empty() ? "missing key 'times', a list of times in s" : nullptr;
}

}  // namespace

const PanelKind kFootfallsPanel{.name = "footfalls",
                                .about = "Stance phases of each leg of a robot, with its duty factor.",
                                .one_run = true,
                                .fields = [](PanelRecipe& panel, Fields& f) { panel.time_fields(f); },
                                .lacking = nothing_lacks,
                                .make = made<FootfallsOfPanel>};

const PanelKind kViewsPanel{.name = "views",
                            .about = "Side views of the robot at some instants.",
                            .one_run = true,
                            .fields = views_fields,
                            .lacking = no_times,
                            .make = made<ViewsOfPanel>};

}  // namespace gaitlab::report
