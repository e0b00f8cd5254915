// Masses and inertias of the links of a URDF robot, and the repair of those that no body can have.
#pragma once
#include <string>
#include <vector>

#include "core/model/module_type.h"
#include "interchange/urdf_note.h"
#include "interchange/urdf_text.h"

namespace gaitlab::interchange {

/// Mass of a link, in the frame of its body.
struct UrdfMass {
  double mass = 0;              ///< kg
  Vec3 com = Vec3::Zero();      ///< m
  Mat3 inertia = Mat3::Zero();  ///< kg m^2, about the COM
  std::string link = {};
  std::vector<Shape> shapes = {};  ///< of the link
};

/// True if the link has an inertial with a mass that is not 0.
bool has_mass(const urdf::Link& link);

/// Adds a problem for each number of a link, its shapes and the joints to its children that is beyond every robot: a mass that
/// is negative or above 1e9 kg, an origin beyond 1e6 m, and a shape smaller than 1e-9 m or larger than 1e6 m.
void check_numbers(const urdf::Link& link, const std::vector<Shape>& shapes, const UrdfText& urdf, Problems& problems);

/// Sum of the masses. A single mass is returned unchanged, to the last digit.
UrdfMass united_mass(const std::vector<UrdfMass>& parts);

/// Inertia at uniform density of a body with this mass, kg: that of its shapes, or without shapes that of a ball of water.
Mat3 usual_inertia(double mass, const std::vector<Shape>& shapes);

/// Repairs the inertias of a body's links if no body can have that of their sum; each with a note. A link whose largest
/// principal moment exceeds the sum of the other two by at most 1 % of itself gets a larger smallest moment. A link whose
/// moments are not positive, or exceed that, gets its usual_inertia().
void repair_inertias(std::vector<UrdfMass>& parts, const UrdfText& urdf, std::vector<UrdfNote>& notes);

}  // namespace gaitlab::interchange
