// Conversion of text in the journal and in parameters to numbers.
#pragma once
#include <charconv>
#include <cstdint>
#include <string>

namespace gaitlab::studies {

/// Value of a text that is a number, independent of the locale.
inline double number_of(const std::string& text) {
  double value = 0;
  std::from_chars(text.data(), text.data() + text.size(), value);
  return value;
}

/// Run number in a journal. A forged negative number becomes larger than the number of any run.
inline std::uint64_t run_number_of(const std::string& text) {
  std::int64_t value = 0;
  std::from_chars(text.data(), text.data() + text.size(), value);
  return static_cast<std::uint64_t>(value);
}

}  // namespace gaitlab::studies
