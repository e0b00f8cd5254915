// Text files named by the user: the only code that opens them.
#pragma once
#include <string>

#include "core/errors.h"

namespace gaitlab {

/// Reads a regular file of at most kMostScenario bytes. Throws InputError at `asked_at`, the place that names the file, or at
/// the file itself if asked_at is empty.
std::string read_text(const std::string& path, const SourceLocation& asked_at = {});

/// A file that another text names, as a scenario names its modules.
struct NamedFile {
  std::string path;
  std::string folder;  ///< of the text that names it
  std::string kind;    ///< `module file`
  std::string key;     ///< first word of a line of every such file, as gaitlab_module; may be empty
};

/// Checks that messages may quote a file that a text in `folder` names: the file is within `folder`, links followed, or comes
/// with the program. A scenario from elsewhere may name any file of this machine, and the log of a CI may be public.
bool may_quote(const std::string& path, const std::string& folder);
/// End of a message on another file.
inline constexpr const char* kNotShown = "its text is not shown, because it lies outside the folder of the file that names it";

/// Adds the problems of such a file. If messages may not quote it, and none of its lines begins with its key, all of them
/// become one problem without a word of the file: `is not a module file; ...`.
void add_found(const Problems& found, const NamedFile& file, Problems& problems);

/// `path` relative to `folder` (an absolute path is unchanged).
std::string path_from(const std::string& folder, const std::string& path);

/// Throws InputError at the first byte that does not belong in a text: invalid UTF-8, NUL or another control character, a CR
/// without LF.
void check_text(const std::string& text, const std::string& file);

}  // namespace gaitlab
