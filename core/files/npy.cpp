#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <bit>
#include <charconv>
#include <cstdint>
#include <cstring>

#include "core/files/number_table.h"

namespace gaitlab {

namespace {

constexpr std::size_t kMostHeader = std::size_t{1} << 16;
constexpr const char* kAsked = "expected a matrix of float32, float64 or integers in C order, as numpy.save writes it";

[[noreturn]] void refuse_npy(const std::string& found) { throw TableError(fmt::format("{}; {}", found, kAsked)); }

/// The printable characters of a text, shortened.
std::string printable(std::string_view text) {
  constexpr std::size_t kMost = 24;
  std::string all;
  for (const char c : text.substr(0, kMost)) all += c >= ' ' && c <= '~' ? c : '?';
  return text.size() > kMost ? all + "..." : all;
}

struct NpyHeader {
  std::string type;  ///< such as '<f4'
  bool fortran = false;
  std::vector<std::size_t> shape;
};

/// Reader of the header, which is a Python dict: {'descr': '<f4', 'fortran_order': False, 'shape': (3, 4), }.
class HeaderReader {
 public:
  explicit HeaderReader(std::string_view text) : rest_(text) {}

  NpyHeader read() {
    NpyHeader header;
    bool type = false;
    bool order = false;
    bool shape = false;
    need('{');
    while (!take('}')) {
      const std::string_view key = quoted();
      need(':');
      if (key == "descr" && !type) {
        type = true;
        if (next() == '[') refuse_npy("it holds records of several fields");
        header.type = quoted();
      } else if (key == "fortran_order" && !order) {
        order = true;
        header.fortran = word() == "True";
      } else if (key == "shape" && !shape) {
        shape = true;
        header.shape = numbers();
      } else {
        broken();
      }
      if (!take(',') && next() != '}') broken();
    }
    if (!type || !order || !shape || next() != '\0') broken();
    return header;
  }

 private:
  [[noreturn]] static void broken() { refuse_npy("its header is not a NumPy header"); }

  char next() {
    while (!rest_.empty() && (rest_[0] == ' ' || rest_[0] == '\n')) rest_.remove_prefix(1);
    return rest_.empty() ? '\0' : rest_[0];
  }
  bool take(char c) {
    if (next() != c) return false;
    rest_.remove_prefix(1);
    return true;
  }
  void need(char c) {
    if (!take(c)) broken();
  }
  std::string_view quoted() {
    const char quote = next();
    if (quote != '\'' && quote != '"') broken();
    const std::size_t end = rest_.find(quote, 1);
    if (end == std::string_view::npos) broken();
    return cut(1, end);
  }
  std::string_view word() {
    next();
    const std::string_view found = cut(0, std::min(rest_.find_first_not_of("TrueFals"), rest_.size()), 0);
    if (found != "True" && found != "False") broken();
    return found;
  }
  std::vector<std::size_t> numbers() {
    constexpr std::size_t kMostSides = 32;  // largest number of dimensions in NumPy
    std::vector<std::size_t> all;
    need('(');
    while (!take(')')) {
      next();
      std::size_t value = 0;
      const auto [end, error] = std::from_chars(rest_.data(), rest_.data() + rest_.size(), value);
      if (error != std::errc() || all.size() == kMostSides) broken();
      rest_.remove_prefix(static_cast<std::size_t>(end - rest_.data()));
      all.push_back(value);
      if (!take(',') && next() != ')') broken();
    }
    return all;
  }
  /// The text from `begin` to `end`. The reader advances to `behind` bytes past `end`.
  std::string_view cut(std::size_t begin, std::size_t end, std::size_t behind = 1) {
    const std::string_view text = rest_.substr(begin, end - begin);
    rest_.remove_prefix(end + behind);
    return text;
  }

  std::string_view rest_;
};

template <class Number>
void convert(std::string_view bytes, bool swapped, std::vector<double>& values) {
  values.resize(bytes.size() / sizeof(Number));
  for (std::size_t i = 0; i < values.size(); ++i) {
    std::array<char, sizeof(Number)> one;
    std::memcpy(one.data(), bytes.data() + i * sizeof(Number), sizeof(Number));
    if (swapped) std::ranges::reverse(one);
    values[i] = static_cast<double>(std::bit_cast<Number>(one));
  }
}

using Convert = void (*)(std::string_view, bool, std::vector<double>&);
struct NumberType {
  std::string_view name;
  std::size_t size;
  Convert convert;
};
constexpr NumberType kNumberTypes[] = {
    {"f4", 4, convert<float>},         {"f8", 8, convert<double>},        {"i1", 1, convert<std::int8_t>},
    {"i2", 2, convert<std::int16_t>},  {"i4", 4, convert<std::int32_t>},  {"i8", 8, convert<std::int64_t>},
    {"u1", 1, convert<std::uint8_t>},  {"u2", 2, convert<std::uint16_t>}, {"u4", 4, convert<std::uint32_t>},
    {"u8", 8, convert<std::uint64_t>},
};

const NumberType& number_type(const std::string& type) {
  if (type.size() > 1 && std::string_view("<>|=").find(type[0]) != std::string_view::npos) {
    for (const NumberType& known : kNumberTypes) {
      if (known.name == std::string_view(type).substr(1)) return known;
    }
  }
  const bool objects = type.ends_with('O');
  refuse_npy(objects ? "it holds Python objects (dtype object), which can execute code"
                     : fmt::format("its numbers are of type '{}'", printable(type)));
}

std::string shape_text(const std::vector<std::size_t>& shape) {
  return fmt::format("({}{})", fmt::join(shape, ", "), shape.size() == 1 ? "," : "");
}

}  // namespace

NumberTable read_npy(std::string_view bytes, std::size_t most) {
  const auto byte = [&](std::size_t i) { return static_cast<std::size_t>(static_cast<unsigned char>(bytes[i])); };
  constexpr std::size_t kStart = 8;  // size of the magic text and of the two bytes of its version
  if (!bytes.starts_with(kNpyMagic)) refuse_npy("it does not begin as a file of NumPy");
  if (bytes.size() < kStart + 4) refuse_npy("it ends within its header");
  const std::size_t version = byte(6);
  if (version < 1 || version > 3) refuse_npy(fmt::format("its format has the version {}", version));
  const std::size_t length = version == 1 ? 2 : 4;
  std::size_t header = 0;
  for (std::size_t i = length; i-- > 0;) header = 256 * header + byte(kStart + i);
  if (header > kMostHeader) refuse_npy(fmt::format("its header has {} bytes", header));
  if (bytes.size() < kStart + length + header) refuse_npy("it ends within its header");
  const NpyHeader about = HeaderReader(bytes.substr(kStart + length, header)).read();
  const NumberType& type = number_type(about.type);
  if (about.shape.size() != 2) refuse_npy(fmt::format("its shape is {}", shape_text(about.shape)));
  if (about.fortran) refuse_npy("it is in Fortran order (numpy.ascontiguousarray makes C order of it)");
  NumberTable table{about.shape[0], about.shape[1], {}};
  if (table.columns != 0 && table.rows > most / table.columns) {
    throw TableError(fmt::format("its shape is {}; expected at most {} numbers", shape_text(about.shape), most));
  }
  bytes.remove_prefix(kStart + length + header);
  if (const std::size_t expected = table.rows * table.columns * type.size; bytes.size() != expected) {
    throw TableError(fmt::format("{} bytes of numbers follow its header; expected {} for shape {} of type '{}'", bytes.size(),
                                 expected, shape_text(about.shape), about.type));
  }
  constexpr bool kLittle = std::endian::native == std::endian::little;
  type.convert(bytes, about.type[0] == (kLittle ? '>' : '<'), table.values);
  return table;
}

std::string npy_head(std::size_t rows, std::size_t columns) {
  constexpr std::size_t kStart = 10;  // size of magic text, version and length
  constexpr std::size_t kUnit = 64;
  std::string about = fmt::format("{{'descr': '<f8', 'fortran_order': False, 'shape': ({}, {}), }}", rows, columns);
  about.append(kUnit - 1 - (kStart + about.size()) % kUnit, ' ');
  about += '\n';
  std::string head = std::string(kNpyMagic) + '\x01' + '\0';
  head += static_cast<char>(about.size() % 256);
  head += static_cast<char>(about.size() / 256);
  return head + about;
}

}  // namespace gaitlab
