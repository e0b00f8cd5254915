// Kinds of files and folders that users name in commands and files, recognised by their content.
#pragma once
#include <optional>
#include <string>

#include "core/errors.h"
#include "core/names.h"

namespace gaitlab {

enum class FileKind { scenario, module, servo, cpg, study, recipe, robot, run, golden, trace, page, results, urdf };

struct FileKindRow {
  FileKind value;
  const char* text;
  const char* noun;
  const char* use;     ///< command for such a file, followed by its name
  const char* remedy;  ///< sentence before the command, or instead of it if `use` is empty
};

template <>
struct EnumNames<FileKind> {
  using enum FileKind;
  static constexpr FileKindRow kTable[] = {
      {scenario, "scenario", "a scenario", "gaitlab run", "run it with"},
      {module, "module", "a module type", "gaitlab explain module", "its content:"},
      {servo, "servo", "a servo file", "", "name it in a scenario or module type, actuator: {type: servo, model: FILE}"},
      {cpg, "cpg", "a CPG file", "", "name it in a scenario, cpg: {type: ./FILE}"},
      {study, "study", "a study", "", "run it with gaitlab sweep or gaitlab optimize"},
      {recipe, "recipe", "a recipe for figures", "gaitlab figure", "draw it with"},
      {robot, "robot", "a build file", "", "name it in a scenario, robot: {build: FILE}"},
      {run, "run", "a run folder", "gaitlab rerun", "repeat it with"},
      {golden, "golden", "a golden", "", "gaitlab test SCENARIO compares a scenario with it"},
      {trace, "trace", "a recorded trace", "gaitlab report", "its summary:"},
      {page, "page", "a web page", "", "open it in a browser"},
      {results, "results", "a file of results in JSON", "", "the scenario of a run is scenario.resolved.yaml in its folder"},
      {urdf, "urdf", "a URDF file", "gaitlab new module NAME --from", "make a module of it with"},
  };
};

/// Kind of a text by its keys at the beginning of lines, by rows of five whole numbers, or by its first characters (HDF5, HTML,
/// JSON, XML). Nothing if the text is of no kind.
std::optional<FileKind> kind_of_text(const std::string& text);

/// Kind of a file or folder. Nothing if it cannot be read, or is of no kind. Reads at most 1 MB, and throws nothing.
std::optional<FileKind> kind_of_file(const std::string& path);

/// Problem for a file that is not of the expected kind: `this is a study, not a scenario; run it with ...`. Nothing if the file
/// is of the expected kind, or of no kind.
std::optional<Problem> of_another_kind(const std::string& path, FileKind expected);

/// Throws InputError with the problem that of_another_kind() returns, if any.
void expect_kind(const std::string& path, FileKind expected);

/// End of a message that refuses a file: `; it is a scenario: gaitlab run s.yaml`. Empty for a file of no kind.
std::string but_it_is(const std::string& path);

}  // namespace gaitlab
