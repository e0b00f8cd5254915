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

/// Replaces the key `model` of the maps `actuator` and `controller` in a module type, its hinges, or a scenario by the keys of
/// the servo file of that name. A key that the map states itself remains, and `source` names the keys that came from the file.
/// A map without such a key also gets the section `identified` of the file, except for keys that leave the motion as it is.
/// The name is that of a file in the folder `servos` beside the document or with the data of the program, or a path from
/// `folder`. Adds problems at the places of the names and in the servo files, and one of `notes` for each
/// file that hides a shipped one.
void insert_servos(Node& document, const std::string& folder, Problems& problems, std::vector<Problem>& notes);

}  // namespace gaitlab
