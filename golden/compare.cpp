#include "golden/compare.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "core/recording/column_names.h"
#include "core/recording/time_shift.h"

namespace gaitlab::golden {

namespace {

constexpr double kSameTime = 1e-6;  // share of the row spacing
constexpr std::size_t kNamesShown = 8;

std::string enumerate(const std::vector<std::string>& names) {
  const auto shown = names.begin() + static_cast<std::ptrdiff_t>(std::min(names.size(), kNamesShown));
  const std::string text = fmt::format("{}", fmt::join(names.begin(), shown, ", "));
  return names.size() <= kNamesShown ? text : fmt::format("{} and {} more", text, names.size() - kNamesShown);
}

double spacing(const Trace& trace) { return trace.rows() > 1 ? trace.at(1, 0) - trace.at(0, 0) : 0; }

class Comparison {
 public:
  Comparison(const Golden& golden, const GoldenRun& run, bool other_engine, const GoldenRun* halved)
      : golden_(golden),
        a_(golden.run.trace),
        b_(run.trace),
        run_(run),
        names_{run.joints, {}},
        other_engine_(other_engine),
        halved_(halved),
        rows_(std::min(a_.rows(), b_.rows())) {}

  GoldenDifference made() {
    match_starts();
    if (found_.findings.empty()) match_columns();
    match_rows();
    const std::vector<double> scale = scales(a_, golden_.bands);
    for (std::size_t i = 1; i < a_.columns.size(); ++i) {
      const std::size_t j = b_.find(a_.columns[i].name);
      if (j < b_.columns.size() && finite(j)) compare_column(i, j, scale[i]);
    }
    compare_numbers();
    return std::move(found_);
  }

 private:
  [[nodiscard]] std::string label(const std::string& column) const { return readable_column(column, names_); }
  void find(std::string sentence) { found_.findings.push_back(std::move(sentence)); }

  /// Numbers of one run are not compared with means, which a golden has if a sensor has a resolution.
  void match_starts() {
    if (golden_.starts == run_.starts) return;
    find(golden_.starts == 1 ? "a sensor has a resolution, so that this run has means over starts, but the golden is of one run"
         : run_.starts == 1  ? "no sensor has a resolution, so that this is one run, but the golden has means over starts"
                             : fmt::format("means over {} starts, in the golden over {}", run_.starts, golden_.starts));
  }

  void match_columns() {
    const auto missing = [&](const Trace& from, const Trace& in) {
      std::vector<std::string> names;
      for (const Column& column : from.columns) {
        if (in.find(column.name) == in.columns.size()) names.push_back(label(column.name));
      }
      return names;
    };
    const auto tell = [&](const std::vector<std::string>& names, const char* where) {
      if (!names.empty())
        find(fmt::format("{} column{} only in {}: {}", names.size(), names.size() == 1 ? "" : "s", where, enumerate(names)));
    };
    tell(missing(a_, b_), "the golden");
    tell(missing(b_, a_), "this run");
  }

  // Compares the number and times of rows. Rows at other times are not compared, because every column would fail without a
  // useful reason.
  void match_rows() {
    const double golden = spacing(a_);
    const double now = spacing(b_);
    if (rows_ > 1 && !(std::abs(golden - now) <= kSameTime * golden)) {
      find(fmt::format("a row every {:.6g} s, in the golden every {:.6g} s", now, golden));
      rows_ = 0;
    }
    if (a_.rows() != b_.rows()) find(fmt::format("{} rows, in the golden {}", b_.rows(), a_.rows()));
  }

  bool finite(std::size_t column) {
    for (std::size_t k = 0; k < b_.rows(); ++k) {
      if (std::isfinite(b_.at(k, column))) continue;
      find(fmt::format("{} is not finite at t = {:.6g} s", label(b_.columns[column].name), b_.at(k, 0)));
      return false;
    }
    return true;
  }

  void compare_column(std::size_t i, std::size_t j, double scale) {
    if (rows_ == 0) return;
    ColumnCheck check{a_.columns[i].name, label(a_.columns[i].name), a_.columns[i].unit};
    check.band =
        golden_.bands[i].width() + (halved_ ? kHalvingFactor * std::sqrt(mean_square(b_, halved_->trace, j)) / scale : 0);
    check.scale = scale;
    check.constant = golden_.bands[i].constant > 0;
    std::vector<double> golden;
    std::vector<double> now;
    double sum = 0;
    for (std::size_t k = 0; k < rows_; ++k) {
      golden.push_back(a_.at(k, i));
      now.push_back(b_.at(k, j));
      const double d = now[k] - golden[k];
      sum += d * d;
      const double apart =
          (std::abs(d) - 0.5 * golden_.run.precision[i]) / scale;  // lower bound of the difference before rounding
      check.maximum = std::max(check.maximum, apart);
      if (!check.outside && apart > kOutside * check.band) check.outside = a_.at(k, 0);
    }
    const auto share = [&](double square) { return std::sqrt(std::max(0.0, square - golden_.rounding[i])) / scale; };
    check.rms = share(sum / static_cast<double>(rows_));
    const TimeShift shift = rows_ > 1 && check.rms > 0 ? best_shift(golden, now, spacing(a_)) : TimeShift{};
    check.time_shift = shift.time;
    check.rms_after_shift = shift.time == 0 ? check.rms : share(shift.rms * shift.rms);
    found_.columns.push_back(std::move(check));
  }

  void compare_numbers() {
    const std::vector<double> scale = scales(golden_.numbers);
    for (std::size_t i = 0; i < golden_.numbers.size(); ++i) {
      const GoldenNumber& number = golden_.numbers[i];
      if (other_engine_ && number.name.ends_with(".torque.peak")) continue;
      const auto now =
          std::find_if(run_.numbers.begin(), run_.numbers.end(), [&](const GoldenNumber& n) { return n.name == number.name; });
      if (now == run_.numbers.end()) {
        find(fmt::format("{} is only in the golden", readable_number(number.name)));
        continue;
      }
      if (!std::isfinite(now->value)) find(fmt::format("{} is not finite", readable_number(number.name)));
      const double change = std::abs(now->value - number.value) / scale[i];
      const double band = std::max(golden_.number_bands[i].width(), other_engine_ ? kOtherEngine : 0.0);
      const auto index = static_cast<std::size_t>(now - run_.numbers.begin());
      const double own = halved_ ? kHalvingFactor * std::abs(halved_->numbers[index].value - now->value) / scale[i] : 0;
      found_.numbers.push_back(
          {number.name, readable_number(number.name), number.unit, number.value, now->value, change, band + own});
    }
  }

  const Golden& golden_;
  const Trace& a_;
  const Trace& b_;
  const GoldenRun& run_;
  PartNames names_;
  bool other_engine_;
  const GoldenRun* halved_;  // null if not given
  std::size_t rows_;
  GoldenDifference found_;
};

// The check with the largest ratio. NaN counts as the largest.
template <class Check>
const Check* worst(const std::vector<Check>& checks) {
  const auto better = [](const Check& a, const Check& b) {
    return std::isnan(b.ratio()) ? !std::isnan(a.ratio()) : a.ratio() < b.ratio();
  };
  const auto found = std::max_element(checks.begin(), checks.end(), better);
  return found == checks.end() ? nullptr : &*found;
}

}  // namespace

bool GoldenDifference::passed() const {
  const auto passes = [](const auto& check) { return check.passed(); };
  return findings.empty() && std::all_of(columns.begin(), columns.end(), passes) &&
         std::all_of(numbers.begin(), numbers.end(), passes) && std::all_of(bounds.begin(), bounds.end(), passes);
}

const ColumnCheck* GoldenDifference::worst_column() const { return worst(columns); }

const NumberCheck* GoldenDifference::worst_number() const { return worst(numbers); }

const BoundCheck* GoldenDifference::worst_bound() const { return worst(bounds); }

GoldenDifference compare(const Golden& golden, const GoldenRun& run, bool other_engine, const GoldenRun* halved) {
  return Comparison(golden, run, other_engine, halved).made();
}

}  // namespace gaitlab::golden
