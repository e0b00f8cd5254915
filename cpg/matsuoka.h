// CPG `matsuoka`: pairs of neurons that inhibit each other and adapt, coupled by their pace.
#pragma once
#include "cpg/limit_cycle.h"

namespace gaitlab {

class Matsuoka final : public CycleNetwork {
 public:
  struct Model : CycleNetwork::Model {
    double inhibition = 2, adaptation = 2.5, time_ratio = 0.5;
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

  Matsuoka(const RobotInfo& robot, const Settings& settings);
};

}  // namespace gaitlab
