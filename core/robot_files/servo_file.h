// Servo files: keys of actuator and controller of a servo that can be bought, by its name.
#pragma once
#include <string>

#include "core/settings/node.h"

namespace gaitlab {

inline constexpr const char* kServoModel = "model";  ///< key of actuators and controllers that names a servo file

/// Replaces the key `model` of the maps `actuator` and `controller` in a module type, its hinges, or a scenario by the keys of
/// the servo file of that name. A key that the map states itself remains, and `source` names the keys that came from the file.
/// The name is that of a file in the folder `servos` beside the document or with the data of the program, or a path from
/// `folder`. Adds problems at the places of the names and in the servo files.
void insert_servos(Node& document, const std::string& folder, Problems& problems);

}  // namespace gaitlab
