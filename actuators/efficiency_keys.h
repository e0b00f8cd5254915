// Settings for the model of a gear's efficiency, shared by all motors with a gear.
#pragma once
#include "core/plugin/actuator.h"

namespace gaitlab::actuators {

enum class EfficiencyModel { paper, directional };

/// Part of a motor's Settings: the gear efficiency of core/laws/dc_motor.h, either as printed in eq. 2 or directional.
struct EfficiencyKeys {
  EfficiencyModel efficiency_model = EfficiencyModel::paper;
  double turn_speed = 0.6;  ///< rad/s, at the joint
  void fields(Fields& f);
  /// `reversal_speed` of core/laws/dc_motor.h, rad/s; 0 selects eq. 2 as the paper prints it.
  [[nodiscard]] double reversal_speed() const { return efficiency_model == EfficiencyModel::directional ? turn_speed : 0.0; }
};

}  // namespace gaitlab::actuators
