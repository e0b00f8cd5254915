// Reader of all text files that the user names.
#pragma once
#include <string>

#include "core/errors.h"

namespace gaitlab {

/// Reads a regular file of at most 4 MB. Throws InputError at `asked_at`, the place of the file's name. If
/// `asked_at` is empty, the error is at the file.
std::string read_text(const std::string& path, const SourceLocation& asked_at = {});

/// A file that another text names, as a scenario names its modules.
struct NamedFile {
  std::string path;
  std::string folder;  ///< folder of the text that names the file
  std::string kind;    ///< kind of the file for messages, such as `module file`
  std::string key;     ///< key at the start of a line in every such file, such as gaitlab_module; may be empty
};

/// True if messages may quote a file that a text in `folder` names. The file, after links are followed, must be in `folder` or
/// among the program's data. Otherwise a foreign scenario could make messages quote any file of this machine, for example in
/// the public log of a CI.
bool may_quote(const std::string& path, const std::string& folder);
/// End of a message about a file that may not be quoted.
inline constexpr const char* kNotShown = "its text is not shown, because it lies outside the folder of the file that names it";

/// Adds the problems of a file. If messages may not quote the file, and no line begins with `key`, adds instead a single
/// problem without text of the file: `is not a module file; ...`.
void add_found(const Problems& found, const NamedFile& file, Problems& problems);

/// Path relative to `folder`. An absolute path is unchanged.
std::string path_from(const std::string& folder, const std::string& path);

/// Throws InputError at the first byte that a text may not contain: invalid UTF-8, NUL or another control character, or CR
/// without LF.
void check_text(const std::string& text, const std::string& file);

}  // namespace gaitlab
