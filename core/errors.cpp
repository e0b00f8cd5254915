#include "core/errors.h"

#include <algorithm>
#include <numeric>

namespace gaitlab {

std::string to_string(const SourceLocation& place) {
  if (place.line == 0) return place.file;
  return place.file + ":" + std::to_string(place.line) + ":" + std::to_string(place.column);
}

namespace {

std::string report(const std::vector<Problem>& problems) {
  std::string text;
  for (const Problem& problem : problems) {
    if (!text.empty()) text += '\n';
    text += to_string(problem.place) + ": error: " + problem.text;
    for (const auto& [place, note] : problem.notes) text += "\n" + to_string(place) + ": note: " + note;
  }
  return text;
}

// Levenshtein distance; a swap of neighbours, the commonest typing error, counts one.
std::size_t distance(const std::string& a, const std::string& b) {
  std::vector<std::size_t> before(b.size() + 1);
  std::vector<std::size_t> row(b.size() + 1);
  std::vector<std::size_t> next(b.size() + 1);
  std::iota(row.begin(), row.end(), std::size_t{0});
  for (std::size_t i = 0; i < a.size(); ++i) {
    next[0] = i + 1;
    for (std::size_t j = 0; j < b.size(); ++j) {
      next[j + 1] = std::min({row[j + 1] + 1, next[j] + 1, row[j] + (a[i] == b[j] ? 0U : 1U)});
      if (i > 0 && j > 0 && a[i] == b[j - 1] && a[i - 1] == b[j]) next[j + 1] = std::min(next[j + 1], before[j - 1] + 1);
    }
    before = std::exchange(row, std::exchange(next, std::move(before)));
  }
  return row.back();
}

}  // namespace

void Problems::raise() const {
  if (!list_.empty()) throw InputError(list_);
}

InputError::InputError(std::vector<Problem> problems) : std::runtime_error(report(problems)), problems_(std::move(problems)) {}

InputError::InputError(SourceLocation place, std::string text)
    : InputError(std::vector<Problem>{{std::move(place), std::move(text), {}}}) {}

std::string nearest(const std::string& found, const std::vector<std::string>& known) {
  std::string best;
  std::size_t best_distance = std::max<std::size_t>(1, found.size() / 3) + 1;
  for (const std::string& name : known) {
    const std::size_t d = distance(found, name);
    if (d < best_distance) {
      best = name;
      best_distance = d;
    }
  }
  if (!best.empty() || found.size() < 3) return best;
  // An abbreviation is not a typing error: the one name that begins with it.
  for (const std::string& name : known) {
    if (!name.starts_with(found)) continue;
    if (!best.empty()) return {};
    best = name;
  }
  return best;
}

}  // namespace gaitlab
