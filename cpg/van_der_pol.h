// CPG `van_der_pol`, van der Pol oscillators with couplings that change their pace.
#pragma once
#include "cpg/limit_cycle.h"

namespace gaitlab::cpg {

struct VanDerPolModel : CycleNetwork::Model {
  double mu = 1;
  void fields(Fields& f);
};

class VanDerPol final : public CycleNetwork {
 public:
  using Settings = OscillatorSettings<VanDerPolModel>;
  static const char* const kManual;

  VanDerPol(const RobotInfo& robot, const Settings& settings);
};

}  // namespace gaitlab::cpg
