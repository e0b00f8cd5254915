// Text of the servo file of an identification.
#pragma once
#include <string>
#include <vector>

#include "core/robot_files/identification.h"
#include "identify/identify.h"

namespace gaitlab::identify {

/// Error of a quantity with its unit; of an angle in mrad.
std::string error_text(double error, Logged kind);

/// Origins and licences that the logs state (measured.source), each once.
std::vector<std::string> origins_of(const std::vector<BenchLog>& logs);

/// Logs of the fitted values, their errors, and the speeds and torques that they cover.
Identification identification(const Identified& made, const std::vector<BenchLog>& logs);

/// True if a servo file can state the key: one of actuator or controller, for all joints.
bool holds_in_servo_file(const Key& key);

/// Servo file `name` (core/robot_files/servo_file.h): the keys of actuator and controller that the bench `file` with the
/// settings `sets` states, with the fitted values, and with the bench's value of keys that were tried and dropped. Each key
/// holds_in_servo_file(). Keys of the supply and of the controller's clock are left out, because they belong to the robot.
/// Throws InputError if the bench cannot be read.
std::string servo_text(const std::string& name, const std::string& file, const std::vector<std::string>& sets,
                       const Identified& made, const std::vector<BenchLog>& logs, const std::vector<Key>& keys);

}  // namespace gaitlab::identify
