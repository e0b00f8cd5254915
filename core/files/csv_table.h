// Table of numbers in a CSV or JSON text of any origin, such as a log of a test bench.
#pragma once
#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

namespace gaitlab {

/// Columns by name. Lines that are empty or begin with # are skipped, and so are a byte order mark and the CR of a line end.
/// Blanks around cells do not count. Only the cells of columns that are asked for must be numbers.
///
/// A text that begins with { is JSON, as the recorder of Rhoban/bam writes it: {"mass": 0.5, "entries": [{"timestamp": 0,
/// "position": 0.1, "torque_enable": true}, ...]}. The columns are the keys of the first entry, `true` is 1 and `false` is 0.
class CsvTable {
 public:
  /// Splits the text; the first line names the columns. Throws std::invalid_argument (`line 3, column 7: ...`; columns count
  /// bytes) for a text without such a line, an empty or repeated name, a row with another number of cells, and a last row
  /// without line end that has too few cells. Of JSON: for a text that is not JSON or has no entries, and (`entry 3: ...`) for
  /// an entry without a key of the first one.
  explicit CsvTable(std::string_view text);

  [[nodiscard]] const std::vector<std::string>& names() const { return names_; }
  [[nodiscard]] std::size_t rows() const { return rows_.size(); }
  [[nodiscard]] bool has(std::string_view name) const { return find(name) < names_.size(); }
  /// Numbers of a column, divided by `scale`. Throws std::invalid_argument at the first cell that is not a finite number, and
  /// for an unknown name.
  [[nodiscard]] std::vector<double> column(std::string_view name, double scale = 1) const;
  /// Texts of a column. Throws std::invalid_argument for an unknown name.
  [[nodiscard]] std::vector<std::string> texts(std::string_view name) const;
  [[nodiscard]] int line(std::size_t row) const { return static_cast<int>(rows_[row].line); }  ///< line of a row, from 1
  /// Throws std::invalid_argument at the cell of a row in the column `name`, or at the name itself.
  [[noreturn]] void fail(std::size_t row, std::string_view name, const std::string& what) const;
  [[noreturn]] void fail(std::string_view name, const std::string& what) const;

 private:
  struct Cell {
    std::string text;
    std::size_t at;  ///< byte in the line, from 1
  };
  struct Row {
    std::size_t line;  ///< in JSON the number of the entry, from 1
    std::vector<Cell> cells;
  };
  static std::vector<Cell> split(std::string_view line);
  void read_names();
  void read_entries(std::string_view text);
  [[noreturn]] void fail_in(const Row& row, std::size_t column, const std::string& what) const;
  [[nodiscard]] std::size_t find(std::string_view name) const;
  [[nodiscard]] std::size_t known(std::string_view name) const;  ///< throws for an unknown name

  bool json_ = false;
  std::vector<std::string> names_;
  Row head_ = {};  ///< the names, with their places
  std::vector<Row> rows_;
};

/// True for a message that begins with a place in the text.
inline bool has_place(std::string_view message) { return message.starts_with("line ") || message.starts_with("entry "); }

}  // namespace gaitlab
