// What a panel of a figure for a paper is to its layout.
#pragma once
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "core/recording/recording.h"
#include "core/scenario/scenario.h"
#include "report/figures/paper/recipe.h"
#include "report/figures/run/views.h"
#include "report/plot/legend.h"
#include "report/plot/panel.h"

namespace gaitlab::report {

/// A run that a recipe names.
struct PaperRun {
  std::string name;
  Scenario scenario;
  Recording recording;
};

/// A frame and what stands around it, px. It is made once, with what it draws; InputError is collected where it is made.
class PaperPanel {
 public:
  virtual ~PaperPanel() = default;
  /// Beside the frame, for ticks and titles.
  struct Margins {
    double left = 0, right = 0;
  };
  [[nodiscard]] virtual Margins margins() const = 0;
  /// Above the frame, for a legend.
  [[nodiscard]] virtual double head(const Edges& edges) const = 0;
  /// The frame; `stretches`: it may have another height.
  [[nodiscard]] virtual double body(const Edges& edges) const = 0;
  [[nodiscard]] virtual bool stretches() const { return true; }
  /// Below it, for an axis.
  [[nodiscard]] virtual double foot() const { return 44; }
  virtual void draw(Canvas& canvas, const PlotArea& area) const = 0;
  /// The numbers drawn: columns named with their units. Of columns of other lengths the shorter ones end in NaN.
  [[nodiscard]] virtual Trace data() const = 0;
  /// What a reader of the figure should know and does not see.
  [[nodiscard]] virtual std::vector<std::string> notes() const { return {}; }
};

/// The first and last row within [from, to] s, one behind it; `to` 0: the end.
struct Rows {
  std::size_t first = 0, last = 0;
};
Rows rows_within(std::span<const double> time, double from, double to);

/// Where a panel is in its recipe, with the runs.
struct PanelSource {
  const Recipe& recipe;
  std::size_t number = 0;
  std::span<const PaperRun> runs;
  double px_per_mm = 1;
  Problems& problems;

  [[nodiscard]] const PanelRecipe& panel() const { return recipe.panels[number]; }
  /// A problem at a value of the panel.
  void problem(std::vector<std::string> path, const std::string& text) const;
  /// The run of `run:`, or the only one.
  [[nodiscard]] const PaperRun& run() const;
  /// s: from where to where the panel shows runs that end at `end`; a problem where they do not hold that.
  struct Stretch {
    double from = 0, to = 0;
  };
  [[nodiscard]] Stretch stretch(double end) const;
  /// The rows of `run()` within the stretch; a problem where it has no two.
  [[nodiscard]] Rows rows(std::span<const double> time) const;
  /// Numbers of the joints of `run()` with a motor that a pattern of `joints:` matches, in their order; a problem where one
  /// matches none.
  [[nodiscard]] std::vector<std::size_t> joints() const;
  /// Of the frame, px.
  [[nodiscard]] double height(double mm) const { return (panel().height > 0 ? panel().height : mm) * px_per_mm; }
};

std::unique_ptr<PaperPanel> curves_panel(const PanelSource& source);
std::unique_ptr<PaperPanel> envelope_panel(const PanelSource& source);
std::unique_ptr<PaperPanel> heat_panel(const PanelSource& source);
std::unique_ptr<PaperPanel> footfall_panel(const PanelSource& source);
std::unique_ptr<PaperPanel> views_panel(const PanelSource& source);

/// Line of the nth curve of a panel: colours of Okabe and Ito, each with a dash of its own, so that they differ in grey, too.
Style curve_style(std::size_t n);

/// Of a recording, s.
std::vector<double> row_times(const Recording& recording);

/// Columns side by side as a table.
struct DataColumn {
  std::string name;
  std::vector<double> values;
};
Trace data_table(const std::vector<DataColumn>& columns);
/// `torque [N m]`
std::string with_unit_after(const std::string& name, const std::string& unit);

/// Widest label of an axis in Helvetica, px.
double label_width(const Ticks& ticks);
/// About as many ticks as have room on a time axis.
Ticks time_ticks(double from, double to);
/// In Helvetica, px.
double paper_width(std::string_view text, double size);
/// Of legends in print: narrower than on the screen.
inline constexpr LegendLook kPrintLegend{.sample = 28, .name = 34, .gap = 14, .width = paper_width};

}  // namespace gaitlab::report
