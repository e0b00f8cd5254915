// The scenario's `robot`: module types found and read, docks read, the robot assembled.
#pragma once
#include <memory>
#include <string>
#include <vector>

#include "core/scenario/scenario.h"
#include "core/settings/reader.h"

namespace gaitlab {

inline constexpr const char* kDefaultType = "mtran";  ///< default type of the modules

/// Robot of the keys `modules`, `types`, `build` and `docks`. robot == nullptr: there were problems.
struct RobotParts {
  std::shared_ptr<const Robot> robot = {};
  std::vector<Node> documents = {};  ///< of the module types, one per entry of Robot::types
};

/// `reader` is at the map `robot`; `folder`: folder of the scenario file.
RobotParts read_robot(Reader& reader, const SourceLocation& place, const std::string& folder, Problems& problems);

/// The same keys, self-contained: `types` in full, `modules` by name, `docks`.
std::vector<std::pair<std::string, Node>> robot_nodes(const Robot& robot, const std::vector<Node>& documents);

}  // namespace gaitlab
