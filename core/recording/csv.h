// Traces as text: one header row, one line per row.
#pragma once
#include <filesystem>
#include <string>

#include "core/files/atomic_file.h"
#include "core/recording/trace.h"

namespace gaitlab {

/// One header row of names, then one line per row: the shortest text that reads back to the same double, whatever the locale;
/// lines end in '\n'. Names that hold a comma or a quote are quoted (RFC 4180). The file appears whole or not at all. RunError:
/// cannot be written (see AtomicFile), or a name that is empty or holds a line break.
void write_csv(const Trace& trace, const std::filesystem::path& path, Existing existing = Existing::replaced);

/// The same as a text; `path` is what an error calls it. All of it is in memory: for small tables.
std::string csv_text(const Trace& trace, const std::filesystem::path& path);

/// What write_csv wrote: names and values; units and definitions are not in the file and stay empty. nan and inf are numbers
/// here. InputError at FILE:LINE:COL (columns count bytes): empty file, no header, empty or repeated column name, a row with
/// too few or too many cells, a cell that is not a number or outside the range of a double, a last line without line end (a
/// truncated file); at FILE: cannot be read.
Trace read_csv(const std::filesystem::path& path);

}  // namespace gaitlab
