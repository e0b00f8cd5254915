// The trace of a golden as a small file, with 16 bits per value in compressed form (deflate).
#pragma once
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "core/recording/trace.h"

namespace gaitlab::golden {

/// Message about a file whose line ends another program has changed.
inline constexpr const char* kLineEnds =
    "has other line ends than when it was written; `*.golden/** -text` in .gitattributes preserves them";

/// A trace with values rounded to a separate grid for each column: value = lowest value + integer * precision.
struct RoundedTrace {
  Trace trace;  ///< trace with `t` as the first column, and with names and units, but without definitions
  /// Grid spacing by column, in the column's unit: range / 65534, or 0 if exact (`t`, constant columns).
  std::vector<double> precision;
};

/// Bytes of a trace in the format gaitlab-golden-1. Two lines of text contain the format, and the size and FNV-1a hash of all
/// further bytes. Then follow the numbers of columns and rows, the spacing of rows, and per column its name, unit, lowest value
/// and precision. Last are the integers as differences from row to row, compressed (zlib). Equal traces give equal bytes with
/// the same zlib. Throws std::invalid_argument for rows that are not evenly spaced from t = 0 on, for a value that is not
/// finite, and for a range beyond a double.
std::string pack(const Trace& trace);

/// Reads the bytes of pack(). `path` is used only in messages. Throws InputError `PATH: error: ...` with a separate message for
/// bytes that are truncated, are not a golden trace, have another format version, or are corrupt. Bytes with a wrong checksum
/// are not interpreted.
RoundedTrace unpack(std::string_view bytes, const std::filesystem::path& path);

}  // namespace gaitlab::golden
