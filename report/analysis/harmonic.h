// The first harmonic of a periodic signal.
#pragma once
#include <vector>

#include "core/recording/limit_cycle.h"
#include "core/recording/recording.h"

namespace gaitlab::report {

/// amplitude * sin(2 pi t / period + phase); the phase in (-pi, pi].
struct Harmonic {
  double amplitude = 0, phase = 0;
};

/// Least-squares fit of mean + harmonic to the rows of the last whole periods of the limit cycle; with the mean in the fit, it
/// does not disturb the harmonic even though the rows do not divide the period. `time`: s, rising, as long as the series. None
/// without a limit cycle.
std::vector<Harmonic> first_harmonics(const MotionCycle& cycle, const Series& time, const std::vector<Series>& signals);

}  // namespace gaitlab::report
