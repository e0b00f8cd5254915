// CSV files of traces, with one header row and one line per row.
#pragma once
#include <filesystem>
#include <string>

#include "core/files/atomic_file.h"
#include "core/recording/trace.h"

namespace gaitlab {

/// Writes one header row of names, then one line per row. Each number is the shortest text that is read back as the same double
/// in any locale; lines end in '\n'. Names that contain a comma or a quote are quoted (RFC 4180). The file appears whole or not
/// at all. Throws RunError if the file cannot be written (see AtomicFile), or a name is empty or contains a line break.
void write_csv(const Trace& trace, const std::filesystem::path& path, Existing existing = Existing::replaced);

/// Returns the content of a CSV file as a string, for small tables. Error messages contain `path`.
std::string csv_text(const Trace& trace, const std::filesystem::path& path);

/// Text as a cell of a CSV table, in quotes if it contains commas, quotes or line ends (RFC 4180).
std::string csv_quoted(const std::string& text);

/// Reads a file of write_csv. Units and definitions are not in the file and stay empty. nan and inf are accepted as numbers.
/// Throws InputError at FILE if the file cannot be read. Throws InputError at FILE:LINE:COL (columns count bytes) if the file
/// is empty, has no header, or has an empty or repeated column name. The same error results from a row with too few or too many
/// cells, from a cell that is not a number or outside the range of a double, and from a last line without line end (a truncated
/// file).
Trace read_csv(const std::filesystem::path& path);

}  // namespace gaitlab
