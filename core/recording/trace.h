// Trace: named columns with unit and definition, and one row per trace period.
#pragma once
#include <cstddef>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "core/files/hash.h"
#include "core/files/spill.h"
#include "core/recording/column_list.h"

namespace gaitlab {

/// Row-major table; the first column is `t`.
struct Trace {
  ColumnList columns;
  SpilledVector<double> values;  ///< rows() * columns.size()

  [[nodiscard]] std::size_t rows() const { return columns.empty() ? 0 : values.size() / columns.size(); }
  [[nodiscard]] double at(std::size_t row, std::size_t column) const { return values[row * columns.size() + column]; }
  [[nodiscard]] std::span<const double> row(std::size_t index) const {
    return {values.data() + index * columns.size(), columns.size()};
  }
  /// Index of the column, or columns.size().
  [[nodiscard]] std::size_t find(std::string_view name) const { return columns.find(name); }
};

/// Hash of the names and the bytes of all values. The text is `1-`, the number of the format, and 16 hex digits of the WordHash
/// of all names, each followed by a NUL, and of the values.
std::string hash(const Trace& trace);

}  // namespace gaitlab
