// Interface of a panel of a figure for a paper: margins, height, drawing.
#pragma once
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "core/recording/recording.h"
#include "core/scenario/scenario.h"
#include "report/figures/paper/panel_kinds.h"
#include "report/figures/run/views.h"
#include "report/plot/helvetica.h"
#include "report/plot/legend.h"
#include "report/plot/plot.h"

namespace gaitlab::report {

/// A run named by a recipe.
struct PaperRun {
  std::string name;
  Scenario scenario;
  Recording recording;
};

/// A frame with its surroundings, px. It is made once, with its contents, when InputError is collected.
class PaperPanel {
 public:
  virtual ~PaperPanel() = default;
  /// Width beside the frame, for ticks and titles.
  struct Margins {
    double left = 0, right = 0;
  };
  [[nodiscard]] virtual Margins margins() const = 0;
  /// Height above the frame, for a legend.
  [[nodiscard]] virtual double head(const Edges& edges) const = 0;
  /// Height of the frame; `stretches`: another height is possible.
  [[nodiscard]] virtual double body(const Edges& edges) const = 0;
  [[nodiscard]] virtual bool stretches() const { return true; }
  /// Height below it, for an axis.
  [[nodiscard]] virtual double foot() const { return 44; }
  virtual void draw(Canvas& canvas, const PlotArea& area) const = 0;
  /// The data drawn: columns named with their units. If columns differ in length the shorter ones end in NaN.
  [[nodiscard]] virtual Trace data() const = 0;
  /// Notes for readers on facts that the figure does not show.
  [[nodiscard]] virtual std::vector<std::string> notes() const { return {}; }
};

/// The first and last row within [from, to] s, one behind it; `to` 0: the end.
struct Rows {
  std::size_t first = 0, last = 0;
};
Rows rows_within(std::span<const double> time, double from, double to);

/// Speed (rad/s) and torque (N m) of a joint, by rows.
struct JointLoad {
  Series speed, torque;
};

/// Place of a panel in its recipe, with the runs.
struct PanelSource {
  const Recipe& recipe;
  std::size_t number = 0;
  std::span<const PaperRun> runs;
  double px_per_mm = 1;
  Problems& problems;

  [[nodiscard]] const PanelRecipe& panel() const { return recipe.panels[number]; }
  /// Adds a problem at a value of the panel.
  void problem(std::vector<std::string> path, const std::string& text) const;
  /// The run of `run:`, or the only one.
  [[nodiscard]] const PaperRun& run() const;
  /// Interval of the panel, s, for runs that end at `end`; adds a problem if they do not contain it.
  struct Stretch {
    double from = 0, to = 0;
  };
  [[nodiscard]] Stretch stretch(double end) const;
  /// Rows of `run()` within the interval; a problem if there are less than two.
  [[nodiscard]] Rows rows(std::span<const double> time) const;
  /// Numbers of the joints of `run()` with a motor that match a pattern of `joints:`, in their order; a problem for a pattern
  /// without a match.
  [[nodiscard]] std::vector<std::size_t> joints() const;
  /// Load of a joint of `run()`; none, and a problem, if the run lacks it.
  [[nodiscard]] std::optional<JointLoad> load(std::size_t joint) const;
  /// Height of the frame, px.
  [[nodiscard]] double height(double mm) const { return (panel().height > 0 ? panel().height : mm) * px_per_mm; }
};

template <class Panel>
std::unique_ptr<PaperPanel> made(const PanelSource& source) {
  return std::make_unique<Panel>(source);
}
inline const char* nothing_lacks(const PanelRecipe&) { return nullptr; }

/// Style of the nth curve of a panel: colours of Okabe and Ito, each with a different dash, so that they differ in grey also.
Style curve_style(std::size_t n);

/// Times of a recording's rows, s.
std::vector<double> row_times(const Recording& recording);

/// Columns side by side as a table.
struct DataColumn {
  std::string name;
  std::vector<double> values;
};
Trace data_table(const std::vector<DataColumn>& columns);
/// `torque [N m]`
std::string with_unit_after(const std::string& name, const std::string& unit);

/// Width in Helvetica, px.
double regular_width(std::string_view text, double size);
/// Axis over time, with about as many ticks as there is room for.
Axis time_axis(double from, double to);
/// Width of the texts at an axis with the gap to the frame, px.
double texts_beside(const Ticks& ticks);
/// Look of legends in print: narrower than on the screen, names in Helvetica.
inline constexpr LegendLook kPrintLegend{.before = 6, .behind = 14, .width = regular_width};
inline constexpr double kPrintLine = 28;  ///< px, length of a line in a legend

/// Height of a legend above a frame, px, and the legend.
double legend_head(std::span<const LegendEntry> entries, const Edges& edges);
void draw_legend_above(Canvas& canvas, std::span<const LegendEntry> entries, const PlotArea& area);

}  // namespace gaitlab::report
