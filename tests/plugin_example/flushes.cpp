// A plugin that switches denormal numbers off when it is loaded, as one linked with -ffast-math does, and when it registers.
#include <xmmintrin.h>

#include "core/plugin/plugin.h"

namespace {
constexpr unsigned kFlush = 0x8040;  // flush to zero, denormals are zero
const bool kDone = (_mm_setcsr(_mm_getcsr() | kFlush), true);
}  // namespace

GAITLAB_PLUGIN(registry) {
  _mm_setcsr(_mm_getcsr() | (kDone ? kFlush : 0));
  static_cast<void>(registry);
}
