// Tests of the rows of docs/validation.md: tolerances, the effect of GAITLAB_TOL_SCALE, written lines.
#include "tests/validation.h"

#include <gtest/gtest-spi.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>

namespace gaitlab::test {
namespace {

const Row kRow{"test.row", "a third", "arithmetic", "m"};

/// Fixture that restores the two environment variables. Its rows do not appear on the page.
class Validation : public testing::Test {
 protected:
  void SetUp() override {
    for (const char* name : {"GAITLAB_TOL_SCALE", "GAITLAB_VALIDATION"}) {
      const char* value = std::getenv(name);
      if (value != nullptr) before_.emplace_back(name, value);
      unsetenv(name);
    }
  }
  void TearDown() override {
    for (const char* name : {"GAITLAB_TOL_SCALE", "GAITLAB_VALIDATION"}) unsetenv(name);
    for (const auto& [name, value] : before_) setenv(name.c_str(), value.c_str(), 1);
  }

 private:
  std::vector<std::pair<std::string, std::string>> before_;
};

TEST_F(Validation, TheToleranceIsTheLimit) {
  validate(kRow, 1.5, 1, 0.5, "exact numbers");
  EXPECT_NONFATAL_FAILURE(validate(kRow, 1.5, 1, 0.25, "exact numbers"), "residual 0.5, tolerance 0.25");
  EXPECT_NONFATAL_FAILURE(validate(kRow, 0.5, 1, 0.25, "exact numbers"), "test.row");
  validate_below(kRow, 0.25, 0.25, "exact numbers");
  EXPECT_NONFATAL_FAILURE(validate_below(kRow, 0.5, 0.25, "exact numbers"), "required ≤ 0.25 m");
}

TEST_F(Validation, WhatIsNoNumberIsNotInside) {
  EXPECT_NONFATAL_FAILURE(validate(kRow, std::nan(""), 1, 0.5, "exact numbers"), "residual nan");
  EXPECT_NONFATAL_FAILURE(validate_below(kRow, -1, 0.25, "exact numbers"), "residual nan");
}

TEST_F(Validation, TheScaleScalesAndZeroShowsAll) {
  setenv("GAITLAB_TOL_SCALE", "2", 1);
  validate(kRow, 2, 1, 0.5, "exact numbers");
  setenv("GAITLAB_TOL_SCALE", "0", 1);
  EXPECT_NONFATAL_FAILURE(validate(kRow, 1, 1, 0.5, "exact numbers"), "residual 0, tolerance 0.5 times 0");
  setenv("GAITLAB_TOL_SCALE", "much", 1);
  EXPECT_THROW(validate(kRow, 1, 1, 0.5, ""), std::runtime_error);
}

TEST_F(Validation, ALineIsAppendedForEveryRow) {
  const std::string file =
      (std::filesystem::temp_directory_path() / ("gaitlab-validation-" + std::to_string(getpid()) + ".json")).string();
  std::filesystem::remove(file);
  setenv("GAITLAB_VALIDATION", file.c_str(), 1);
  validate(kRow, 0.3333, 1.0 / 3, 1e-3, "four digits");
  validate_below(kRow, 0, 1, "none");
  std::ifstream in(file);
  std::string line;
  ASSERT_TRUE(std::getline(in, line));
  const auto first = nlohmann::json::parse(line);
  EXPECT_EQ(first["id"], "test.row");
  EXPECT_EQ(first["measured"], "0.3333");
  EXPECT_EQ(first["required"], "0.3333 ± 0.001");
  EXPECT_EQ(first["residual"], "3.3e-05");
  EXPECT_EQ(first["inside_by"], "30");
  EXPECT_EQ(first["command"], "core_tests --gtest_filter=Validation.ALineIsAppendedForEveryRow");
  ASSERT_TRUE(std::getline(in, line));
  EXPECT_EQ(nlohmann::json::parse(line)["inside_by"], "exact");
  std::filesystem::remove(file);
}

}  // namespace
}  // namespace gaitlab::test
