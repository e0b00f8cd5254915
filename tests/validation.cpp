#include "tests/validation.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cerrno>
#include <cmath>
#include <cstdlib>
#include <fstream>
#include <nlohmann/json.hpp>
#include <stdexcept>

namespace gaitlab::test {
namespace {

double scale() {
  const char* text = std::getenv("GAITLAB_TOL_SCALE");
  if (text == nullptr || *text == '\0') return 1;
  char* end = nullptr;
  const double value = std::strtod(text, &end);
  if (*end != '\0' || !std::isfinite(value) || value < 0)
    throw std::runtime_error("GAITLAB_TOL_SCALE is not a number of at least 0");
  return value;
}

/// Text of a value with one digit more than the tolerance can distinguish.
std::string rounded(double value, double tolerance) {
  if (!std::isfinite(value)) return fmt::format("{}", value);
  const double digits = std::ceil(std::log10(std::max(std::abs(value), tolerance) / tolerance)) + 1;
  return fmt::format("{:.{}g}", value, static_cast<int>(std::clamp(digits, 2.0, 15.0)));
}

struct Check {
  std::string measured, required;
  double residual = 0, tolerance = 0;
};

void report(const Row& row, const Check& check, const std::string& reason) {
  const double factor = scale();
  // This comparison is also false if the residual is NaN.
  const bool inside = check.residual <= check.tolerance * factor && factor > 0;
  const std::string unit = row.unit.empty() ? "" : " " + row.unit;
  const std::string by = check.residual > 0 ? fmt::format("{:.2g}", check.tolerance / check.residual) : "exact";
  if (!inside) {
    ADD_FAILURE() << row.id << ": " << row.what << ": measured " << check.measured << unit << ", required " << check.required
                  << unit << fmt::format(": residual {:.2g}, tolerance {:.2g}", check.residual, check.tolerance)
                  << fmt::format(" times {:g}", factor) << " (" << reason << "), inside by " << by;
  }
  const char* file = std::getenv("GAITLAB_VALIDATION");
  if (file == nullptr || *file == '\0') return;
  const auto* test = testing::UnitTest::GetInstance()->current_test_info();
  const nlohmann::ordered_json line{{"id", row.id},
                                    {"what", row.what},
                                    {"source", row.source},
                                    {"unit", row.unit},
                                    {"measured", check.measured},
                                    {"required", check.required},
                                    {"reason", reason},
                                    {"residual", fmt::format("{:.2g}", check.residual)},
                                    {"tolerance", fmt::format("{:.2g}", check.tolerance)},
                                    {"inside_by", by},
                                    // Number by which the page selects the worst value of an id.
                                    {"share", std::isfinite(check.residual) ? check.residual / check.tolerance : 1e300},
                                    {"command", fmt::format("{} --gtest_filter={}.{}", program_invocation_short_name,
                                                            test->test_suite_name(), test->name())}};
  std::ofstream out(file, std::ios::app);
  out << line.dump() + "\n" << std::flush;
  if (!out) throw std::runtime_error(std::string("cannot write ") + file);
}

}  // namespace

void validate(const Row& row, double measured, double expected, double tolerance, const std::string& reason) {
  report(row,
         {rounded(measured, tolerance), fmt::format("{} ± {:.2g}", rounded(expected, tolerance), tolerance),
          std::abs(measured - expected), tolerance},
         reason);
}

void validate_below(const Row& row, double measured, double limit, const std::string& reason) {
  const double residual = measured < 0 ? std::nan("") : measured;
  report(row, {fmt::format("{:.2g}", measured), fmt::format("≤ {:.2g}", limit), residual, limit}, reason);
}

}  // namespace gaitlab::test
