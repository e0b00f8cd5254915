// The scenario's `robot`: module types found and read, docks read, the robot assembled.
#pragma once
#include <memory>
#include <string>
#include <vector>

#include "core/scenario/scenario.h"
#include "core/settings/reader.h"

namespace gaitlab {

inline constexpr const char* kDefaultType = "mtran";  ///< of the modules, where the scenario names none

/// What `modules`, `types`, `build` and `docks` say. robot == nullptr: there were problems.
struct RobotParts {
  std::shared_ptr<const Robot> robot = {};
  std::vector<Node> documents = {};  ///< of the module types, one a Robot::types entry
};

/// `reader` stands at the map `robot`; `folder` is the scenario file's.
RobotParts read_robot(Reader& reader, const SourceLocation& place, const std::string& folder, Problems& problems);

/// The same keys again, self-contained: `types` in full, `modules` by name, `docks`.
std::vector<std::pair<std::string, Node>> robot_nodes(const Robot& robot, const std::vector<Node>& documents);

}  // namespace gaitlab
