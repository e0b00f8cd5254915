#include "core/files/csv_table.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <nlohmann/json.hpp>
#include <stdexcept>

#include "core/files/json_place.h"

namespace gaitlab {

namespace {

constexpr std::string_view kByteOrderMark = "\xEF\xBB\xBF";

[[noreturn]] void fail_at(std::size_t line, std::size_t column, const std::string& what) {
  throw std::invalid_argument("line " + std::to_string(line) + ", column " + std::to_string(column) + ": " + what);
}

std::string in_marks(const std::string& text) { return "'" + text.substr(0, 40) + "'"; }

}  // namespace

CsvTable::CsvTable(std::string_view text) {
  if (text.starts_with(kByteOrderMark)) text.remove_prefix(kByteOrderMark.size());
  const std::size_t first = text.find_first_not_of(" \t\r\n");
  if (first != std::string_view::npos && text[first] == '{') {
    read_entries(text);
    return;
  }
  for (std::size_t line = 1; !text.empty(); ++line) {
    const std::size_t end = text.find('\n');
    Row row{line, split(text.substr(0, end))};
    text = end == std::string_view::npos ? "" : text.substr(end + 1);
    if (row.cells[0].text.starts_with('#') || (row.cells.size() == 1 && row.cells[0].text.empty())) continue;
    if (names_.empty()) {
      head_ = std::move(row);
      read_names();
    } else if (row.cells.size() != names_.size()) {
      fail_at(line, 1, std::to_string(row.cells.size()) + " cells; expected " + std::to_string(names_.size()));
    } else {
      rows_.push_back(std::move(row));
    }
  }
  if (names_.empty()) throw std::invalid_argument("the table is empty; expected a line with the names of its columns");
}

std::vector<CsvTable::Cell> CsvTable::split(std::string_view line) {
  std::vector<Cell> cells;
  for (std::size_t from = 0; from <= line.size();) {
    const std::size_t end = std::min(line.find(',', from), line.size());
    std::size_t first = from;
    std::size_t last = end;
    while (first < end && (line[first] == ' ' || line[first] == '\t')) ++first;
    while (last > first && (line[last - 1] == ' ' || line[last - 1] == '\t' || line[last - 1] == '\r')) --last;
    cells.push_back({std::string(line.substr(first, last - first)), first + 1});
    from = end + 1;
  }
  return cells;
}

void CsvTable::read_names() {
  const std::string& first = head_.cells[0].text;
  if (const std::size_t other = first.find_first_of(";\t"); head_.cells.size() == 1 && other != std::string::npos)
    fail_at(head_.line, head_.cells[0].at + other, "expected cells between commas; found " + in_marks(first));
  for (const Cell& cell : head_.cells) {
    if (cell.text.empty()) fail_at(head_.line, cell.at, "a column has no name");
    if (has(cell.text)) fail_at(head_.line, cell.at, "there is a column " + in_marks(cell.text) + " already");
    names_.push_back(cell.text);
  }
}

void CsvTable::read_entries(std::string_view text) {
  using Json = nlohmann::ordered_json;
  json_ = true;
  Json json;
  try {
    json = Json::parse(text);
  } catch (const Json::parse_error& error) {
    const SourceLocation place = json_place("", text, error.byte);
    fail_at(static_cast<std::size_t>(place.line), static_cast<std::size_t>(place.column),
            "the text is not JSON from here on: it is cut or damaged");
  } catch (const Json::exception&) {
    throw std::invalid_argument("the JSON has a number beyond the range of a double");
  }
  const Json& entries = json["entries"];
  if (!entries.is_array() || entries.empty() || !entries.front().is_object()) {
    throw std::invalid_argument(
        "the JSON has no entries; expected {\"entries\": [{\"timestamp\": 0, \"position\": 0.1}, ...]}");
  }
  for (const auto& [name, value] : entries.front().items()) names_.push_back(name);
  for (const Json& entry : entries) {
    Row row{rows_.size() + 1, {}};
    for (const std::string& name : names_) {
      const auto value = entry.is_object() ? entry.find(name) : entry.end();
      if (value == entry.end())
        throw std::invalid_argument("entry " + std::to_string(row.line) + ": there is no key " + in_marks(name));
      row.cells.push_back({value->is_boolean()  ? std::to_string(static_cast<int>(value->get<bool>()))
                           : value->is_string() ? value->get<std::string>()
                                                : value->dump(),
                           0});
    }
    rows_.push_back(std::move(row));
  }
}

void CsvTable::fail_in(const Row& row, std::size_t column, const std::string& what) const {
  if (!json_) fail_at(row.line, row.cells[column].at, what);
  throw std::invalid_argument("entry " + std::to_string(row.line) + ", key " + in_marks(names_[column]) + ": " + what);
}

std::size_t CsvTable::find(std::string_view name) const {
  return static_cast<std::size_t>(std::find(names_.begin(), names_.end(), name) - names_.begin());
}

std::size_t CsvTable::known(std::string_view name) const {
  const std::size_t at = find(name);
  if (at < names_.size()) return at;
  std::string all;
  for (const std::string& one : names_) all += (all.empty() ? "" : ", ") + one;
  throw std::invalid_argument("there is no column " + in_marks(std::string(name)) + "; known columns: " + all.substr(0, 200));
}

std::vector<double> CsvTable::column(std::string_view name, double scale) const {
  const std::size_t at = known(name);
  std::vector<double> numbers;
  numbers.reserve(rows_.size());
  for (const Row& row : rows_) {
    const std::string& text = row.cells[at].text;
    double value = 0;
    const auto [stopped, error] = std::from_chars(text.data(), text.data() + text.size(), value);
    if (error != std::errc() || stopped != text.data() + text.size() || !std::isfinite(value))
      fail_in(row, at, in_marks(text) + " is not a finite number");
    numbers.push_back(value / scale);
  }
  return numbers;
}

std::vector<std::string> CsvTable::texts(std::string_view name) const {
  const std::size_t at = known(name);
  std::vector<std::string> texts;
  for (const Row& row : rows_) texts.push_back(row.cells[at].text);
  return texts;
}

void CsvTable::fail(std::size_t row, std::string_view name, const std::string& what) const {
  fail_in(rows_[row], find(name), what);
}

void CsvTable::fail(std::string_view name, const std::string& what) const {
  fail_in(json_ ? rows_.front() : head_, find(name), what);
}

}  // namespace gaitlab
