#include "core/math/functions.h"
#include "physics_articulated/lane_kernel.h"

namespace gaitlab::articulated {

std::unique_ptr<Kernel> make_kernel_1(const KernelSettings& s) { return std::make_unique<LaneKernel<double>>(s); }

}  // namespace gaitlab::articulated
