#include "core/recording/column_list.h"

#include <bit>
#include <functional>
#include <utility>

namespace gaitlab {

namespace {

constexpr std::size_t kFew = 16;  // up to this number of columns, comparing all names is as fast as a hash

}  // namespace

ColumnList::ColumnList(std::vector<Column> columns) : list_(std::move(columns)) { place_all(); }

ColumnList::ColumnList(std::initializer_list<Column> columns) : ColumnList(std::vector<Column>(columns)) {}

void ColumnList::push_back(Column column) {
  list_.push_back(std::move(column));
  if (2 * list_.size() > slots_.size()) {
    place_all();
  } else {
    place(list_.size() - 1);
  }
}

std::size_t ColumnList::find(std::string_view name) const {
  if (slots_.empty()) {
    std::size_t index = 0;
    while (index < list_.size() && list_[index].name != name) ++index;
    return index;
  }
  const std::uint32_t found = slots_[slot(name)];
  return found == 0 ? list_.size() : found - 1;
}

void ColumnList::place_all() {
  slots_.clear();
  if (list_.size() <= kFew) return;
  slots_.resize(std::bit_ceil(4 * list_.size()));
  for (std::size_t index = 0; index < list_.size(); ++index) place(index);
}

void ColumnList::place(std::size_t index) {
  std::uint32_t& found = slots_[slot(list_[index].name)];
  if (found == 0) found = static_cast<std::uint32_t>(index + 1);  // the first of two equal names is kept
}

/// Slot that contains the name, or else the free slot for it.
std::size_t ColumnList::slot(std::string_view name) const {
  const std::size_t last = slots_.size() - 1;
  std::size_t at = std::hash<std::string_view>()(name) & last;
  while (slots_[at] != 0 && list_[slots_[at] - 1].name != name) at = (at + 1) & last;
  return at;
}

}  // namespace gaitlab
