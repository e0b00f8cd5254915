// The trace of a golden as a small file: 16 bits per value, deflated.
#pragma once
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "core/recording/trace.h"

namespace gaitlab::golden {

/// A trace rounded to a separate grid per column: value = lowest value + integer * precision.
struct RoundedTrace {
  Trace trace;                    ///< `t` first; names and units, no definitions
  std::vector<double> precision;  ///< one per column, in its unit: its range / 65534; 0: exact (`t`, constant columns)
};

/// The bytes of format gaitlab-golden-1: two lines of text (format; size and FNV-1a of the rest), then columns, rows, spacing,
/// per column name, unit, lowest value and precision, and the integers as differences from row to row, deflated (zlib). The
/// same trace gives the same bytes with the same zlib. Throws std::invalid_argument for rows not evenly spaced from t = 0 on, a
/// value that is not finite, a range beyond a double.
std::string pack(const Trace& trace);

/// Reads the bytes of pack; `path` is for messages only. Throws InputError `PATH: error: ...`, one message each: is truncated,
/// is not a golden trace, has another format version, is corrupt. Bytes with a wrong checksum are not interpreted.
RoundedTrace unpack(std::string_view bytes, const std::filesystem::path& path);

}  // namespace gaitlab::golden
