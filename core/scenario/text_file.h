// A text file as a whole: the one place that opens what a user names.
#pragma once
#include <string>

#include "core/errors.h"

namespace gaitlab {

/// Reads a regular file of at most kMostScenario bytes. Throws InputError at `asked_at`, the place that names the file, or at
/// the file itself where asked_at is empty.
std::string read_text(const std::string& path, const SourceLocation& asked_at = {});

/// A file that another text names, as a scenario names its modules.
struct NamedFile {
  std::string path;
  std::string folder;  ///< of the text that names it
  std::string kind;    ///< `module file`
  std::string key;     ///< with which a line of every such file begins, as gaitlab_module; empty: none
};

/// Whether messages may quote a file that a text in `folder` names: it lies there, links followed, or comes with the program. A
/// stranger's text may name any file of this machine, and messages are read by others where they go into the log of a CI.
bool may_quote(const std::string& path, const std::string& folder);
/// How a message on another file ends.
inline constexpr const char* kNotShown = "its text is not shown, because it lies outside the folder of the file that names it";

/// Adds what was found in such a file. Where messages may not quote it, and no line begins with its key, what was found there
/// becomes one problem without a word of it: `is not a module file; ...`.
void add_found(const Problems& found, const NamedFile& file, Problems& problems);

/// Throws InputError at the first byte that no text has: invalid UTF-8, NUL or another control character, a CR without LF.
void check_text(const std::string& text, const std::string& file);

}  // namespace gaitlab
