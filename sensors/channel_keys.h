// Settings of a sensor channel: sampling, errors, delay and losses.
#pragma once
#include <string>
#include <vector>

#include "core/plugin/fields.h"

namespace gaitlab::sensors {

/// Units of a channel: of its value, and of the strength of its random walk.
struct ChannelUnit {
  const char* value;
  const char* walk;
  bool operator==(const ChannelUnit&) const = default;
};
inline constexpr ChannelUnit kRadian{"rad", "rad/s^0.5"};
inline constexpr ChannelUnit kRadianPerSecond{"rad/s", "rad/s^1.5"};
inline constexpr ChannelUnit kAmpere{"A", "A/s^0.5"};
inline constexpr ChannelUnit kNewtonMetre{"N m", "N m/s^0.5"};
inline constexpr ChannelUnit kNewton{"N", "N/s^0.5"};
inline constexpr ChannelUnit kAcceleration{"m/s^2", "m/s^2.5"};

/// Keys of a channel (channel.h has the equations). The channel with the defaults gives the true value.
struct ChannelKeys {
  explicit ChannelKeys(const ChannelUnit& of) : unit(of) {}
  ChannelUnit unit;
  double period = 0;                       ///< s; 0: every control tick
  double gain = 1, gain_deviation = 0;     ///< 1
  double zero = 0, bias = 0, noise = 0;    ///< in the unit of the value
  double walk = 0, walk_time = 0;          ///< in the unit of the walk; s, 0: the walk has no bound
  std::vector<double> range;               ///< smallest and largest value; empty: no limit
  double resolution = 0;                   ///< in the unit of the value; 0: exact
  double delay_least = 0, delay_most = 0;  ///< s
  double lost = 0;                         ///< share of the samples
  bool operator==(const ChannelKeys&) const = default;

  void fields(Fields& f) {
    constexpr double kMost = 1e9;
    constexpr double kLongest = 10;  // s
    constexpr double kFinest = 1e-12;
    f.periods("period", period,
              {"s", 0, kLongest,
               "Time between samples, a whole number of control periods; 0: every control "
               "tick."});
    f.number("gain", gain, {"", -kMost, kMost, "Nominal factor on the true value."});
    f.number("gain_deviation", gain_deviation,
             {"", 0, 10, "Standard deviation of the factor, as a share of `gain`; drawn once per run, normal."});
    f.number("zero", zero,
             {unit.value, 0, kMost,
              "Standard deviation of the zero, a constant error that is drawn once per "
              "run, normal."});
    f.number("bias", bias, {unit.value, -kMost, kMost, "Constant error that is the same in every run."});
    f.number("walk", walk, {unit.walk, 0, kMost, "Strength of a random walk of the error: its standard deviation after 1 s."});
    f.number("walk_time", walk_time,
             {"s", 0, 1e9, "Correlation time of the walk, which bounds its deviation to walk (walk_time/2)^0.5; 0: no bound."});
    f.number("noise", noise,
             {unit.value, 0, kMost,
              "Standard deviation of the noise, which is normal and independent for each "
              "sample."});
    f.numbers(
        "range", range,
        {unit.value, -kMost, kMost,
         "[smallest, largest] value, to which samples are clamped before they are rounded to the resolution; []: no limit."});
    f.number("resolution", resolution, {unit.value, 0, kMost, "Step of the values, which are multiples of it; 0: exact."});
    f.periods(
        "delay", delay_least, delay_most,
        {"s", 0, kLongest, "Delay, a whole number of control periods; [a, b]: a delay in this range, drawn once per run."});
    f.number(
        "lost", lost,
        {"", 0, 1, "Share of the samples that are lost; the last received sample is then held. The first sample is not lost."});
    if (resolution > 0 && resolution < kFinest)
      f.problem("resolution", "resolution is below 1e-12; expected 0 for exact values");
    if (range.empty() || (range.size() == 2 && range[0] < range[1])) return;
    f.problem("range", range.size() == 2
                           ? "range has no width; expected [smallest, largest]"
                           : "range has " + std::to_string(range.size()) + (range.size() == 1 ? " number" : " numbers") +
                                 "; expected [smallest, largest], or [] for no limit");
  }
};

}  // namespace gaitlab::sensors
