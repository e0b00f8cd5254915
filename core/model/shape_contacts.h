// Contact elements that follow from the shapes of bodies.
#pragma once
#include <vector>

#include "core/model/module_type.h"

namespace gaitlab {

/// Contact elements of all bodies with shapes, by body and shape in file order:
/// - box: its 8 vertices;
/// - sphere: itself;
/// - cylinder: 8 points on each rim, every 45 degrees from x; or, for a wheel, one sphere of its radius about its centre;
/// - half cylinder: the 4 ends of its straight edges, and 3 points on each arc, every 45 degrees.
/// A wheel is a cylinder on the axis of a hinge that turns freely. Its body is the child of this hinge, or the parent if the
/// body has no other hinge. An element inside another shape of its body, or at the place of an earlier element, is left out.
/// The axes of hinges must be unit vectors.
std::vector<ContactType> shape_contacts(const ModuleType& type);

}  // namespace gaitlab
