// Ordered list of the columns of a table, searchable by name.
#pragma once
#include <cstddef>
#include <cstdint>
#include <initializer_list>
#include <string>
#include <string_view>
#include <vector>

namespace gaitlab {

struct Column {
  std::string name;        ///< identifies a joint by its index, not by its name: `joint.7.torque`
  std::string unit;        ///< "N m", "rad", "" ...
  std::string definition;  ///< one sentence: quantity, sign, axes
};

/// A list of columns that reads like a vector. A search by name takes constant time, because a report searches for one name per
/// joint and quantity. The index of names is built when columns are added, so that several threads can read one table.
class ColumnList {
 public:
  ColumnList() = default;
  ColumnList(std::vector<Column> columns);            // NOLINT(google-explicit-constructor): tables are made of lists
  ColumnList(std::initializer_list<Column> columns);  // NOLINT(google-explicit-constructor)

  [[nodiscard]] std::size_t size() const { return list_.size(); }
  [[nodiscard]] bool empty() const { return list_.empty(); }
  const Column& operator[](std::size_t index) const { return list_[index]; }
  [[nodiscard]] const Column& at(std::size_t index) const { return list_.at(index); }
  [[nodiscard]] const Column& front() const { return list_.front(); }
  [[nodiscard]] const Column& back() const { return list_.back(); }
  [[nodiscard]] auto begin() const { return list_.begin(); }
  [[nodiscard]] auto end() const { return list_.end(); }
  [[nodiscard]] const std::vector<Column>& list() const { return list_; }

  void push_back(Column column);
  /// Index of the first column of this name, or size().
  [[nodiscard]] std::size_t find(std::string_view name) const;
  /// Changes the list. `change` receives the vector.
  template <class Change>
  void change(const Change& change) {
    change(list_);
    place_all();
  }

 private:
  void place_all();
  void place(std::size_t index);
  [[nodiscard]] std::size_t slot(std::string_view name) const;

  std::vector<Column> list_;
  std::vector<std::uint32_t>
      slots_;  ///< hash table of names: index + 1 of a column, or 0 in a free slot; size a power of two; empty for few columns
};

}  // namespace gaitlab
