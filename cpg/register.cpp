#include "cpg/register.h"

#include "cpg/keyframes.h"
#include "cpg/phase_oscillator.h"
#include "cpg/sine.h"
#include "cpg/tripod.h"

namespace gaitlab {

void register_cpgs(Registry& registry) {
  add_cpg<Keyframes>(registry, "keyframes", Keyframes::kManual);
  add_cpg<PhaseOscillator>(registry, "phase_oscillator", PhaseOscillator::kManual);
  add_cpg<Sine>(registry, "sine", Sine::kManual);
  add_cpg<Tripod>(registry, "tripod", Tripod::kManual);
}

}  // namespace gaitlab
