#include "core/recording/compare.h"

#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <unordered_map>
#include <utility>

#include "core/model/pattern.h"
#include "core/recording/time_shift.h"

namespace gaitlab {

namespace {

constexpr double kSameTime = 1e-6;  // share of the spacing; the rounding error of k h is about 1e-16 of t
constexpr double kFlat = 1e-9;      // a column with a smaller range counts as constant, in rad or N m
constexpr std::size_t kNamesShown = 8;

struct SharedRow {
  std::size_t a = 0, b = 0;
};

// Values of one column of both traces in the shared rows.
struct Pair {
  std::vector<double> a, b;
};

std::string enumerate(const std::vector<std::string>& names) {
  const auto shown = names.begin() + static_cast<std::ptrdiff_t>(std::min(names.size(), kNamesShown));
  const std::string text = fmt::format("{}", fmt::join(names.begin(), shown, ", "));
  return names.size() <= kNamesShown ? text : fmt::format("{} and {} more", text, names.size() - kNamesShown);
}

std::string plural(std::size_t count, const char* what) { return fmt::format("{} {}{}", count, what, count == 1 ? "" : "s"); }

class Comparison {
 public:
  Comparison(const Trace& a, const Trace& b, const CompareOptions& options) : a_(a), b_(b), options_(options) {}

  TraceDifference made() {
    match_columns();
    if (has_time(a_, "A") && has_time(b_, "B")) {
      match_rows();
      for (const auto& [column, other] : shared_) compare_column(column, other);
    }
    return std::move(found_);
  }

 private:
  [[nodiscard]] std::string label(const std::string& name) const { return readable_column(name, options_.names); }
  [[nodiscard]] bool wanted(const std::string& name) const {
    if (name == "t") return false;
    const std::string readable = label(name);
    return std::ranges::any_of(options_.columns,
                               [&](const std::string& pattern) { return glob(pattern, name) || glob(pattern, readable); });
  }
  void find(std::string sentence) { found_.findings.push_back(std::move(sentence)); }

  void match_columns() {
    std::unordered_map<std::string, std::size_t> in_b;
    for (std::size_t i = 0; i < b_.columns.size(); ++i) in_b.emplace(b_.columns[i].name, i);
    for (std::size_t i = 0; i < a_.columns.size(); ++i) {
      const std::string& name = a_.columns[i].name;
      const auto other = in_b.find(name);
      const bool counts = wanted(name);
      if (counts && other == in_b.end()) found_.only_a.push_back(name);
      if (counts && other != in_b.end()) shared_.emplace_back(i, other->second);
      if (other != in_b.end()) in_b.erase(other);
    }
    for (const Column& column : b_.columns) {
      if (in_b.contains(column.name) && wanted(column.name)) found_.only_b.push_back(column.name);
    }
    const auto tell = [&](std::vector<std::string> names, const char* trace) {
      for (std::string& name : names) name = label(name);
      if (!names.empty()) find(fmt::format("{} in {} only: {}", plural(names.size(), "column"), trace, enumerate(names)));
    };
    tell(found_.only_a, "A");
    tell(found_.only_b, "B");
    for (const auto& [i, j] : shared_) {
      const std::string& unit = a_.columns[i].unit;
      const std::string& other = b_.columns[j].unit;
      if (unit != other && !unit.empty() && !other.empty())
        find(fmt::format("{}: in {} in A, in {} in B", label(a_.columns[i].name), unit, other));
    }
  }

  bool has_time(const Trace& trace, const char* which) {
    if (trace.columns.empty() || trace.columns.front().name != "t") {
      find(fmt::format("{} has no first column t: its rows cannot be compared", which));
      return false;
    }
    double before = -INFINITY;
    for (std::size_t row = 0; row < trace.rows(); ++row) {
      const double t = trace.at(row, 0);
      if (std::isfinite(t) && t > before) {
        before = t;
        continue;
      }
      find(fmt::format("{}: t does not increase at row {}: its rows cannot be compared", which, row + 1));
      return false;
    }
    return true;
  }

  void match_rows() {
    const std::size_t rows_a = a_.rows();
    const std::size_t rows_b = b_.rows();
    const double spacing = rows_a > 1 ? (a_.at(rows_a - 1, 0) - a_.at(0, 0)) / static_cast<double>(rows_a - 1) : 1.0;
    for (SharedRow at; at.a < rows_a && at.b < rows_b;) {
      const double late = b_.at(at.b, 0) - a_.at(at.a, 0);
      if (std::abs(late) <= kSameTime * spacing) rows_.push_back(at);
      if (late <= kSameTime * spacing) ++at.b;
      if (late >= -kSameTime * spacing) ++at.a;
    }
    found_.rows = rows_.size();
    if (rows_a != rows_b) find(fmt::format("A has {}, B has {}", plural(rows_a, "row"), rows_b));
    if (rows_.size() < std::min(rows_a, rows_b))
      find(fmt::format("time columns differ: only {} have equal times in A and B", plural(rows_.size(), "row")));
    uniform_ = uniform_rows();
  }

  // Number of evenly spaced shared rows at the start, which allow the search for a shift. The last row may be off the grid.
  [[nodiscard]] std::size_t uniform_rows() const {
    if (rows_.size() < 2) return rows_.size();
    const double spacing = this->spacing();
    std::size_t count = 2;
    while (count < rows_.size() && std::abs(time(count) - time(0) - static_cast<double>(count) * spacing) < 1e-3 * spacing)
      ++count;
    return count;
  }
  [[nodiscard]] double time(std::size_t k) const { return a_.at(rows_[k].a, 0); }
  [[nodiscard]] double spacing() const { return time(1) - time(0); }

  [[nodiscard]] Pair values(std::size_t column, std::size_t other) const {
    Pair pair;
    pair.a.reserve(rows_.size());
    pair.b.reserve(rows_.size());
    for (const SharedRow& at : rows_) {
      pair.a.push_back(a_.at(at.a, column));
      pair.b.push_back(b_.at(at.b, other));
    }
    return pair;
  }

  void tell_nonfinite(const std::string& name, const std::vector<double>& values, const char* which) {
    const auto bad = [](double value) { return !std::isfinite(value); };
    const auto count = static_cast<std::size_t>(std::count_if(values.begin(), values.end(), bad));
    if (count == 0) return;
    const auto first = static_cast<std::size_t>(std::find_if(values.begin(), values.end(), bad) - values.begin());
    find(fmt::format("{}: {} of {} not finite, the first at t = {:.6g} s", name, plural(count, "value"), which, time(first)));
  }

  void compare_column(std::size_t column, std::size_t other) {
    const Pair pair = values(column, other);
    ColumnDifference d;
    d.name = a_.columns[column].name;
    d.label = label(d.name);
    d.unit = a_.columns[column].unit.empty() ? b_.columns[other].unit : a_.columns[column].unit;
    tell_nonfinite(d.label, pair.a, "A");
    tell_nonfinite(d.label, pair.b, "B");
    const auto same = [](double x, double y) { return std::bit_cast<std::uint64_t>(x) == std::bit_cast<std::uint64_t>(y); };
    d.equal = std::equal(pair.a.begin(), pair.a.end(), pair.b.begin(), same);
    measure(pair, d);
    if (!d.equal) diverge(pair, d);
    shift(pair, d);
    found_.columns.push_back(std::move(d));
  }

  static void measure(const Pair& pair, ColumnDifference& d) {
    double low = INFINITY;
    double high = -INFINITY;
    double magnitude = 0;
    double sum = 0;
    std::size_t count = 0;
    for (std::size_t k = 0; k < pair.a.size(); ++k) {
      const double x = pair.a[k];
      const double y = pair.b[k];
      if (!std::isfinite(x) || !std::isfinite(y)) continue;
      low = std::min(low, x);
      high = std::max(high, x);
      magnitude = std::max({magnitude, std::abs(x), std::abs(y)});
      d.maximum = std::max(d.maximum, std::abs(y - x));
      sum += (y - x) * (y - x);
      ++count;
    }
    if (count == 0) return;
    d.rms = std::sqrt(sum / static_cast<double>(count));
    d.range = high - low;
    d.scale = d.range < kFlat ? std::max(magnitude, kFlat) : d.range;
    d.relative_rms = d.rms > 0 ? d.rms / d.scale : 0;
    d.relative_maximum = d.maximum > 0 ? d.maximum / d.scale : 0;
  }

  void diverge(const Pair& pair, ColumnDifference& d) const {
    const double threshold = options_.divergence * d.scale;
    for (std::size_t k = 0; k < pair.a.size() && !d.first_divergence; ++k) {
      const double x = pair.a[k];
      const double y = pair.b[k];
      const bool finite = std::isfinite(x) && std::isfinite(y);
      const bool alike = x == y || (std::isnan(x) && std::isnan(y));
      if (finite ? std::abs(y - x) > threshold : !alike) d.first_divergence = time(k);
    }
  }

  // Searches a time shift. The search is expensive, and therefore limited to columns that differ.
  void shift(const Pair& pair, ColumnDifference& d) const {
    d.rms_after_shift = d.rms;
    const auto finite = [](double value) { return std::isfinite(value); };
    if (!d.first_divergence || uniform_ < 2 || !std::all_of(pair.a.begin(), pair.a.end(), finite) ||
        !std::all_of(pair.b.begin(), pair.b.end(), finite))
      return;
    const TimeShift best = best_shift(std::span(pair.a).first(uniform_), std::span(pair.b).first(uniform_), spacing());
    if (best.time == 0) return;
    d.time_shift = best.time;
    d.rms_after_shift = best.rms;
  }

  const Trace& a_;
  const Trace& b_;
  const CompareOptions& options_;
  TraceDifference found_;
  std::vector<std::pair<std::size_t, std::size_t>> shared_;  // indices of shared columns in A and B
  std::vector<SharedRow> rows_;
  std::size_t uniform_ = 0;
};

}  // namespace

TraceDifference compare(const Trace& a, const Trace& b, const CompareOptions& options) {
  return Comparison(a, b, options).made();
}

}  // namespace gaitlab
