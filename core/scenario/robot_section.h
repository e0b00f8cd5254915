// Reader of the scenario's section `robot`, which finds and reads module types, reads docks, and assembles the robot.
#pragma once
#include <memory>
#include <string>
#include <vector>

#include "core/scenario/scenario.h"
#include "core/settings/reader.h"

namespace gaitlab {

inline constexpr const char* kDefaultType = "mtran";  ///< default type of the modules

/// Robot from the keys `modules`, `types`, `build` and `docks`. `robot` is null if there were problems.
struct RobotParts {
  std::shared_ptr<const Robot> robot = {};
  std::vector<Node> documents = {};  ///< documents of the module types, one per entry of Robot::types
  std::vector<Problem> notes = {};   ///< notes on names of modules and robots for which a user's file hides the shipped one
};

/// Reads a robot. `reader` is at the map `robot`, and `folder` is the folder of the scenario file.
RobotParts read_robot(Reader& reader, const SourceLocation& place, const std::string& folder, Problems& problems);

/// Keys that describe a robot without other files: `types` in full, `modules` by name, and `docks`.
std::vector<std::pair<std::string, Node>> robot_nodes(const Robot& robot, const std::vector<Node>& documents);

/// Text of a scenario with a single module in empty space, whose type is in a file. Throws InputError, at the file, if the file
/// cannot be read or is of another kind.
std::string scenario_of_module(const std::string& path);

}  // namespace gaitlab
