// Servo files: keys of actuator and controller of a servo that can be bought, by its name.
#pragma once
#include <optional>
#include <string>
#include <vector>

#include "core/names.h"
#include "core/robot_files/identification.h"
#include "core/settings/node.h"

namespace gaitlab {

/// Origin of a servo's numbers: its maker's data sheet, an identification by logs of such a servo, or a choice.
enum class ServoFigure { data_sheet, identified, chosen };

template <>
struct EnumNames<ServoFigure> {
  using enum ServoFigure;
  static constexpr EnumName<ServoFigure> kTable[] = {
      {data_sheet, "data sheet"}, {identified, "identified"}, {chosen, "chosen"}};
};

inline constexpr const char* kServoModel = "model";  ///< key of actuators and controllers that names a servo file

/// Source of some numbers of a servo.
struct ServoSource {
  std::vector<std::string> of;  ///< keys of actuator and controller
  ServoFigure kind = ServoFigure::data_sheet;
  std::string text;
};

/// A servo file.
struct ServoFile {
  std::string name;
  std::string source;                ///< of all numbers: the key `source`, or a sentence of `sources`
  std::vector<ServoSource> sources;  ///< by number; empty if the file has the key `source` instead
  Node actuator, controller;         ///< maps; `controller` is null if the file has none
  Identification identified;         ///< logs to which the numbers were fitted
  Node logs;                         ///< the same as a map; null without them

  /// Source of a number; nullptr if the file states none by number.
  [[nodiscard]] const ServoSource* source_of(const std::string& key) const;
};

/// Reads a servo file that is named at `asked_at`. Returns nothing, with problems at their places, if the file is wrong. Throws
/// InputError if it cannot be read.
std::optional<ServoFile> read_servo(const std::string& path, const SourceLocation& asked_at, Problems& problems);

/// Adds a problem for a section `identified` with a part of the numbers that belong together: without the number of logs, and
/// with held_out_logs or held_out alone.
void check_identified(const Node& stated, const Identification& identified, Problems& problems);

/// False for a key of an actuator that leaves the motion of the logs as it is: the supply, numbers that only move currents, and
/// a limit of the current that the numbers of the logs do not state.
bool moves_joint(const std::string& key, bool stated_with_logs);

/// The servo that the key `model` of a map names, as insert_servos() finds it; nothing without the key, or after a problem.
std::optional<ServoFile> named_servo(const Node& map, const std::string& folder, Problems& problems);

/// Replaces the key `model` of the maps `actuator` and `controller` in a module type, its hinges, or a scenario by the keys of
/// the servo file of that name. A key that the map states itself remains, and `source` names the keys that came from the file.
/// An actuator without such a key also gets the section `identified` of the file, except for keys that leave the motion as it
/// is, and unless the controller beside it states another value for a key that the file has from logs.
/// The name is that of a file in the folder `servos` beside the document or with the data of the program, or a path from
/// `folder`. Adds problems at the places of the names and in the servo files, and one of `notes` for each
/// file that hides a shipped one.
void insert_servos(Node& document, const std::string& folder, Problems& problems, std::vector<Problem>& notes);

}  // namespace gaitlab
