#include "core/math/functions.h"
#include "physics_articulated/pack.h"

namespace gaitlab::articulated {

std::unique_ptr<Kernel> make_kernel_1(const KernelSettings& s) { return std::make_unique<Pack<double>>(s); }

}  // namespace gaitlab::articulated
