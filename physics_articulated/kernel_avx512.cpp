// Kernel of eight rollouts for processors with AVX-512. Functions compiled here must not also be compiled in another file,
// because the linker could keep either copy.
#include <immintrin.h>

#include "core/math/doubles.h"
#include "core/math/functions.h"

namespace gaitlab::math {

template <>
struct Register<8> {
  typedef double Vector __attribute__((vector_size(64)));    // NOLINT(modernize-use-using): takes no attribute
  typedef long long Bools __attribute__((vector_size(64)));  // NOLINT(modernize-use-using)
};
using Eight = Doubles<8>;
struct EightSinCos {
  Eight sin, cos;
};
inline EightSinCos sincos(const Eight& x) {
  const auto both = Sleef_cinz_sincosd8_u10avx512fnofma(x.v);
  return {Eight(both.x), Eight(both.y)};
}
inline Eight pow(const Eight& x, const Eight& y) { return Eight(Sleef_cinz_powd8_u10avx512fnofma(x.v, y.v)); }
inline Eight exp(const Eight& x) { return Eight(Sleef_cinz_expd8_u10avx512fnofma(x.v)); }
inline Eight log(const Eight& x) { return Eight(Sleef_cinz_logd8_u10avx512fnofma(x.v)); }
inline Eight tanh(const Eight& x) { return Eight(Sleef_cinz_tanhd8_u10avx512fnofma(x.v)); }
inline Eight sqrt(const Eight& x) { return Eight(_mm512_maskz_sqrt_pd(0xFF, x.v)); }
inline __mmask8 bits(const Bools<8>& mask) {
  const auto as = reinterpret_cast<__m512i>(mask.v);
  return _mm512_test_epi64_mask(as, as);
}
inline bool any_lane(const Bools<8>& mask) { return bits(mask) != 0; }
inline bool all_lanes(const Bools<8>& mask) { return bits(mask) == 0xFF; }

}  // namespace gaitlab::math

#include "physics_articulated/lane_kernel.h"

namespace gaitlab::articulated {

std::unique_ptr<Kernel> make_kernel_8(const KernelSettings& s) { return std::make_unique<LaneKernel<math::Eight>>(s); }

}  // namespace gaitlab::articulated
