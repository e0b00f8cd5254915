// Tests of the statistics over steps (meter pass): the bits do not depend on the width of registers, and peaks, times and
// shares agree with their definitions.
#include "core/simulation/meter_pass.h"

#include <gtest/gtest.h>

#include <array>
#include <bit>
#include <cstdint>
#include <limits>
#include <random>
#include <vector>

namespace gaitlab {
namespace {

constexpr std::size_t kEntries = 2 * kMeterBlock;
constexpr double kInfinity = std::numeric_limits<double>::infinity();

/// Arrays of a pass. The inputs are in the order of MeterPass, followed by lo, hi, driven, weight, share and seen; the outputs
/// are sums and peaks.
struct Arrays {
  std::array<std::vector<double>, 18> in;
  std::array<std::vector<double>, kJointStatistics.size() + 7> out;

  Arrays() {
    for (auto& values : in) values.assign(kEntries, 0.0);
    for (auto& values : out) values.assign(kEntries, 0.0);
  }
  [[nodiscard]] MeterPass pass(double time, bool instant) {
    MeterPass p;
    p.entries = kEntries;
    p.time = time;
    p.instant = instant;
    p.some = true;
    p.in = {in[0].data(), in[1].data(), in[2].data(), in[3].data(), in[4].data(),  in[5].data(),
            in[6].data(), in[7].data(), in[8].data(), in[9].data(), in[10].data(), in[11].data()};
    p.lo = in[12].data();
    p.hi = in[13].data();
    p.driven = in[14].data();
    p.weight = in[15].data();
    p.share = in[16].data();
    p.seen = in[17].data();
    for (std::size_t k = 0; k < kJointStatistics.size(); ++k) p.sums[k] = out[k].data();
    const auto recent = [&](std::size_t k) { return out[kJointStatistics.size() + k].data(); };
    p.recent = {recent(0), recent(1), recent(2), recent(3), recent(4), recent(5), recent(6)};
    return p;
  }
  [[nodiscard]] double sum(double JointStatistics::*member, std::size_t entry) const {
    std::size_t k = 0;
    while (kJointStatistics[k].member != member) ++k;
    return out[k][entry];
  }
};

void fill(Arrays& arrays, std::mt19937_64& draw) {
  std::uniform_real_distribution<double> number(-2, 2);
  for (auto& values : arrays.in) {
    for (double& value : values) value = number(draw);
  }
  const auto one_of = [&](std::vector<double>& values, std::initializer_list<double> choices) {
    for (double& value : values) value = *(choices.begin() + draw() % choices.size());
  };
  one_of(arrays.in[6], {0, 1, 2});
  one_of(arrays.in[11], {0, 0.5, 1, kInfinity});
  one_of(arrays.in[12], {-kInfinity, -1, -0.0});
  one_of(arrays.in[13], {kInfinity, 1, 0.0});
  one_of(arrays.in[14], {0, 1});
  one_of(arrays.in[17], {0, 1});
  arrays.in[2][3] = -0.0;
  arrays.in[0][5] = std::numeric_limits<double>::quiet_NaN();
}

TEST(MeterPass, BitsDoNotDependOnTheRegisters) {
  if (__builtin_cpu_supports("avx2") == 0) GTEST_SKIP() << "a processor without AVX2";
  std::mt19937_64 draw(7);
  Arrays two;
  Arrays four;
  for (int step = 0; step < 50; ++step) {
    fill(two, draw);
    four.in = two.in;
    add_pass(two.pass(0.1 * step, step % 3 == 0));
    add_pass_avx2(four.pass(0.1 * step, step % 3 == 0));
  }
  for (std::size_t k = 0; k < two.out.size(); ++k) {
    for (std::size_t i = 0; i < kEntries; ++i)
      EXPECT_EQ(std::bit_cast<std::uint64_t>(two.out[k][i]), std::bit_cast<std::uint64_t>(four.out[k][i])) << k << " " << i;
  }
}

TEST(MeterPass, PeaksTimesAndShares) {
  Arrays one;
  one.in[12].assign(kEntries, -1.0);
  one.in[13].assign(kEntries, 1.0);
  one.in[14].assign(kEntries, 1.0);
  for (const std::size_t k : {15U, 16U}) one.in[k].assign(kEntries, 0.25);
  one.in[17].assign(kEntries, 1.0);
  one.in[0][9] = 1.5;  // angle
  one.in[2][9] = -3;   // torque
  one.in[3][9] = 0.5;  // set point
  one.in[6][9] = 2;    // at the current limit
  one.in[11][9] = 4;   // available torque
  add_pass(one.pass(0.5, false));
  one.in[2][9] = 2;
  one.in[6][9] = 1;
  add_pass(one.pass(0.75, false));
  EXPECT_EQ(one.sum(&JointStatistics::torque_peak, 9), 3);
  EXPECT_EQ(one.sum(&JointStatistics::torque_peak_time, 9), 0.5);
  EXPECT_EQ(one.sum(&JointStatistics::torque_rms, 9), 0.25 * (9 + 4));
  EXPECT_EQ(one.sum(&JointStatistics::error_peak, 9), 1);
  EXPECT_EQ(one.sum(&JointStatistics::error_rms, 9), 0.5);
  EXPECT_EQ(one.sum(&JointStatistics::saturated_current, 9), 0.25);
  EXPECT_EQ(one.sum(&JointStatistics::saturated_voltage, 9), 0.25);
  EXPECT_EQ(one.sum(&JointStatistics::range_share, 9), 0.5);
  EXPECT_EQ(one.sum(&JointStatistics::range_worst, 9), 0.5);
  EXPECT_EQ(one.out[kJointStatistics.size() + 2][9], 2) << "the limit at the peak";
  EXPECT_EQ(one.out[kJointStatistics.size() + 4][9], 0.75) << "share of what there is";
  EXPECT_EQ(one.sum(&JointStatistics::torque_peak, 8), 0);
}

}  // namespace
}  // namespace gaitlab
