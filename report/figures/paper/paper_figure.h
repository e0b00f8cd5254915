// A figure for a paper, with panels one below another on a sheet whose size is in mm.
#pragma once
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "report/figures/paper/paper_panel.h"

namespace gaitlab::report {

/// A figure for a paper. Text of the recipe's font size (pt) is 13 px high in the drawing, so that 1 px is font / 13 pt, and
/// lines and gaps scale with the text. The frames of all panels have the same left and right edges.
class PaperFigure {
 public:
  /// `runs` contains the recipe's runs in its order. Throws InputError with every problem at its place in the recipe: a column,
  /// joint or leg that the run does not have, incompatible units, a time beyond the run, or a size that is too small.
  PaperFigure(const Recipe& recipe, std::span<const PaperRun> runs);
  [[nodiscard]] const Paper& paper() const { return paper_; }
  /// Title of the recipe, or else the kinds of the panels with their runs, for programs that read the figure aloud: `views of
  /// hexapod; footfalls of hexapod`.
  [[nodiscard]] const std::string& title() const { return title_; }
  void draw(Canvas& canvas) const;
  /// Data of the figure, one table per panel.
  [[nodiscard]] std::vector<Trace> data() const;
  [[nodiscard]] std::vector<std::string> notes() const;

 private:
  struct Placed {
    std::unique_ptr<PaperPanel> panel;
    PlotArea area = {};
    double top = 0;          ///< px, upper edge of the part above the frame
    std::string title = {};  ///< title in bold above the panel
  };
  /// Left and right edge of all frames. Throws InputError if the width is too small.
  [[nodiscard]] Edges edges(const Recipe& recipe) const;
  void place(const Recipe& recipe);

  std::vector<Placed> panels_;
  Paper paper_;
  std::string title_;
  std::string heading_;  ///< title that is drawn above the panels
  double margin_ = 0;    ///< px
  bool letters_ = false;
};

/// Recipe without panels for a figure on the screen, 1000 px wide at 96 px per inch.
Recipe screen_recipe(std::string title);

/// SVG document of a recipe. Throws InputError as PaperFigure does.
std::string figure_svg(const Recipe& recipe, std::span<const PaperRun> runs);

}  // namespace gaitlab::report
