// CPG `matsuoka`, pairs of neurons that inhibit each other and adapt, with couplings that change their pace.
#pragma once
#include "cpg/limit_cycle.h"

namespace gaitlab::cpg {

struct MatsuokaModel : CycleNetwork::Model {
  double inhibition = 2, adaptation = 2.5, time_ratio = 0.5;
  void fields(Fields& f);
};

class Matsuoka final : public CycleNetwork {
 public:
  using Settings = OscillatorSettings<MatsuokaModel>;
  static const char* const kManual;

  Matsuoka(const RobotInfo& robot, const Settings& settings);
};

}  // namespace gaitlab::cpg
