// A text file as a whole: the one place that opens what a user names.
#pragma once
#include <string>

#include "core/errors.h"

namespace gaitlab {

/// Reads a regular file of at most kMostScenario bytes. Throws InputError at `asked_at`, the place that names the file, or at
/// the file itself where asked_at is empty.
std::string read_text(const std::string& path, const SourceLocation& asked_at = {});

/// Throws InputError at the first byte that no text has: invalid UTF-8, NUL or another control character, a CR without LF.
void check_text(const std::string& text, const std::string& file);

}  // namespace gaitlab
