// Interface of a panel of a figure for a paper: its margins, height, drawing and data.
#pragma once
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "core/recording/recording.h"
#include "core/scenario/scenario.h"
#include "report/figures/paper/panel_kinds.h"
#include "report/figures/paper/recipe.h"
#include "report/figures/run/views.h"
#include "report/plot/font.h"
#include "report/plot/legend.h"
#include "report/plot/plot.h"

namespace gaitlab::report {

/// A run that a recipe names. Scenario and recording must outlive the figure.
struct PaperRun {
  std::string name;
  const Scenario& scenario;
  const Recording& recording;
};

/// A frame with its surroundings; lengths are in px. The panel reads its data once, when it is made, and collects problems for
/// InputError then.
class PaperPanel {
 public:
  virtual ~PaperPanel() = default;
  /// Widths left and right of the frame for ticks and titles.
  struct Margins {
    double left = 0, right = 0;
  };
  [[nodiscard]] virtual Margins margins() const = 0;
  /// Height above the frame for a legend.
  [[nodiscard]] virtual double head(const Edges& edges) const = 0;
  /// Height of the frame. If stretches() is true, the figure may choose another height.
  [[nodiscard]] virtual double body(const Edges& edges) const = 0;
  [[nodiscard]] virtual bool stretches() const { return true; }
  /// Height below the frame for an axis.
  [[nodiscard]] virtual double foot() const { return 44; }
  virtual void draw(Canvas& canvas, const PlotArea& area) const = 0;
  /// Title of a panel whose recipe has none.
  [[nodiscard]] virtual std::string title() const { return {}; }
  /// Data that the panel draws, in columns with units in their names. Columns that are shorter than the longest end in NaN.
  [[nodiscard]] virtual Trace data() const = 0;
  /// Notes on facts that the figure does not show, printed for the user.
  [[nodiscard]] virtual std::vector<std::string> notes() const { return {}; }
};

/// Rows within [from, to] s: from `first` up to, but not including, `last`. `to` 0 means the end of the run.
struct RowRange {
  std::size_t first = 0, last = 0;
};
RowRange rows_within(std::span<const double> time, double from, double to);

/// Speed (rad/s) and torque (N m) of a joint, one value per row.
struct JointLoad {
  Series speed, torque;
};

/// Input from which a panel is made: its place in the recipe, and the runs.
struct PanelSource {
  const Recipe& recipe;
  std::size_t number = 0;
  std::span<const PaperRun> runs;
  double px_per_mm = 1;
  Problems& problems;

  [[nodiscard]] const PanelRecipe& panel() const { return recipe.panels[number]; }
  /// Adds a problem at the place of a value of the panel; `path` is the value's path of keys.
  void problem(std::vector<std::string> path, const std::string& text) const;
  /// The run that the key `run` names, or the only run of the recipe.
  [[nodiscard]] const PaperRun& run() const;
  /// Time interval of the panel, s, for runs that end at `end`. Adds a problem if the runs do not contain it.
  struct Stretch {
    double from = 0, to = 0;
  };
  [[nodiscard]] Stretch stretch(double end) const;
  /// Rows of `run()` within the interval. Adds a problem if there are fewer than two.
  [[nodiscard]] RowRange rows(std::span<const double> time) const;
  /// Indices of the joints of `run()` that have a motor and match a pattern of the key `joints`, in ascending order. Adds a
  /// problem for a pattern without a match.
  [[nodiscard]] std::vector<std::size_t> joints() const;
  /// Speed and torque of a joint of `run()`. If the run lacks them, adds a problem and returns nothing.
  [[nodiscard]] std::optional<JointLoad> load(std::size_t joint) const;
  /// Height of the frame in px: that of the recipe, or else `mm`.
  [[nodiscard]] double height(double mm) const { return (panel().height > 0 ? panel().height : mm) * px_per_mm; }
};

template <class Panel>
std::unique_ptr<PaperPanel> made(const PanelSource& source) {
  return std::make_unique<Panel>(source);
}
inline const char* nothing_lacks(const PanelRecipe&) { return nullptr; }

/// Style of the nth curve of a panel: a colour of Okabe and Ito with a dash pattern, so that curves also differ in print
/// without colour.
Style curve_style(std::size_t n);

/// Times of a recording's rows, s.
std::vector<double> row_times(const Recording& recording);

/// A column of a table of data.
struct DataColumn {
  std::string name;
  std::vector<double> values;
};
Trace data_table(const std::vector<DataColumn>& columns);
/// Name with its unit in brackets: `torque [N m]`.
std::string with_unit_after(const std::string& name, const std::string& unit);

/// Width of a text in Helvetica, px.
double regular_width(std::string_view text, double size);
/// Time axis with as many ticks as there is room for.
Axis time_axis(double from, double to);
/// Width of the tick texts beside an axis, with their gap to the frame, px.
double texts_beside(const Ticks& ticks);
/// Layout of legends in print: smaller gaps than on the screen, and text widths of Helvetica.
inline constexpr LegendLook kPrintLegend{.before = 6, .behind = 14, .width = regular_width};
inline constexpr double kPrintLine = 28;  ///< px, length of the line that represents a curve in a legend

/// Height of a legend above a frame, px, and the function that draws the legend.
double legend_head(std::span<const LegendEntry> entries, const Edges& edges);
void draw_legend_above(Canvas& canvas, std::span<const LegendEntry> entries, const PlotArea& area);

}  // namespace gaitlab::report
