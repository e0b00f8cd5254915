// Views of a run's robot at an instant, from the side of its path or from above.
#pragma once
#include <string>
#include <vector>

#include "core/recording/recording.h"
#include "core/scenario/scenario.h"
#include "report/figures/run/views.h"

namespace gaitlab::report {

/// Direction of view: from the side of the robot's path, or from above if the robot moves within the ground plane.
struct Sight {
  Camera camera;
  std::string view = "side view";
  std::string axis = "x (m)";  ///< label of the horizontal axis
  bool above = false;
  [[nodiscard]] const char* scale() const { return above ? "both ways on one scale" : "heights on the same scale"; }
};

/// Direction of view for a run: from the side of the centre of mass's path, or from above if most joints turn about the
/// vertical.
Sight sight(const Scenario& scenario, const Recording& record);

/// View of the robot at a row of the recording, with the position of a joint.
View view_at(const Scenario& scenario, const Recording& record, const Sight& from, std::size_t row, std::size_t joint);

/// Input of views with the ground, its obstacles and the axis of the views, but without views. Boxes are outlines. A height
/// field is a line, its profile below the robot at the end of the run.
ViewsInput views_input(const Scenario& scenario, const Recording& record, const Sight& from);

}  // namespace gaitlab::report
