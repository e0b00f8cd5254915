#include "core/recording/csv.h"

#include <fmt/compile.h>
#include <fmt/format.h>

#include <charconv>
#include <iterator>
#include <optional>
#include <string>
#include <string_view>
#include <system_error>
#include <unordered_set>

#include "core/errors.h"

namespace gaitlab {

namespace {

constexpr std::size_t kPiece = std::size_t{1} << 20;  // bytes per system call, so that calls are few and memory is bounded

std::string header_cell(const std::string& name, const std::filesystem::path& path) {
  if (name.empty() || name.find_first_of("\r\n") != std::string::npos)
    throw RunError(fmt::format("{}: column name \"{}\" cannot be written to a CSV file", path.string(), name));
  return csv_quoted(name);
}

// Splits a text into lines and lines into cells, and tracks the position for error messages.
class CsvReader {
 public:
  CsvReader(std::string file, std::string_view text) : file_(std::move(file)), rest_(text) {}

  // Returns false at the end of the text. A last line without line end is an error, because a number may be truncated.
  bool next_line() {
    if (rest_.empty()) return false;
    ++line_number_;
    const std::size_t end = rest_.find('\n');
    if (end == std::string_view::npos) throw error(rest_.size(), "the last line has no line end: the file is truncated");
    line_ = rest_.substr(0, end);
    rest_.remove_prefix(end + 1);
    if (!line_.empty() && line_.back() == '\r') line_.remove_suffix(1);
    return true;
  }

  [[nodiscard]] InputError error(std::size_t offset, std::string text) const {
    return {SourceLocation{file_, line_number_, static_cast<int>(offset) + 1}, std::move(text)};
  }

  [[nodiscard]] std::string_view line() const { return line_; }

 private:
  std::string file_;
  std::string_view rest_;
  std::string_view line_ = {};
  int line_number_ = 0;
};

// Parses the number at the start of the cell at `first`. If there is no number, ec is not std::errc(). If the number fills the
// cell, ptr is the end of the cell.
std::from_chars_result parse(const char* first, const char* last, double& value) {
  return std::from_chars(first, last, value, std::chars_format::general);
}

std::string_view cell_at(std::string_view line, std::size_t offset) {
  return line.substr(offset, line.find(',', offset) - offset);
}

// Reads a column name at `offset`, and moves `offset` to the following comma or the end of the line.
std::string read_name(const CsvReader& reader, std::size_t& offset) {
  const std::string_view line = reader.line();
  if (offset == line.size() || line[offset] != '"') {
    const std::string_view cell = cell_at(line, offset);
    offset += cell.size();
    return std::string(cell);
  }
  const std::size_t start = offset++;
  std::string name;
  while (true) {
    const std::size_t quote = line.find('"', offset);
    if (quote == std::string_view::npos) throw reader.error(start, "the quoted column name has no closing quote");
    name += line.substr(offset, quote - offset);
    offset = quote + 1;
    if (offset == line.size() || line[offset] != '"') break;
    name += '"';
    ++offset;
  }
  if (offset < line.size() && line[offset] != ',') throw reader.error(offset, "expected a comma after the quoted column name");
  return name;
}

bool is_number(std::string_view cell) {
  double value = 0;
  const char* last = cell.data() + cell.size();
  const auto [end, code] = parse(cell.data(), last, value);
  return code != std::errc::invalid_argument && end == last;
}

std::vector<Column> read_header(const CsvReader& reader) {
  std::vector<Column> columns;
  std::unordered_set<std::string> seen;
  bool numbers = true;
  std::optional<InputError> repeated;  // thrown only if the line is a header
  for (std::size_t offset = 0;; ++offset) {
    const std::size_t start = offset;
    std::string name = read_name(reader, offset);
    if (name.empty()) throw reader.error(start, "empty column name");
    numbers = numbers && is_number(name);
    if (!seen.insert(name).second && !repeated)
      repeated = reader.error(start, fmt::format("column \"{}\" is there twice", name));
    columns.push_back({std::move(name), {}, {}});
    if (offset == reader.line().size()) break;
  }
  if (numbers) throw reader.error(0, "the header row of column names is missing");
  if (repeated) throw *repeated;
  return columns;
}

[[noreturn]] void refuse_cell(const CsvReader& reader, std::size_t offset, std::errc code) {
  const std::string_view cell = cell_at(reader.line(), offset);
  if (code == std::errc::result_out_of_range && is_number(cell))
    throw reader.error(offset, fmt::format("{} is outside the range of a double", cell));
  throw reader.error(offset, fmt::format("\"{}\" is not a number", cell.substr(0, 40)));
}

void read_row(const CsvReader& reader, std::size_t columns, SpilledVector<double>& values) {
  const char* const first = reader.line().data();
  const char* const last = first + reader.line().size();
  const char* at = first;
  for (std::size_t cell = 0;; ++cell, ++at) {
    if (cell == columns) throw reader.error(static_cast<std::size_t>(at - first), fmt::format("more than {} cells", columns));
    const auto [end, code] = parse(at, last, values.emplace_back());
    if (code != std::errc() || (end != last && *end != ',')) refuse_cell(reader, static_cast<std::size_t>(at - first), code);
    at = end;
    if (at == last) {
      if (cell + 1 < columns) throw reader.error(reader.line().size(), fmt::format("{} cells, expected {}", cell + 1, columns));
      return;
    }
  }
}

/// Passes pieces of the text to `put`, each larger than `piece` bytes except the last.
template <class Put>
void put_csv(const Trace& trace, const std::filesystem::path& path, std::size_t piece, const Put& put) {
  fmt::memory_buffer buffer;
  const auto flush_above = [&](std::size_t size) {
    if (buffer.size() <= size) return;
    put(std::string_view(buffer.data(), buffer.size()));
    buffer.clear();
    release(trace.values);
  };
  const char* separator = "";
  for (const Column& column : trace.columns) {
    fmt::format_to(std::back_inserter(buffer), "{}{}", separator, header_cell(column.name, path));
    separator = ",";
  }
  buffer.push_back('\n');
  for (std::size_t row = 0; row < trace.rows(); ++row) {
    for (const double value : trace.row(row)) {
      fmt::format_to(std::back_inserter(buffer), FMT_COMPILE("{}"), value);
      buffer.push_back(',');
    }
    buffer[buffer.size() - 1] = '\n';
    flush_above(piece);
  }
  flush_above(0);
}

}  // namespace

void write_csv(const Trace& trace, const std::filesystem::path& path, Existing existing) {
  AtomicFile file(path, existing);
  put_csv(trace, path, kPiece, [&](std::string_view text) { file.write(text); });
  file.commit();
}

std::string csv_text(const Trace& trace, const std::filesystem::path& path) {
  std::string all;
  put_csv(trace, path, kPiece, [&](std::string_view text) { all += text; });
  return all;
}

std::string csv_quoted(const std::string& text) {
  if (text.find_first_of(",\"\n\r") == std::string::npos) return text;
  std::string quoted = "\"";
  for (const char c : text) quoted += c == '"' ? std::string("\"\"") : std::string(1, c);
  return quoted + '"';
}

Trace read_csv(const std::filesystem::path& path) {
  const std::string text = read_file(path, kMostTrace);
  if (text.empty()) throw InputError({path.string(), 1, 1}, "the file is empty: a header row of column names is missing");
  CsvReader reader(path.string(), text);
  reader.next_line();
  Trace trace;
  trace.columns = read_header(reader);
  while (reader.next_line()) read_row(reader, trace.columns.size(), trace.values);
  return trace;
}

}  // namespace gaitlab
