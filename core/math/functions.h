// Transcendental functions of the simulation path: the deterministic (cinz_) versions of SLEEF, 1 ulp, which give the same bits
// on every x86-64 and in every lane width. std::sin and similar functions differ between C libraries and must not affect
// results.
#pragma once
#include <emmintrin.h>
#include <sleef.h>

#include <cstddef>
#include <span>

namespace gaitlab::math {

inline double sin(double x) { return Sleef_cinz_sind1_u10purec(x); }
/// Replaces every angle by its sine, with the same bits as sin(). Two angles at a time need half of the instructions.
inline void sines(std::span<double> angles) {
  std::size_t at = 0;
  for (; at + 1 < angles.size(); at += 2) {
    double* const two = &angles[at];
    _mm_storeu_pd(two, Sleef_cinz_sind2_u10sse2(_mm_loadu_pd(two)));
  }
  if (at < angles.size()) angles[at] = sin(angles[at]);
}
inline double cos(double x) { return Sleef_cinz_cosd1_u10purec(x); }
struct SinCos {
  double sin, cos;
};
inline SinCos sincos(double x) {
  const auto both = Sleef_cinz_sincosd1_u10purec(x);
  return {both.x, both.y};
}
inline double tan(double x) { return Sleef_cinz_tand1_u10purec(x); }
inline double exp(double x) { return Sleef_cinz_expd1_u10purec(x); }
inline double log(double x) { return Sleef_cinz_logd1_u10purec(x); }
inline double pow(double x, double y) { return Sleef_cinz_powd1_u10purec(x, y); }
inline double tanh(double x) { return Sleef_cinz_tanhd1_u10purec(x); }
inline double asin(double x) { return Sleef_cinz_asind1_u10purec(x); }
inline double atan2(double y, double x) { return Sleef_cinz_atan2d1_u10purec(y, x); }

}  // namespace gaitlab::math
