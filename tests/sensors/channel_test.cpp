// Tests of a sensor channel against an independent implementation of its equations, and against the moments of its draws.
#include "sensors/channel.h"

#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <numeric>

#include "tests/validation.h"

namespace gaitlab::sensors {
namespace {

using test::validate;

constexpr double kPeriod = 0.015;  // s
const RobotInfo kNoRobot;

ChannelKeys keys() { return ChannelKeys(kRadian); }

Channel channel(const ChannelKeys& keys, const std::string& name = "encoder.m0/active", std::uint64_t seed = 1,
                std::size_t size = 1) {
  return {keys, {kNoRobot, "encoder", seed, kPeriod}, name, size};
}

/// A curve without repetitions: 0.7 sin(k) + k / 100.
double curve(std::int64_t k) { return 0.7 * math::sin(static_cast<double>(k)) + 0.01 * static_cast<double>(k); }

template <class Curve>
std::vector<double> values(const Channel& channel, std::int64_t ticks, const Curve& truth) {
  std::vector<double> state(channel.states(), NAN);  // a number that is read before it is set is then detected
  std::vector<double> all;
  for (std::int64_t k = 0; k < ticks; ++k) {
    const std::vector<double> x(channel.size(), truth(k));
    std::vector<double> y(channel.size());
    channel.sense(k, x, state, y);
    all.insert(all.end(), y.begin(), y.end());
  }
  return all;
}

std::vector<double> zeros(const Channel& channel, std::int64_t ticks) {
  return values(channel, ticks, [](std::int64_t) { return 0.0; });
}

double deviation(const std::vector<double>& all) {
  double sum = 0;
  double squares = 0;
  for (const double x : all) {
    sum += x;
    squares += x * x;
  }
  const auto n = static_cast<double>(all.size());
  return std::sqrt(squares / n - sum / n * (sum / n));
}

TEST(Channel, WalksOnWhileSamplesAreLost) {
  ChannelKeys whole = keys(), lossy = keys();
  whole.walk = lossy.walk = 0.2;
  lossy.lost = 0.5;
  const std::vector<double> all = zeros(channel(whole), 400);
  const std::vector<double> some = zeros(channel(lossy), 400);
  std::size_t received = 0;
  for (std::size_t k = 1; k < all.size(); ++k) {
    if (some[k] == some[k - 1]) continue;  // lost
    EXPECT_EQ(some[k], all[k]) << k;
    ++received;
  }
  EXPECT_NEAR(static_cast<double>(received), 200, 40) << "four standard errors, 4 sqrt(400 / 4)";
}

TEST(Channel, GivesTheTrueValueByDefault) {
  const std::vector<double> y = values(channel(keys()), 50, curve);
  for (std::int64_t k = 0; k < 50; ++k) EXPECT_EQ(y[static_cast<std::size_t>(k)], curve(k)) << k;
}

TEST(Channel, QuantisesToTheGrid) {
  ChannelKeys k = keys();
  k.resolution = 0.00511;
  const std::vector<double> y = values(channel(k), 500, curve);
  for (std::int64_t i = 0; i < 500; ++i) {
    const double x = curve(i);
    const double at = y[static_cast<std::size_t>(i)];
    EXPECT_EQ(at, k.resolution * std::round(at / k.resolution)) << "on the grid, bit for bit";
    EXPECT_LE(std::abs(at - x), k.resolution / 2 * (1 + 1e-12)) << "the nearest point, to the rounding of the quotient";
  }
  // Half a step is rounded up, also below 0.
  k.resolution = 0.5;
  EXPECT_EQ(values(channel(k), 1, [](std::int64_t) { return 0.25; })[0], 0.5);
  EXPECT_EQ(values(channel(k), 1, [](std::int64_t) { return -0.25; })[0], 0);
}

// Quantisation error of a curve that crosses many steps: q / sqrt(12) (Widrow and Kollar). With n = 20000 values its deviation
// is known to 0.3 %: the fourth moment of a uniform error is 9/5 of the square of the second.
TEST(Channel, QuantisationErrorIsUniform) {
  ChannelKeys k = keys();
  k.resolution = 0.00511;
  std::vector<double> error = values(channel(k), 20000, curve);
  for (std::size_t i = 0; i < error.size(); ++i) error[i] -= curve(static_cast<std::int64_t>(i));
  validate({"closed.encoder_quantisation", "RMS error of an encoder's steps over q / sqrt(12)", "Widrow and Kollar 2008", ""},
           deviation(error) / (k.resolution / std::sqrt(12)), 1, 0.01, "three standard errors of 20 000 uniform errors");
}

TEST(Channel, DelaysByWholeTicks) {
  for (const std::int64_t d : {1, 2, 7}) {
    ChannelKeys k = keys();
    k.delay_least = k.delay_most = static_cast<double>(d) * kPeriod;
    const std::vector<double> y = values(channel(k), 60, curve);
    for (std::int64_t i = 0; i < 60; ++i) {
      EXPECT_EQ(y[static_cast<std::size_t>(i)], curve(std::max<std::int64_t>(0, i - d))) << d << ", " << i;
    }
  }
}

// The first number of the stream and the moments of 20000 draws are known (tests/core/math/philox_test.cpp).
TEST(Channel, NoiseIsTheStreamOfSeedAndName) {
  ChannelKeys k = keys();
  k.noise = 1;
  const std::vector<double> y = zeros(channel(k), 20000);
  EXPECT_NEAR(y[0], 0.6438930316106422, 4e-16);
  EXPECT_NEAR(deviation(y), 1, 0.01);
  EXPECT_NE(zeros(channel(k, "encoder.m0/passive"), 1)[0], y[0]);
  EXPECT_NE(zeros(channel(k, "encoder.m0/active", 2), 1)[0], y[0]);
}

TEST(Channel, ClampsAfterNoiseAndBeforeTheGrid) {
  ChannelKeys k = keys();
  k.noise = 10;
  k.range = {-0.3, 0.4};
  k.resolution = 0.25;
  std::size_t at_the_ends = 0;
  for (const double y : zeros(channel(k), 1000)) {
    EXPECT_TRUE(y == -0.25 || y == 0 || y == 0.25 || y == 0.5) << y;  // 0.4 is rounded to 0.5
    if (y == -0.25 || y == 0.5) ++at_the_ends;
  }
  EXPECT_GT(at_the_ends, 900U);  // 97 % of the draws are out of range
}

TEST(Channel, SamplesAtItsOwnPeriodAndHolds) {
  ChannelKeys k = keys();
  k.period = 4 * kPeriod;
  k.delay_least = k.delay_most = kPeriod;
  const Channel c = channel(k);
  const std::vector<double> y = values(c, 40, curve);
  for (std::int64_t i = 0; i < 40; ++i) {
    const std::int64_t sample = i == 0 ? 0 : (i - 1) / 4 * 4;
    EXPECT_EQ(y[static_cast<std::size_t>(i)], curve(sample)) << i;
    EXPECT_EQ(c.arrives(i), i % 4 == 1) << i;
  }
  // The noise of a sample is that of its tick, whatever the period.
  k.delay_least = k.delay_most = 0;
  k.noise = 1;
  const std::vector<double> slow = zeros(channel(k), 12);
  k.period = 0;
  EXPECT_EQ(slow[8], zeros(channel(k), 12)[8]);
}

TEST(Channel, HoldsTheLastSampleWhereOneIsLost) {
  ChannelKeys k = keys();
  k.lost = 0.3;
  constexpr std::int64_t kTicks = 20000;
  const std::vector<double> y = values(channel(k), kTicks, curve);
  EXPECT_EQ(y[0], curve(0));
  std::size_t lost = 0;
  for (std::size_t i = 1; i < y.size(); ++i) {
    if (y[i] == curve(static_cast<std::int64_t>(i))) continue;
    EXPECT_EQ(y[i], y[i - 1]);
    ++lost;
  }
  // The tolerance is four standard errors of a share of 0.3, 4 sqrt(0.21 / 20000).
  validate({"closed.encoder_losses", "share of lost samples, lost: 0.3", "binomial distribution", ""},
           static_cast<double>(lost) / kTicks, 0.3, 0.013, "four standard errors of 20 000 samples, 4 sqrt(0.21/20000)");
  k.lost = 1;
  for (const double one : values(channel(k), 20, curve)) EXPECT_EQ(one, curve(0));
}

TEST(Channel, LossesAreCommonToTheNumbersOfAVectorAndNoiseIsNot) {
  ChannelKeys k = keys();
  k.noise = 1;
  k.lost = 0.5;
  const std::vector<double> y = zeros(channel(k, "imu.gyro", 1, 3), 200);
  std::size_t held = 0;
  for (std::size_t i = 3; i < y.size(); i += 3) {
    const bool lost = y[i] == y[i - 3];
    EXPECT_EQ(y[i + 1] == y[i - 2], lost);
    EXPECT_EQ(y[i + 2] == y[i - 1], lost);
    EXPECT_NE(y[i], y[i + 1]);
    held += lost ? 1 : 0;
  }
  EXPECT_GT(held, 50U);
}

/// Values of 2000 channels with different names at tick `ticks` - 1. Their standard deviation is known to 1.6 %.
std::vector<double> ensemble(const ChannelKeys& keys, std::int64_t ticks) {
  std::vector<double> ends;
  for (int i = 0; i < 2000; ++i) ends.push_back(zeros(channel(keys, "channel-" + std::to_string(i)), ticks).back());
  return ends;
}

// Four standard errors of a standard deviation from 2000 draws, 4 / sqrt(4000).
constexpr double kFourErrors = 0.064;

TEST(Channel, WalkGrowsAsTheRootOfTime) {
  ChannelKeys k = keys();
  k.walk = 0.2;
  for (const std::int64_t n : {1, 4, 67}) {
    validate({"closed.sensor_walk", "deviation of a walk over walk sqrt(t), 2000 seeds", "random walk, IEEE Std 952-1997", ""},
             deviation(ensemble(k, n)) / (0.2 * std::sqrt(static_cast<double>(n) * kPeriod)), 1, kFourErrors,
             "four standard errors of 2000 draws, 4/sqrt(4000)");
  }
  // With a separate period the walk makes fewer and longer steps, 17 samples of four ticks.
  k.period = 4 * kPeriod;
  EXPECT_NEAR(deviation(ensemble(k, 68)) / (0.2 * std::sqrt(68 * kPeriod)), 1, kFourErrors);
}

TEST(Channel, WalkOfACorrelationTimeIsBounded) {
  ChannelKeys k = keys();
  k.walk = 0.2;
  k.walk_time = 0.1;
  // After ten correlation times, the deviation is walk sqrt(tau / 2).
  const std::string source = "first-order Gauss-Markov process, IEEE Std 952-1997, annex B";
  validate(
      {"closed.sensor_markov_deviation", "deviation of a bounded walk after ten correlation times, 2000 seeds", source, ""},
      deviation(ensemble(k, 67)) / (0.2 * std::sqrt(0.05)), 1, kFourErrors, "four standard errors of 2000 draws, 4/sqrt(4000)");
  // The correlation over a tick is e^(-Ts / tau). Its standard deviation over 20000 ticks is below sqrt(1 / 20000).
  const std::vector<double> y = zeros(channel(k), 20000);
  double product = 0;
  double square = 0;
  for (std::size_t i = 1; i < y.size(); ++i) {
    product += y[i] * y[i - 1];
    square += y[i] * y[i];
  }
  validate({"closed.sensor_markov_correlation", "correlation of a bounded walk over one tick", source, ""}, product / square,
           std::exp(-kPeriod / 0.1), 4 * std::sqrt(1.0 / 20000), "four standard errors over 20 000 ticks");
  // With a long correlation time, the walk is that without a bound, except for Ts / tau.
  k.walk_time = 1e6;
  ChannelKeys unbounded = k;
  unbounded.walk_time = 0;
  EXPECT_NEAR(zeros(channel(k), 100).back(), zeros(channel(unbounded), 100).back(), 1e-6);
}

TEST(Channel, ZeroAndGainAreDrawnOnceARun) {
  ChannelKeys k = keys();
  k.zero = 0.02;
  k.bias = 1;
  const std::vector<double> y = zeros(channel(k), 20);
  for (const double one : y) EXPECT_EQ(one, y[0]);
  EXPECT_NE(y[0], 1);
  EXPECT_NEAR(deviation(ensemble(k, 1)) / 0.02, 1, kFourErrors);
  ChannelKeys g = keys();
  g.gain = 2;
  g.gain_deviation = 0.1;
  const std::vector<double> scaled = values(channel(g), 20, curve);
  const double gain = scaled[5] / curve(5);
  EXPECT_NE(gain, 2);
  for (std::int64_t i = 0; i < 20; ++i) {
    EXPECT_NEAR(scaled[static_cast<std::size_t>(i)], gain * curve(i), 1e-15);  // rounding error of a quotient below 3
  }
}

TEST(Channel, DelayInARangeIsDrawnOnceARunWithEqualChances) {
  ChannelKeys k = keys();
  k.delay_least = kPeriod;
  k.delay_most = 3 * kPeriod;
  std::array<int, 5> count{};
  for (int i = 0; i < 3000; ++i) ++count[static_cast<std::size_t>(channel(k, "c" + std::to_string(i)).delay())];
  EXPECT_EQ(count[0] + count[4], 0);
  // The tolerance is four standard errors of a third of 3000, 4 sqrt(3000 * 2 / 9).
  for (const std::size_t d : {1U, 2U, 3U}) EXPECT_NEAR(count[d], 1000, 104) << d;
}

using Columns = std::map<std::string, std::vector<double>>;

/// Adds numbers that show the draws of a channel with the errors `keys`. The true value is 0 at tick 0 and `truth` at tick 1.
void add_draws(Columns& all, const std::string& name, const ChannelKeys& keys, double truth, std::size_t size = 3) {
  for (int c = 0; c < 10000; ++c) {
    const Channel one = channel(keys, "channel-" + std::to_string(c), 1, size);
    const std::vector<double> y = values(one, 2, [&](std::int64_t tick) { return truth * static_cast<double>(tick); });
    for (std::size_t i = 0; i < size; ++i) all[name + "." + std::to_string(i)].push_back(y[size + i]);
  }
}

void subtract_mean(std::vector<double>& all) {
  double sum = 0;
  for (const double x : all) sum += x;
  for (double& x : all) x -= sum / static_cast<double>(all.size());
}

/// The columns and the magnitudes of the normal numbers, all with the mean 0. The uniform number from which a normal one is
/// computed determines its magnitude, not its sign.
Columns with_magnitudes(Columns all) {
  for (auto& [name, column] : all) subtract_mean(column);
  Columns magnitudes;
  for (const auto& [name, column] : all) {
    if (name == "lost.0" || name == "delay.0") continue;  // uniform
    for (const double x : column) magnitudes["|" + name + "|"].push_back(std::abs(x));
    subtract_mean(magnitudes["|" + name + "|"]);
  }
  all.merge(magnitudes);
  return all;
}

double correlation(const std::vector<double>& a, const std::vector<double>& b) {
  const auto product = [](const auto& x, const auto& y) { return std::inner_product(x.begin(), x.end(), y.begin(), 0.0); };
  return product(a, b) / std::sqrt(product(a, a) * product(b, b));
}

/// No two draws of a channel are the same number. The bound 0.05 is five standard errors of a correlation over 10 000 channels.
TEST(Channel, DrawsAreIndependentOfEachOther) {
  ChannelKeys noise = keys(), walk = keys(), zero = keys(), gain = keys(), lost = keys(), delay = keys();
  noise.noise = walk.walk = zero.zero = gain.gain_deviation = 1;
  lost.lost = 0.5;
  delay.delay_most = 9 * kPeriod;
  Columns draws;
  add_draws(draws, "noise", noise, 0);
  add_draws(draws, "walk", walk, 0);
  add_draws(draws, "zero", zero, 0);
  add_draws(draws, "gain", gain, 1);
  add_draws(draws, "lost", lost, 1, 1);
  for (int c = 0; c < 10000; ++c)
    draws["delay.0"].push_back(static_cast<double>(channel(delay, "channel-" + std::to_string(c)).delay()));
  const Columns all = with_magnitudes(draws);
  ASSERT_EQ(all.size(), 2 * 12 + 2U);
  for (auto a = all.begin(); a != all.end(); ++a) {
    for (auto b = std::next(a); b != all.end(); ++b)
      EXPECT_LT(std::abs(correlation(a->second, b->second)), 0.05) << a->first << " and " << b->first;
  }
}

TEST(Channel, StateIsCompleteWithinADelay) {
  ChannelKeys k = keys();
  k.delay_least = k.delay_most = 5 * kPeriod;
  k.noise = 0.1;
  k.walk = 0.1;
  k.lost = 0.2;
  const Channel c = channel(k);
  std::vector<double> state(c.states());
  std::vector<double> y(1);
  const auto go = [&](std::int64_t from, std::int64_t to) {
    std::vector<double> all;
    for (std::int64_t i = from; i < to; ++i) {
      const double x = curve(i);
      c.sense(i, {&x, 1}, state, y);
      all.push_back(y[0]);
    }
    return all;
  };
  go(0, 13);
  const std::vector<double> snapshot = state;
  const std::vector<double> first = go(13, 40);
  state = snapshot;
  EXPECT_EQ(go(13, 40), first);
}

}  // namespace
}  // namespace gaitlab::sensors
