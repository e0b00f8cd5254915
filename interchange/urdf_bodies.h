// Bodies and hinges of a robot in URDF. Links that fixed joints connect form one body.
#pragma once
#include <string>
#include <vector>

#include "core/model/module_type.h"
#include "interchange/urdf_module.h"
#include "interchange/urdf_motor.h"
#include "interchange/urdf_note.h"
#include "interchange/urdf_text.h"

namespace gaitlab::interchange {

struct UrdfBodies {
  std::vector<BodyType> bodies;
  std::vector<UrdfHinge> hinges;
  bool fixed_base = false;                 ///< true if the root does not move in the world
  std::vector<std::string> links, joints;  ///< names in the URDF file, which may differ from those of bodies and hinges
  std::vector<UrdfNote> notes;             ///< in the order of the file
};

/// Adds a problem for everything that a module cannot contain; the bodies and hinges are then not valid.
UrdfBodies urdf_bodies(const UrdfText& urdf, const UrdfOptions& options, Problems& problems);

}  // namespace gaitlab::interchange
