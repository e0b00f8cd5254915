// Reader of tables of numbers in binary files of other programs.
#pragma once
#include <cstddef>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

namespace gaitlab {

struct NumberTable {
  std::size_t rows = 0, columns = 0;
  std::vector<double> values;  ///< row by row
};

/// Error in a file of numbers. The message contains the value found and the value expected.
struct TableError : std::runtime_error {
  using std::runtime_error::runtime_error;
};

inline constexpr std::string_view kNpyMagic = "\x93NUMPY";
inline constexpr std::string_view kPngMagic = "\x89PNG\r\n\x1a\n";

/// Reads a matrix that numpy.save wrote, with float32, float64 or integers in C order
/// (https://numpy.org/neps/nep-0001-npy-format.html). Throws TableError for any other content, for a length that differs from
/// the header, and for more than `most` numbers. These errors precede the allocation of memory.
NumberTable read_npy(std::string_view bytes, std::size_t most);

/// Header of a numpy.save file for float64 values, which follow in C order, least significant byte first. The length of the
/// header is a multiple of 64.
std::string npy_head(std::size_t rows, std::size_t columns);

/// Reads the grey values, 0 to 65535, of a PNG with 16 bits and no interlacing (https://www.w3.org/TR/png/), top row first.
NumberTable read_grey_png(std::string_view bytes, std::size_t most);

}  // namespace gaitlab
