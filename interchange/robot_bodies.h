// Bodies and hinges of a robot in a URDF or MJCF file, for a module. Links without a joint between them form one body.
#pragma once
#include <set>
#include <string>
#include <vector>

#include "core/model/base.h"
#include "core/model/module_type.h"
#include "interchange/robot_hinge.h"
#include "interchange/robot_note.h"

namespace gaitlab::interchange {

/// Choices beside a robot file.
struct ImportOptions {
  std::vector<std::string> locked = {};  ///< names and patterns of joints that are fixed at 0
  std::string meshes = {};               ///< folder of mesh files; "" for none
  std::string srdf = {};                 ///< file with pairs of links that never collide (srdf.h); "" for none
};

/// Words of a format in messages and in the module file.
struct RobotFormat {
  const char *name, *body;  ///< `URDF`, `link`
  const char* motor;        ///< meaning of torque at rest and no-load speed in the file
};

/// Element of a robot file.
struct RobotElement {
  std::string name = {};
  SourceLocation place = {};
};

struct RobotBodies {
  RobotFormat format;
  std::vector<BodyType> bodies = {};
  std::vector<RobotHinge> hinges = {};
  Base base = Base::floating;
  std::vector<RobotElement> body_of = {}, hinge_of = {};  ///< in the file, with names that may differ from those of the module
  std::vector<BodyPair> may_overlap = {};                 ///< names in the module, or patterns
  std::vector<RobotNote> notes = {};                      ///< in the order of the file

  /// Sorts the notes, and gives bodies and hinges the names of their elements with the characters that a module file allows,
  /// with a note on each that changes. Prefixes such as `m0/` are removed if all names then still differ, characters that are
  /// not allowed become _, and equal names are numbered.
  void finish();
};

/// Names of the joints that `locked` fixes: the joint of that name, which may contain `*`, else those that match it as a
/// pattern. Adds a problem for each of `locked` that matches none.
std::set<std::string> locked_joints(const std::vector<std::string>& moving, const std::vector<std::string>& locked,
                                    Problems& problems);

}  // namespace gaitlab::interchange
