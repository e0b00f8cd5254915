// A figure for a paper: panels one below another on a sheet of a size in mm.
#pragma once
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "report/figures/paper/paper_panel.h"

namespace gaitlab::report {

/// A figure for a paper. Text of the recipe's size in pt is 13 px in the drawing, so that a px is font / 13 pt: lines and gaps
/// suit the text. Frames of all panels begin and end at the same x.
class PaperFigure {
 public:
  /// `runs`: the recipe's runs, in its order. Throws InputError with every finding at its place in the recipe: a column, joint
  /// or leg that the run does not have, incompatible units, a time beyond the run, a size too small.
  PaperFigure(const Recipe& recipe, std::span<const PaperRun> runs);
  [[nodiscard]] const Paper& paper() const { return paper_; }
  void draw(Canvas& canvas) const;
  /// One table per panel.
  [[nodiscard]] std::vector<Trace> data() const;
  [[nodiscard]] std::vector<std::string> notes() const;

 private:
  struct Placed {
    std::unique_ptr<PaperPanel> panel;
    PlotArea area = {};
    double top = 0;  ///< px, of its head
  };
  /// Common to all frames; throws InputError if the width is too small.
  [[nodiscard]] Edges edges(const Recipe& recipe) const;
  void place(const Recipe& recipe);

  std::vector<Placed> panels_;
  Paper paper_;
  bool letters_ = false;
};

}  // namespace gaitlab::report
