// Table of numbers in a CSV text of any origin, such as a log of a test bench.
#pragma once
#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

namespace gaitlab {

/// Columns by name. Lines that are empty or begin with # are skipped, and so are a byte order mark and the CR of a line end.
/// Blanks around cells do not count. Only the cells of columns that are asked for must be numbers.
class CsvTable {
 public:
  /// Splits the text; the first line names the columns. Throws std::invalid_argument (`line 3, column 7: ...`; columns count
  /// bytes) for a text without such a line, an empty or repeated name, a row with another number of cells, and a last row
  /// without line end that has too few cells.
  explicit CsvTable(std::string_view text);

  [[nodiscard]] const std::vector<std::string>& names() const { return names_; }
  [[nodiscard]] std::size_t rows() const { return rows_.size(); }
  [[nodiscard]] bool has(std::string_view name) const { return find(name) < names_.size(); }
  /// Numbers of a column, divided by `scale`. Throws std::invalid_argument at the first cell that is not a finite number, and
  /// for an unknown name.
  [[nodiscard]] std::vector<double> column(std::string_view name, double scale = 1) const;
  /// Throws std::invalid_argument at the cell of a row in the column `name`, or at the name itself.
  [[noreturn]] void fail(std::size_t row, std::string_view name, const std::string& what) const;
  [[noreturn]] void fail(std::string_view name, const std::string& what) const;

 private:
  struct Cell {
    std::string text;
    std::size_t at;  ///< byte in the line, from 1
  };
  struct Row {
    std::size_t line;
    std::vector<Cell> cells;
  };
  static std::vector<Cell> split(std::string_view line);
  void read_names();
  [[nodiscard]] std::size_t find(std::string_view name) const;

  std::vector<std::string> names_;
  Row head_ = {};  ///< the names, with their places
  std::vector<Row> rows_;
};

}  // namespace gaitlab
