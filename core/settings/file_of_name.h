// File that another file names without a path, such as a module type or robot in a scenario, or a scenario in a study.
#pragma once
#include <optional>
#include <string>
#include <vector>

namespace gaitlab {

struct FileOfName {
  std::string path;
  std::string hidden = {};  ///< path of the shipped file of that name if `path` is another file with other content
};

/// The first of `own` that is a file, or else `shipped` if it exists. A folder is not a file.
std::optional<FileOfName> file_of_name(const std::vector<std::string>& own, const std::string& shipped);

/// Note that a user's file hides the shipped file of the same name; "" if no file is hidden.
std::string note_of_hidden(const std::string& name, const FileOfName& found);

}  // namespace gaitlab
