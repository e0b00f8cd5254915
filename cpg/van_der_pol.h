// CPG `van_der_pol`: van der Pol oscillators, coupled by their pace.
#pragma once
#include "cpg/limit_cycle.h"

namespace gaitlab {

class VanDerPol final : public CycleNetwork {
 public:
  struct Model : CycleNetwork::Model {
    double mu = 1;
    void fields(Fields& f);
  };
  struct Settings : OscillatorKeys {
    Model model;
    void fields(Fields& f) {
      OscillatorKeys::fields(f);
      f.group("model", model, "Keys of this model alone.");
    }
  };
  static const char* const kManual;

  VanDerPol(const RobotInfo& robot, const Settings& settings);
};

}  // namespace gaitlab
