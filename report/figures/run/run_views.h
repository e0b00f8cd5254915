// A run's robot at an instant, seen from the side of its way.
#pragma once
#include <string>
#include <vector>

#include "core/recording/recording.h"
#include "core/scenario/scenario.h"
#include "report/figures/run/figure.h"

namespace gaitlab::report {

/// How the robot is looked at: from the side of its way, or from above where it moves within the ground plane.
struct Sight {
  Camera camera;
  std::string view = "side view";
  std::string axis = "x (m)";  ///< what goes to the right
  bool above = false;
  [[nodiscard]] const char* scale() const { return above ? "both ways on one scale" : "heights on the same scale"; }
};

/// From the side of the way of the centre of mass; from above where most joints turn about the vertical.
Sight sight(const Scenario& scenario, const Recording& record);

/// The robot as it stood at a row of the recording, with the place of a joint.
View view_at(const Scenario& scenario, const Recording& record, const Sight& from, std::size_t row, std::size_t joint);

/// Figure input with the ground, what stands on it and the axis of the views, but without views. Boxes as they are; of a field
/// the line below the robot at the end.
FigureInput views_input(const Scenario& scenario, const Recording& record, const Sight& from);

}  // namespace gaitlab::report
