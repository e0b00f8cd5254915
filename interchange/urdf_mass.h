// Masses and inertias of the links of a URDF robot, and the repair of those that no body can have.
#pragma once
#include <string>
#include <vector>

#include "core/model/module_type.h"
#include "interchange/robot_mass.h"
#include "interchange/robot_note.h"
#include "interchange/urdf_text.h"

namespace gaitlab::interchange {

/// True if the link has an inertial with a mass that is not 0.
bool has_mass(const urdf::Link& link);

/// Adds a problem for each number of a link, its shapes and the joints to its children that is beyond every robot: a mass that
/// is negative or above 1e9 kg, an origin beyond 1e6 m, and a shape smaller than 1e-9 m or larger than 1e6 m.
void check_numbers(const urdf::Link& link, const std::vector<Shape>& shapes, const UrdfText& urdf, Problems& problems);

/// Inertia at uniform density of a body with this mass, kg: that of its shapes, or without shapes that of a ball of water.
Mat3 usual_inertia(double mass, const std::vector<Shape>& shapes);

/// Repairs the inertias of a body's links if no body can have that of their sum; each with a note. A link whose largest
/// principal moment exceeds the sum of the other two by at most 1 % of itself gets a larger smallest moment. A link whose
/// moments are not positive, or exceed that, gets its usual_inertia().
void repair_inertias(std::vector<RobotMass>& parts, const UrdfText& urdf, std::vector<RobotNote>& notes);

}  // namespace gaitlab::interchange
