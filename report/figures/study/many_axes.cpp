#include "report/figures/study/many_axes.h"

#include <algorithm>

#include "report/figures/study/study_sheet.h"

namespace gaitlab::report {

Spread::Spread(const ManyAxis& axis, const ManyFigure& figure, std::size_t number) : log_(axis.axis.log), words_(axis.words) {
  for (const ManyPoint& p : figure.points) range_.add(scaled(p.at[number]));
  if (!words_.empty()) {
    range_.add(0);
    range_.add(static_cast<double>(words_.size() - 1));
  }
}

double Spread::scaled(double value) const { return log_ ? log10_of(value) : value; }

double Spread::share(double value) const {
  return range_.hi > range_.lo ? (scaled(value) - range_.lo) / (range_.hi - range_.lo) : 0.5;
}

std::vector<std::pair<double, std::string>> Spread::labels(int count) const {
  std::vector<std::pair<double, std::string>> all;
  if (range_.empty()) return all;
  constexpr std::size_t kMostWords = 12;
  const std::size_t every = words_.size() / kMostWords + 1;
  for (std::size_t k = 0; k < words_.size(); k += every) all.emplace_back(share(static_cast<double>(k)), shortened(words_[k]));
  if (!words_.empty()) return all;
  const std::vector<std::pair<double, std::string>> marks = axis_marks(range_, log_, count).labels;
  if (!(range_.hi > range_.lo)) return {{0.5, marks.front().second}};
  for (const auto& [at, label] : marks) all.emplace_back((at - range_.lo) / (range_.hi - range_.lo), label);
  return all;
}

Bounds value_range(const ManyFigure& figure) {
  Bounds range;
  for (const ManyPoint& p : figure.points) {
    if (p.state == PointState::kept) range.add(p.value);
  }
  if (range.lo < range.hi) return range;
  for (const ManyPoint& p : figure.points) {
    if (p.state != PointState::failed) range.add(p.value);
  }
  return range;
}

}  // namespace gaitlab::report
