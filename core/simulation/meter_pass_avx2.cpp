// Meter pass with registers of four entries, for processors with AVX2.
namespace {
typedef double Lanes __attribute__((vector_size(32)));  // NOLINT(modernize-use-using): takes no attribute
}

#include "core/simulation/meter_lanes.h"

namespace gaitlab {

void add_pass_avx2(const MeterPass& pass) {
  for (std::size_t at = 0; at < pass.entries; at += kLanesWide) add_lanes(pass, at);
}

}  // namespace gaitlab
