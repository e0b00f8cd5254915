#include "report/figures/study/many_axes.h"

#include "report/figures/study/study_sheet.h"

namespace gaitlab::report {

Ticks parameter_ticks(const ManyFigure& figure, std::size_t parameter, int count, double wider) {
  const ManyAxis& axis = figure.axes[parameter];
  Bounds range;
  for (const ManyPoint& p : figure.points) range.add(place_on(axis, p.at[parameter]));
  if (axis.words.empty()) return ticks_over(range, axis.axis.log, count, wider);
  constexpr std::size_t kMostWords = 12;
  std::vector<std::string> words;
  for (const std::string& word : axis.words) words.push_back(shortened(word));
  const double wide = words.size() > 1 ? static_cast<double>(words.size() - 1) : 0;
  return word_ticks(words, wide > 0 ? wider * wide : 0.5, words.size() / kMostWords + 1);
}

Bounds ended_range(const ManyFigure& figure) {
  Bounds range;
  for (const ManyPoint& p : figure.points) {
    if (p.state != PointState::failed) range.add(p.value);
  }
  return range;
}

Bounds value_range(const ManyFigure& figure) {
  Bounds kept;
  for (const ManyPoint& p : figure.points) {
    if (p.state == PointState::kept) kept.add(p.value);
  }
  return shown_range(kept, ended_range(figure));
}

Bounds colour_range(const ManyFigure& figure) {
  Bounds range;
  for (const ManyPoint& p : figure.points) {
    if (p.state == PointState::kept) range.add(p.value);
  }
  return range.lo < range.hi ? range : ended_range(figure);
}

}  // namespace gaitlab::report
