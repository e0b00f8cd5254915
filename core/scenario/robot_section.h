// The scenario's section `robot`: search and reading of module types, reading of docks, and assembly of the robot.
#pragma once
#include <memory>
#include <string>
#include <vector>

#include "core/scenario/scenario.h"
#include "core/settings/reader.h"

namespace gaitlab {

inline constexpr const char* kDefaultType = "mtran";  ///< default type of the modules

/// Robot of the keys `modules`, `types`, `build` and `docks`. `robot` is null if there were problems.
struct RobotParts {
  std::shared_ptr<const Robot> robot = {};
  std::vector<Node> documents = {};  ///< documents of the module types, one per entry of Robot::types
  std::vector<Problem> notes = {};   ///< names of modules and robots that mean other files than the shipped ones
};

/// Reads a robot. `reader` is at the map `robot`, and `folder` is that of the scenario file.
RobotParts read_robot(Reader& reader, const SourceLocation& place, const std::string& folder, Problems& problems);

/// Self-contained keys of a robot: `types` in full, `modules` by name, and `docks`.
std::vector<std::pair<std::string, Node>> robot_nodes(const Robot& robot, const std::vector<Node>& documents);

/// Text of a scenario of a single module in nothing, whose type is in a file. Throws InputError, at the file, if the file
/// cannot be read or is of another kind.
std::string scenario_of_module(const std::string& path);

}  // namespace gaitlab
