#include "core/settings/periods.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>

#include "core/math/periods.h"
#include "core/settings/wording.h"

namespace gaitlab {
namespace {

constexpr double kTolerance = 1e-9;  // relative deviation of a ratio from the nearest whole number

/// Largest period of which a and b are whole multiples, by Euclid's algorithm. Returns 0 if no such period is above 1e-7 times
/// the smaller of a and b.
double common_divisor(double a, double b) {
  const double smallest = std::min(a, b) * 1e-7;
  while (b > smallest) {
    const double rest = a - b * std::round(a / b);
    a = b;
    b = std::abs(rest);
    if (b <= a * 1e-7) return a;
  }
  return 0;
}

/// Rounds to 12 digits, far within the tolerance, because messages must contain 0.015 instead of 0.015000000000000001.
double rounded(double value) {
  const std::string text = fmt::format("{:.12g}", value);
  std::from_chars(text.data(), text.data() + text.size(), value);
  return value;
}

std::size_t digits(double value) {
  const std::string text = number_text(value);
  const std::size_t exponent = text.find('e');
  std::size_t count = 0;
  bool leading = true;
  for (const char c : text.substr(0, exponent)) {
    leading = leading && (c == '0' || c == '.');
    if (!leading && c != '.') ++count;
  }
  return count;
}

/// A short decimal divisor/k near k = `first`, searched in the direction of `towards` (+1 or -1 for k). If no short decimal is
/// near, the nearest step that divides all periods, or 0 if there is none.
double fitting(const std::vector<double>& periods, double divisor, double first, double towards) {
  const auto fits = [&](double step) {
    return std::all_of(periods.begin(), periods.end(), [&](double period) { return math::whole_steps(period, step) > 0; });
  };
  const double last = towards > 0 ? first * 2 : std::max(1.0, std::floor(first / 2));
  double nearest = 0;
  for (double k = first; (last - k) * towards >= 0 && std::abs(k - first) < 5000; k += towards) {
    const double step = rounded(divisor / k);
    if (!fits(step)) continue;
    if (digits(step) <= 4) return step;
    if (nearest == 0) nearest = step;
  }
  return nearest;
}

std::string values(const std::string& heading, const std::vector<double>& list) {
  std::string out;
  for (const double value : list) out += (out.empty() ? heading : ", ") + number_text(value);
  return out;
}

}  // namespace

bool is_multiple(double period, double step) { return math::whole_steps(period, step) > 0; }

double longest_step(double control_period) {
  return control_period / std::max(1.0, std::ceil(control_period / kLongestStep - kTolerance));
}

std::vector<double> fitting_steps(const std::vector<double>& periods, double step) {
  double divisor = periods.front();
  for (const double period : periods) divisor = divisor > 0 ? common_divisor(divisor, period) : 0;
  if (!(divisor > 0)) return {};
  const double ratio = divisor / step;
  std::vector<double> out;
  if (const double smaller = fitting(periods, divisor, std::max(1.0, std::ceil(ratio)), 1); smaller > 0) out.push_back(smaller);
  if (std::floor(ratio) >= 1) {
    if (const double larger = fitting(periods, divisor, std::floor(ratio), -1); larger > 0) out.push_back(larger);
  }
  out.erase(std::unique(out.begin(), out.end()), out.end());
  return out;
}

std::vector<double> fitting_periods(double period, double step) {
  std::vector<double> out;
  for (const double count : {std::floor(period / step), std::ceil(period / step)}) {
    if (count >= 1) out.push_back(rounded(count * step));
  }
  out.erase(std::remove_if(out.begin(), out.end(), [&](double p) { return math::whole_steps(p, step) == 0; }), out.end());
  return out;
}

void check_periods(const std::vector<Period>& periods, const Period& step, const SourceLocation& otherwise,
                   Problems& problems) {
  std::vector<double> all;
  all.reserve(periods.size());
  for (const Period& period : periods) all.push_back(period.value);
  for (const Period& period : periods) {
    if (math::whole_steps(period.value, step.value) > 0) continue;
    std::string text =
        fmt::format("{} {} s is not a whole multiple of the {} {} s ({} steps)", period.name, number_text(period.value),
                    step.name, number_text(step.value), fmt::format("{:.12g}", period.value / step.value));
    if (step.given || !period.given) {
      std::vector<double> steps = fitting_steps(all, step.value);
      if (steps.empty()) steps = fitting_steps({period.value}, step.value);
      text += values("; steps that fit: ", steps);
    }
    if (period.given) text += values("; periods that fit: ", fitting_periods(period.value, step.value));
    problems.add(period.given ? *period.given : step.given ? *step.given : otherwise, std::move(text));
  }
}

}  // namespace gaitlab
