// Panel kind `curves`, which shows columns of the trace over time.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "core/model/pattern.h"
#include "core/scenario/sections.h"
#include "core/settings/joint_patterns.h"
#include "core/settings/wording.h"
#include "report/figures/paper/motor_limits.h"
#include "report/figures/paper/paper_panel.h"
#include "report/figures/run/run_footfalls.h"

namespace gaitlab::report {

namespace {

constexpr double kCurvesHeight = 45;  // mm
constexpr double kTitleAway = 8;      // px, between tick texts and the title of the axis
constexpr double kAscent = 10;        // px, height of 13 px text above its baseline
constexpr std::string_view kStanceFill = "#E4E4E4";
constexpr Style kMarkLine{.stroke = colour::kBlack, .width = 1, .dash = "1 3"};

/// A column of a recording, split into quantity and joint.
struct FoundColumn {
  std::string name, alias;      ///< for example joint.7.torque and joint.m3/passive.torque
  std::string quantity, joint;  ///< for example torque and m3/passive; for com.x the joint is empty
  std::string unit;
};

std::vector<FoundColumn> columns_of(const PaperRun& run) {
  const std::vector<std::string> joints = joint_names(*run.scenario.robot);
  std::vector<FoundColumn> all;
  const ColumnList& chosen = run.recording.trace.columns;
  for (const ColumnList* columns : {&chosen, &run.recording.rest.columns}) {
    for (const Column& column : *columns) {
      if (column.name == "t" || (columns != &chosen && chosen.find(column.name) < chosen.size())) continue;
      FoundColumn found{column.name, column.name, column.name, "", column.unit};
      const std::size_t dot = column.name.rfind('.');
      if (column.name.starts_with("joint.") && dot > 6) {
        const auto number = static_cast<std::size_t>(std::atoi(column.name.c_str() + 6));
        found.joint = number < joints.size() ? joints[number] : column.name.substr(6, dot - 6);
        found.quantity = column.name.substr(dot + 1);
        found.alias = "joint." + found.joint + "." + found.quantity;
        std::ranges::replace(found.quantity, '_', ' ');
        if (found.quantity == "setpoint") found.quantity = "set point";
      }
      all.push_back(std::move(found));
    }
  }
  return all;
}

struct PaperCurve {
  const PaperRun* run;
  FoundColumn column;
  Side side;
  std::string name = {};                       ///< name in the legend
  std::vector<double> time = {}, values = {};  ///< part of the run within the panel
  Style style = {};
};

class CurvesOfPanel final : public PaperPanel {
 public:
  explicit CurvesOfPanel(const PanelSource& source)
      : panel_(source.panel()), height_(source.height(kCurvesHeight)), from_(panel_.from), to_(panel_.to) {
    std::vector<const PaperRun*> runs;
    for (const PaperRun& run : source.runs) {
      if (panel_.runs.empty() || std::ranges::find(panel_.runs, run.name) != panel_.runs.end()) runs.push_back(&run);
    }
    several_runs_ = runs.size() > 1;
    end_ = 0;
    for (const PaperRun* run : runs) end_ = std::max(end_, run->recording.simulated);
    to_ = source.stretch(end_).to;
    find(source, runs, panel_.left, Side::left, "left");
    find(source, runs, panel_.right, Side::right, "right");
    if (!panel_.stance.empty()) find_stance(source, runs);
    if (!panel_.motor.empty()) find_motor(source, runs);
    if (!source.problems.empty()) return;
    name_curves();
    set_ticks();
  }

  [[nodiscard]] Margins margins() const override {
    const double half_label = 0.5 * regular_width(time_axis(from_, to_).ticks.marks.back().text, kPrint.text) + 1;
    const double left = beside(Side::left) + (axis_title(Side::left).empty() ? 0 : kTitleAway + kAscent + 2);
    const double right = beside(Side::right) + (axis_title(Side::right).empty() ? 0 : kTitleAway + kAscent + 2) + 2;
    return {left, has(Side::right) ? right : std::max(8.0, half_label)};
  }
  [[nodiscard]] double head(const Edges& edges) const override { return legend_head(legend(), edges); }
  [[nodiscard]] double body(const Edges&) const override { return height_; }

  void draw(Canvas& canvas, const PlotArea& area) const override {
    const auto side_axis = [&](Side side) -> Axis {
      const double away = beside(side) + kTitleAway + (side == Side::left ? 0 : kAscent);
      return {.ticks = side == Side::left ? ticks_.a : ticks_.b, .title = axis_title(side), .away = away};
    };
    Plot plot(canvas, area, time_axis(from_, to_), has(Side::left) ? side_axis(Side::left) : Axis{}, kPrint);
    if (has(Side::right)) {
      Axis right = side_axis(Side::right);
      if (has(Side::left)) right.lines = TickLines::outside;
      plot.right_axis(std::move(right));
    }
    for (const Stance& stance : stances_) plot.band(stance.from, stance.to, kStanceFill);
    limits_.shade(plot);
    plot.draw_axes();
    for (const double mark : panel_.marks)
      if (mark >= from_ && mark <= to_) plot.moment(mark, kMarkLine);
    limits_.draw(plot, torque_side_);
    for (const PaperCurve& curve : curves_) plot.curve(curve.time, drawn(curve), curve.style, curve.side);
    draw_legend_above(canvas, legend(), area);
  }

  [[nodiscard]] Trace data() const override {
    std::vector<DataColumn> columns;
    const std::vector<double>* last = nullptr;
    for (const PaperCurve& curve : curves_) {
      const std::string run = several_runs_ ? curve.run->name + " " : "";
      if (last == nullptr || *last != curve.time || several_runs_) {
        const std::string name = run + "t [s]";
        if (std::ranges::find(columns, name, &DataColumn::name) == columns.end()) columns.push_back({name, curve.time});
        last = &curve.time;
      }
      columns.push_back({with_unit_after(run + curve.column.name, curve.column.unit), curve.values});
    }
    return data_table(columns);
  }

 private:
  /// Adds the curves of an axis.
  void find(const PanelSource& source, const std::vector<const PaperRun*>& runs, const AxisRecipe& axis, Side side,
            const std::string& key) {
    const std::size_t first = curves_.size();
    for (const PaperRun* run : runs) {
      const std::vector<FoundColumn> all = columns_of(*run);
      for (std::size_t k = 0; k < axis.columns.size(); ++k) {
        const std::string& pattern = axis.columns[k];
        const ColumnChoice choice(pattern, joint_names(*run->scenario.robot), run->scenario.groups);
        bool any = false;
        for (const FoundColumn& column : all) {
          if (!choice.has(column.name) && !glob(pattern, column.alias)) continue;
          any = true;
          const auto same = [&](const PaperCurve& c) { return c.run == run && c.side == side && c.column.name == column.name; };
          if (std::ranges::none_of(curves_, same)) curves_.push_back(curve_of(*run, column, side));
        }
        if (!any) refuse(source, *run, all, pattern, {key, "columns", std::to_string(k)});
      }
    }
    check_units(source, first, key);
    if (!axis.names.empty() && axis.names.size() != curves_.size() - first) {
      source.problem(
          {key, "names"},
          fmt::format("names has {}, but {} drawn", counted(axis.names.size(), "name"),
                      curves_.size() - first == 1 ? "1 curve is" : counted(curves_.size() - first, "curve") + " are"));
      return;
    }
    for (std::size_t k = 0; k < axis.names.size(); ++k) curves_[first + k].name = axis.names[k];
  }

  [[nodiscard]] PaperCurve curve_of(const PaperRun& run, const FoundColumn& column, Side side) const {
    PaperCurve curve{&run, column, side};
    const std::vector<double> time = row_times(run.recording);
    const RowRange rows = rows_within(time, from_, to_);
    const Series series = run.recording.series(column.name);
    for (std::size_t row = rows.first; row < rows.last && row < series.size(); ++row) {
      curve.time.push_back(time[row]);
      curve.values.push_back(series[row]);
    }
    return curve;
  }

  void check_units(const PanelSource& source, std::size_t first, const std::string& key) const {
    for (std::size_t k = first + 1; k < curves_.size(); ++k) {
      const FoundColumn& a = curves_[first].column;
      const FoundColumn& b = curves_[k].column;
      if (a.unit == b.unit) continue;
      source.problem({key, "columns"},
                     fmt::format("{} is in {} and {} in {}, but an axis has only one unit; draw one of them on the other axis",
                                 a.name, a.unit.empty() ? "no unit" : a.unit, b.name, b.unit.empty() ? "no unit" : b.unit));
      return;
    }
  }

  static void refuse(const PanelSource& source, const PaperRun& run, const std::vector<FoundColumn>& all,
                     const std::string& pattern, const std::vector<std::string>& path) {
    std::vector<std::string> names;
    for (const FoundColumn& column : all) names.push_back(column.name);
    if (nearest(pattern, names).empty()) {
      std::vector<std::string> aliases;
      for (const FoundColumn& column : all) aliases.push_back(column.alias);
      if (!nearest(pattern, aliases).empty()) names = aliases;
    }
    source.problem(path, fmt::format("no column {} in run {}{}", in_quotes(pattern), in_quotes(run.name),
                                     offer(pattern, names, "columns")));
  }

  void find_stance(const PanelSource& source, const std::vector<const PaperRun*>& runs) {
    if (runs.size() != 1) {
      source.problem({"stance"}, "`stance` needs a panel with one run; expected `runs: [NAME]`");
      return;
    }
    const PaperRun& run = *runs.front();
    const std::vector<Leg> legs = legs_that_walk(run.scenario);
    std::vector<std::string> names;
    std::ranges::transform(legs, std::back_inserter(names), leg_name);
    const auto leg = std::ranges::find(names, panel_.stance);
    if (leg == names.end()) {
      source.problem({"stance"}, names.empty() ? "`stance` needs a robot that walks on legs"
                                               : "no leg " + in_quotes(panel_.stance) + offer(panel_.stance, names, "legs"));
      return;
    }
    const std::size_t number = static_cast<std::size_t>(leg - names.begin());
    if (const std::string lacks = loads_of(run.scenario, run.recording, {legs[number]}).lacks; !lacks.empty()) {
      source.problem({"stance"},
                     fmt::format("run {} lacks column {}, which shows the stance of a leg", in_quotes(run.name), lacks));
      return;
    }
    const std::vector<double> time = row_times(run.recording);
    stances_ = footfalls(run.scenario, run.recording, {legs[number]}, time, 0).front().stances;
  }

  void find_motor(const PanelSource& source, const std::vector<const PaperRun*>& runs) {
    if (runs.size() != 1) {
      source.problem({"motor"}, "`motor` needs a panel with one run; expected `runs: [NAME]`");
      return;
    }
    const PaperRun& run = *runs.front();
    const std::vector<std::string> names = joint_names(*run.scenario.robot);
    const std::size_t joint = static_cast<std::size_t>(std::ranges::find(names, panel_.motor) - names.begin());
    std::string wrong = not_one_joint(panel_.motor, names);
    if (wrong.empty() && !run.scenario.robot->joints[joint].driven()) wrong = "joint " + panel_.motor + " has no motor";
    if (!wrong.empty()) {
      source.problem({"motor"}, wrong);
      return;
    }
    limits_ = motor_limits(run, joint, rows_within(row_times(run.recording), from_, to_));
    const auto torque = std::ranges::find(curves_, fmt::format("joint.{}.torque", joint),
                                          [](const PaperCurve& curve) { return curve.column.name; });
    if (torque == curves_.end() || axis(torque->side).log) {
      limits_.rest.clear();
    } else {
      torque_side_ = torque->side;
    }
  }

  /// Gives each curve a name from the parts in which the curves differ: run, joint, quantity.
  void name_curves() {
    const auto differs = [&](const auto& part) {
      return std::ranges::any_of(curves_, [&](const PaperCurve& c) { return part(c) != part(curves_.front()); });
    };
    const bool runs = differs([](const PaperCurve& c) { return c.run->name; });
    const bool joints = differs([](const PaperCurve& c) { return c.column.joint; });
    const bool quantities = differs([](const PaperCurve& c) { return c.column.quantity; });
    for (std::size_t k = 0; k < curves_.size(); ++k) {
      PaperCurve& curve = curves_[k];
      curve.style = curve_style(k);
      if (!curve.name.empty()) continue;
      const auto add = [&](const std::string& part) {
        if (!part.empty()) curve.name += (curve.name.empty() ? "" : " ") + part;
      };
      if (runs) add(curve.run->name);
      if (joints) add(curve.column.joint);
      if (quantities || curve.name.empty()) add(curve.column.quantity);
      if (curve.side == Side::right && has(Side::left)) curve.name += " (right)";
    }
  }

  [[nodiscard]] bool has(Side side) const {
    return std::ranges::any_of(curves_, [side](const PaperCurve& c) { return c.side == side; });
  }

  [[nodiscard]] const AxisRecipe& axis(Side side) const { return side == Side::left ? panel_.left : panel_.right; }

  /// Values of a curve on its axis.
  [[nodiscard]] std::vector<double> drawn(const PaperCurve& curve) const {
    std::vector<double> values = curve.values;
    if (axis(curve.side).log) {
      for (double& value : values) value = value > 0 ? log10_of(value) : std::numeric_limits<double>::quiet_NaN();
    }
    return values;
  }

  [[nodiscard]] Bounds bounds(Side side) const {
    Bounds bounds;
    for (const PaperCurve& curve : curves_) {
      if (curve.side == side) bounds.add(drawn(curve));
    }
    if (side == torque_side_) bounds.add(limits_.rest);
    if (const double least = axis(side).least; least > 0 && !bounds.empty()) bounds.add(std::vector{-least, least});
    return bounds;
  }

  void set_ticks() {
    const Bounds a = bounds(Side::left);
    const Bounds b = bounds(Side::right);
    const auto given = [](const AxisRecipe& axis, const Bounds& bounds, Ticks& ticks) {
      const std::vector<double>& range = axis.range;
      if (axis.log) {
        Bounds ends = bounds.empty() ? Bounds{0, 1} : Bounds{std::floor(bounds.lo), std::ceil(bounds.hi)};  // decades
        if (!range.empty()) ends = {log10_of(range[0]), log10_of(range[1])};
        ticks = ticks_over(ends, true, 4, range.empty() ? 0.03 : 0);
      } else if (!range.empty()) {
        ticks = ticks_within(range[0], range[1], 5);
      }
    };
    const auto free = [&](Side side) { return has(side) && axis(side).range.empty() && !axis(side).log; };
    const bool both = free(Side::left) && free(Side::right);
    ticks_ = both ? twin_ticks(a.lo, a.hi, b.lo, b.hi) : TwinTicks{ticks_around(a, 5), ticks_around(b, 5)};
    make_room(ticks_, a, b);
    given(panel_.left, a, ticks_.a);
    given(panel_.right, b, ticks_.b);
  }

  [[nodiscard]] double beside(Side side) const { return texts_beside(side == Side::left ? ticks_.a : ticks_.b); }

  /// Title of an axis: the unit, preceded by the quantities if there are one or two.
  [[nodiscard]] std::string axis_title(Side side) const {
    if (!axis(side).label.empty() || !has(side)) return axis(side).label;
    std::vector<std::string> quantities;
    std::string unit;
    for (const PaperCurve& curve : curves_) {
      if (curve.side != side) continue;
      unit = curve.column.unit;
      if (std::ranges::find(quantities, curve.column.quantity) == quantities.end()) quantities.push_back(curve.column.quantity);
    }
    const std::string names = quantities.size() > 2 ? "" : fmt::format("{}", fmt::join(quantities, ", "));
    return unit.empty() ? names : names + (names.empty() ? "(" : " (") + unit + ")";
  }

  [[nodiscard]] std::vector<LegendEntry> legend() const {
    std::vector<LegendEntry> entries;
    if (curves_.size() > 1) {
      for (const PaperCurve& curve : curves_) entries.push_back(line_entry(curve.name, curve.style, kPrintLine));
    }
    if (!panel_.stance.empty())
      entries.push_back(line_entry("stance of " + panel_.stance, {.stroke = kStanceFill, .width = 11}, kPrintLine));
    limits_.add_to(entries);
    return entries;
  }

  const PanelRecipe& panel_;
  double height_, from_, to_;
  double end_ = 0;
  bool several_runs_ = false;
  std::vector<PaperCurve> curves_;
  std::vector<Stance> stances_;
  MotorLimitMarks limits_;
  Side torque_side_ = Side::left;
  TwinTicks ticks_;
};

void curves_fields(PanelRecipe& panel, Fields& f) {
  f.texts("runs", panel.runs, "Runs whose curves are drawn, by name; default: all.");
  f.group("left", panel.left, "Curves of the left axis.");
  f.group("right", panel.right, "Curves of the right axis; the zeros of both axes coincide if that wastes little paper.");
  f.text("stance", panel.stance, "Leg whose stance is shaded, named as in the footfalls of figure.svg: front left.");
  f.text("motor", panel.motor,
         "Joint whose motor is shown: the time at a voltage or current limit is shaded, and a line marks the motor's torque at "
         "rest if the torque curve comes near it.");
  f.numbers("marks", panel.marks, {"s", 0, kLongestTime, "Times that a dotted line marks."});
  panel.time_fields(f);
  panel.height_field(f);
}

const char* no_curves(const PanelRecipe& panel) {
  const bool none = panel.left.columns.empty() && panel.right.columns.empty();
  return none ? "no curve is drawn; expected `left: {columns: [...]}` or the same with `right`" : nullptr;
}

}  // namespace

const PanelKind kCurvesPanel{.name = "curves",
                             .about = "Columns of the trace over time, on one axis or two.",
                             .one_run = false,
                             .fields = curves_fields,
                             .lacking = no_curves,
                             .make = made<CurvesOfPanel>};

}  // namespace gaitlab::report
