#include "cpg/register.h"

#include "cpg/phase_oscillator.h"
#include "cpg/sine.h"

namespace gaitlab {

void register_cpgs(Registry& registry) {
  add_cpg<PhaseOscillator>(registry, "phase_oscillator", PhaseOscillator::kManual);
  add_cpg<Sine>(registry, "sine", Sine::kManual);
}

}  // namespace gaitlab
