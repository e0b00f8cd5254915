// The first harmonic of a periodic signal.
#pragma once
#include <vector>

#include "core/recording/limit_cycle.h"
#include "core/recording/recording.h"

namespace gaitlab::report {

/// Harmonic amplitude * sin(2 pi t / period + phase), with the phase in (-pi, pi].
struct Harmonic {
  double amplitude = 0, phase = 0;
};

/// Least-squares fit of mean + harmonic to the rows of the last whole periods of the limit cycle. Because the mean is fitted
/// too, it does not affect the harmonic, even if a period is not a whole number of rows. `time` (s) rises and has the length of
/// each signal. Empty without a limit cycle.
std::vector<Harmonic> first_harmonics(const MotionCycle& cycle, const Series& time, const std::vector<Series>& signals);

}  // namespace gaitlab::report
