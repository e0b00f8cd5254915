// Axes of figures with many parameters: where a point lies on them, and their labels.
#pragma once
#include <string>
#include <utility>
#include <vector>

#include "report/figures/study/many_figure.h"
#include "report/plot/panel.h"

namespace gaitlab::report {

/// An axis over all points, from 0 to 1.
class Spread {
 public:
  Spread(const ManyAxis& axis, const ManyFigure& figure, std::size_t number);
  /// Of values that are no parameter.
  explicit Spread(const Bounds& range) : range_(range) {}

  [[nodiscard]] double share(double value) const;
  /// Places from 0 to 1 and their labels, about `count`.
  [[nodiscard]] std::vector<std::pair<double, std::string>> labels(int count) const;

 private:
  [[nodiscard]] double scaled(double value) const;
  Bounds range_;
  bool log_ = false;
  std::vector<std::string> words_;
};

/// The range that colours span: of the kept points, or where they have one value or none of all that have one.
Bounds value_range(const ManyFigure& figure);

}  // namespace gaitlab::report
