// Kernel of four rollouts for processors with AVX2. Functions compiled here must not also be compiled in another file, because
// the linker could keep either copy.
#include <immintrin.h>

#include "core/math/doubles.h"
#include "core/math/functions.h"

namespace gaitlab::math {

template <>
struct Register<4> {
  typedef double Vector __attribute__((vector_size(32)));    // NOLINT(modernize-use-using): takes no attribute
  typedef long long Bools __attribute__((vector_size(32)));  // NOLINT(modernize-use-using)
};
using Four = Doubles<4>;
struct FourSinCos {
  Four sin, cos;
};
inline FourSinCos sincos(const Four& x) {
  const auto both = Sleef_cinz_sincosd4_u10avx(x.v);
  return {Four(both.x), Four(both.y)};
}
inline Four pow(const Four& x, const Four& y) { return Four(Sleef_cinz_powd4_u10avx(x.v, y.v)); }
inline Four exp(const Four& x) { return Four(Sleef_cinz_expd4_u10avx(x.v)); }
inline Four log(const Four& x) { return Four(Sleef_cinz_logd4_u10avx(x.v)); }
inline Four tanh(const Four& x) { return Four(Sleef_cinz_tanhd4_u10avx(x.v)); }
inline Four sqrt(const Four& x) { return Four(_mm256_sqrt_pd(x.v)); }
inline bool any_lane(const Bools<4>& mask) {
  return _mm256_movemask_pd(_mm256_castsi256_pd(reinterpret_cast<__m256i>(mask.v))) != 0;
}
inline bool all_lanes(const Bools<4>& mask) {
  return _mm256_movemask_pd(_mm256_castsi256_pd(reinterpret_cast<__m256i>(mask.v))) == 0xF;
}

}  // namespace gaitlab::math

#include "physics_articulated/lane_kernel.h"

namespace gaitlab::articulated {

std::unique_ptr<Kernel> make_kernel_4(const KernelSettings& s) { return std::make_unique<LaneKernel<math::Four>>(s); }

}  // namespace gaitlab::articulated
