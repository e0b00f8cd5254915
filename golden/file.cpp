#include "golden/file.h"

#include <fmt/format.h>
#include <zlib.h>

#include <algorithm>
#include <bit>
#include <charconv>
#include <cmath>
#include <cstdint>
#include <limits>
#include <stdexcept>

#include "core/errors.h"

namespace gaitlab::golden {

namespace {

constexpr std::string_view kName = "gaitlab-golden-";
constexpr std::string_view kVersion = "1";
constexpr std::string_view kSize = "bytes in all: ";
constexpr std::string_view kHash = "; FNV-1a of what follows: ";
constexpr double kSteps = 65534;              // number of grid steps, which is the largest integer
constexpr double kEven = 1e-6;                // share of the row spacing; rounding of k h is about 1e-16 of t
constexpr std::size_t kMostInflation = 1032;  // largest factor by which deflate can expand
constexpr std::size_t kSizeDigits = 20;       // digits of a size in the header, padded so that the header has a fixed length

std::string header(std::size_t body_size, std::string_view body) {
  const auto text = [&](std::size_t size) {
    return fmt::format("{}{}\n{}{:>{}}{}{}\n", kName, kVersion, kSize, size, kSizeDigits, kHash, hash(body));
  };
  return text(text(0).size() + body_size);
}

// ---- numbers as bytes, least significant first on every machine

template <class T>
void put(std::string& bytes, T number) {
  for (std::size_t i = 0; i < sizeof(T); ++i) bytes += static_cast<char>(static_cast<unsigned char>(number >> (8 * i)));
}
void put(std::string& bytes, double number) { put(bytes, std::bit_cast<std::uint64_t>(number)); }
void put(std::string& bytes, const std::string& text) {
  if (text.size() > std::numeric_limits<std::uint16_t>::max()) throw std::invalid_argument("a name is too long");
  put(bytes, static_cast<std::uint16_t>(text.size()));
  bytes += text;
}

/// Error for bytes that have no valid meaning.
struct Damage : std::runtime_error {
  using std::runtime_error::runtime_error;
};

class Cursor {
 public:
  explicit Cursor(std::string_view bytes) : rest_(bytes) {}

  std::string_view take(std::size_t size) {
    if (size > rest_.size()) throw Damage("it ends too early");
    const std::string_view taken = rest_.substr(0, size);
    rest_.remove_prefix(size);
    return taken;
  }
  template <class T>
  T number() {
    std::uint64_t value = 0;
    const std::string_view bytes = take(sizeof(T));
    for (std::size_t i = 0; i < sizeof(T); ++i) value |= std::uint64_t{static_cast<unsigned char>(bytes[i])} << (8 * i);
    return static_cast<T>(value);
  }
  double real() {
    const double value = std::bit_cast<double>(number<std::uint64_t>());
    if (!std::isfinite(value)) throw Damage("a number is not finite");
    return value;
  }
  std::string text() { return std::string(take(number<std::uint16_t>())); }
  [[nodiscard]] std::string_view rest() const { return rest_; }

 private:
  std::string_view rest_;
};

// ---- packing

double even_spacing(const Trace& trace) {
  if (trace.columns.empty() || trace.columns.front().name != "t") throw std::invalid_argument("the first column is not t");
  const std::size_t rows = trace.rows();
  const double spacing = rows > 1 ? trace.at(1, 0) : 0;
  for (std::size_t k = 0; k < rows; ++k) {
    if (!(std::abs(trace.at(k, 0) - static_cast<double>(k) * spacing) <= kEven * spacing))
      throw std::invalid_argument("rows are not evenly spaced from t = 0 on");
  }
  return spacing;
}

struct Grid {
  double low = 0, precision = 0;
};

Grid grid_of(const Trace& trace, std::size_t column) {
  double low = std::numeric_limits<double>::infinity();
  double high = -low;
  for (std::size_t k = 0; k < trace.rows(); ++k) {
    const double value = trace.at(k, column);
    if (!std::isfinite(value)) throw std::invalid_argument(trace.columns[column].name + " is not finite");
    low = std::min(low, value);
    high = std::max(high, value);
  }
  if (trace.rows() == 0) return {};
  const Grid grid{low, (high - low) / kSteps};
  if (!std::isfinite(grid.precision)) throw std::invalid_argument(trace.columns[column].name + " has no finite range");
  return grid;
}

// Adds the low bytes of all rows to `low` and the high bytes to `high`. Nearly all high bytes are 0 or 255, which deflate
// compresses well.
void add_differences(const Trace& trace, std::size_t column, Grid grid, std::string& low, std::string& high) {
  std::uint16_t before = 0;
  for (std::size_t k = 0; k < trace.rows(); ++k) {
    const double steps = grid.precision > 0 ? std::round((trace.at(k, column) - grid.low) / grid.precision) : 0;
    const auto whole = static_cast<std::uint16_t>(std::clamp(steps, 0.0, kSteps));
    const auto difference = static_cast<std::uint16_t>(whole - before);
    low += static_cast<char>(static_cast<unsigned char>(difference & 0xFFU));
    high += static_cast<char>(static_cast<unsigned char>(difference >> 8U));
    before = whole;
  }
}

std::string deflated(const std::string& raw) {
  uLongf size = compressBound(raw.size());
  std::string packed(size, '\0');
  const int code = compress2(reinterpret_cast<Bytef*>(packed.data()), &size, reinterpret_cast<const Bytef*>(raw.data()),
                             raw.size(), Z_BEST_COMPRESSION);
  if (code != Z_OK) throw std::bad_alloc();  // lack of memory is the only possible reason
  packed.resize(size);
  return packed;
}

// ---- unpacking

std::string inflated(std::string_view packed, std::size_t size) {
  if (size > kMostInflation * packed.size()) throw Damage("more rows than it can hold");
  std::string raw(size, '\0');
  uLongf got = size;
  const int code =
      uncompress(reinterpret_cast<Bytef*>(raw.data()), &got, reinterpret_cast<const Bytef*>(packed.data()), packed.size());
  if (code != Z_OK || got != size) throw Damage("its rows cannot be inflated");
  return raw;
}

RoundedTrace from_body(std::string_view body) {
  Cursor at(body);
  const auto columns = at.number<std::uint32_t>();
  const auto rows = at.number<std::uint32_t>();
  const double spacing = at.real();
  RoundedTrace rounded;
  rounded.trace.columns = {{"t", "s", {}}};
  rounded.precision = {0};
  std::vector<double> low;
  for (std::uint32_t i = 0; i < columns; ++i) {
    std::string name = at.text();
    rounded.trace.columns.push_back({std::move(name), at.text(), {}});
    low.push_back(at.real());
    rounded.precision.push_back(at.real());
  }
  const std::size_t values = std::size_t{columns} * rows;
  if (rows > kMostInflation * body.size()) throw Damage("more rows than it can hold");  // also tested without columns
  const std::string raw = inflated(at.rest(), 2 * values);
  rounded.trace.values.resize((std::size_t{columns} + 1) * rows);
  for (std::size_t k = 0; k < rows; ++k) rounded.trace.values[k * (columns + 1U)] = static_cast<double>(k) * spacing;
  for (std::size_t i = 0; i < columns; ++i) {
    std::uint16_t whole = 0;
    for (std::size_t k = 0; k < rows; ++k) {
      const auto byte = [&](std::size_t where) { return static_cast<unsigned char>(raw[where]); };
      const std::size_t where = i * rows + k;
      whole = static_cast<std::uint16_t>(whole + (byte(where) | byte(values + where) << 8U));
      rounded.trace.values[k * (columns + 1U) + i + 1] = low[i] + whole * rounded.precision[i + 1];
    }
  }
  return rounded;
}

// Error message about the header, or "" with the bytes after it in `body`.
std::string complaint(std::string_view bytes, std::string_view& body) {
  std::string truncated = fmt::format("is truncated: {} bytes", bytes.size());
  const std::size_t expected = header(0, {}).size();
  if (bytes.size() < kName.size() && kName.starts_with(bytes)) return truncated;
  if (!bytes.starts_with(kName)) return "is not a golden trace of gaitlab";
  const std::string_view version = bytes.substr(kName.size(), bytes.find('\n') - kName.size());
  if (version != kVersion) {
    if (bytes.size() < expected) return truncated;
    if (version.ends_with('\r')) return kLineEnds;
    const bool number = !version.empty() && version.find_first_not_of("0123456789") == std::string_view::npos;
    if (!number) return "is corrupt: its first line is damaged";
    return fmt::format("has format {}{}; this gaitlab reads {}{}: make it anew with gaitlab approve", kName, version, kName,
                       kVersion);
  }
  if (bytes.size() < expected) return truncated;
  const std::string_view size_text = bytes.substr(kName.size() + kVersion.size() + 1 + kSize.size(), kSizeDigits);
  const std::size_t first = std::min(size_text.find_first_not_of(' '), size_text.size());
  std::size_t size = 0;
  const auto [end, code] = std::from_chars(size_text.data() + first, size_text.data() + size_text.size(), size);
  if (code != std::errc() || end != size_text.data() + size_text.size()) return "is corrupt: its second line is damaged";
  if (bytes.size() < size) return fmt::format("is truncated: {} of {} bytes", bytes.size(), size);
  body = bytes.substr(expected);
  if (bytes.size() > size || bytes.substr(0, expected) != header(body.size(), body))
    return "is corrupt: its bytes are not those that were written";
  return "";
}

}  // namespace

std::string pack(const Trace& trace) {
  const double spacing = even_spacing(trace);
  std::string body;
  put(body, static_cast<std::uint32_t>(trace.columns.size() - 1));
  put(body, static_cast<std::uint32_t>(trace.rows()));
  put(body, spacing);
  std::string low;
  std::string high;
  for (std::size_t i = 1; i < trace.columns.size(); ++i) {
    const Grid grid = grid_of(trace, i);
    put(body, trace.columns[i].name);
    put(body, trace.columns[i].unit);
    put(body, grid.low);
    put(body, grid.precision);
    add_differences(trace, i, grid, low, high);
  }
  body += deflated(low + high);
  return header(body.size(), body) + body;
}

RoundedTrace unpack(std::string_view bytes, const std::filesystem::path& path) {
  const SourceLocation place{path.string()};
  std::string_view body;
  if (std::string text = complaint(bytes, body); !text.empty()) throw InputError(place, std::move(text));
  try {
    return from_body(body);
  } catch (const Damage& damage) {
    throw InputError(place, fmt::format("is corrupt: {}", damage.what()));
  }
}

}  // namespace gaitlab::golden
