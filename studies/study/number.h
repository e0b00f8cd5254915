// Numbers in the journal and in parameters.
#pragma once
#include <charconv>
#include <cstdint>
#include <string>

namespace gaitlab::studies {

/// Value of a text that is a number, in any locale.
inline double number_of(const std::string& text) {
  double value = 0;
  std::from_chars(text.data(), text.data() + text.size(), value);
  return value;
}

/// The number of a run in a journal. A forged negative one becomes larger than that of any run.
inline std::uint64_t run_number_of(const std::string& text) {
  std::int64_t value = 0;
  std::from_chars(text.data(), text.data() + text.size(), value);
  return static_cast<std::uint64_t>(value);
}

}  // namespace gaitlab::studies
