#include "cpg/register.h"

#include "cpg/equations.h"
#include "cpg/hopf.h"
#include "cpg/keyframes.h"
#include "cpg/kuramoto_amplitude.h"
#include "cpg/legs.h"
#include "cpg/matsuoka.h"
#include "cpg/network.h"
#include "cpg/phase_oscillator.h"
#include "cpg/sine.h"
#include "cpg/snake.h"
#include "cpg/table.h"
#include "cpg/tripod.h"
#include "cpg/van_der_pol.h"

namespace gaitlab::cpg {

void register_cpgs(Registry& registry) {
  add_cpg<Equations>(registry, "equations", Equations::kManual);
  add_cpg<Hopf>(registry, "hopf", Hopf::kManual);
  add_cpg<Keyframes>(registry, "keyframes", Keyframes::kManual);
  add_cpg<KuramotoAmplitude>(registry, "kuramoto_amplitude", KuramotoAmplitude::kManual);
  add_cpg<Legs>(registry, "legs", Legs::kManual);
  add_cpg<Matsuoka>(registry, "matsuoka", Matsuoka::kManual);
  add_cpg<Network>(registry, "network", Network::kManual);
  add_cpg<PhaseOscillator>(registry, "phase_oscillator", PhaseOscillator::kManual);
  add_cpg<Sine>(registry, "sine", Sine::kManual);
  add_cpg<Snake>(registry, "snake", Snake::kManual);
  add_cpg<Table>(registry, "table", Table::kManual);
  add_cpg<Tripod>(registry, "tripod", Tripod::kManual);
  add_cpg<VanDerPol>(registry, "van_der_pol", VanDerPol::kManual);
}

}  // namespace gaitlab::cpg
