// Plugin that disables denormal numbers when it is loaded, like a library linked with -ffast-math, and when it is registered.
#include <xmmintrin.h>

#include "core/plugin/plugin.h"

namespace {
constexpr unsigned kFlush = 0x8040;  // bits for flush to zero, and denormals are zero
const bool kDone = (_mm_setcsr(_mm_getcsr() | kFlush), true);
}  // namespace

GAITLAB_PLUGIN(registry) {
  _mm_setcsr(_mm_getcsr() | (kDone ? kFlush : 0));
  static_cast<void>(registry);
}
