// Numbers as the journal and the parameters write them.
#pragma once
#include <charconv>
#include <cstdint>
#include <string>

namespace gaitlab::studies {

/// Of a text that is a number, whatever the locale.
inline double number_of(const std::string& text) {
  double value = 0;
  std::from_chars(text.data(), text.data() + text.size(), value);
  return value;
}

/// The number of a run as a journal holds it. A forged one may be negative: it becomes larger than that of any run.
inline std::uint64_t run_number_of(const std::string& text) {
  std::int64_t value = 0;
  std::from_chars(text.data(), text.data() + text.size(), value);
  return static_cast<std::uint64_t>(value);
}

}  // namespace gaitlab::studies
