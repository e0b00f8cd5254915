// Meter pass with registers of two entries, which every x86-64 processor has.
namespace {
typedef double Lanes __attribute__((vector_size(16)));  // NOLINT(modernize-use-using): takes no attribute
}

#include "core/simulation/meter_lanes.h"

namespace gaitlab {

void add_pass(const MeterPass& pass) {
  for (std::size_t at = 0; at < pass.entries; at += kLanesWide) add_lanes(pass, at);
}

}  // namespace gaitlab
