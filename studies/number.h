// Numbers as the journal and the parameters write them.
#pragma once
#include <charconv>
#include <string>

namespace gaitlab::studies {

/// Of a text that is a number, whatever the locale.
inline double number_of(const std::string& text) {
  double value = 0;
  std::from_chars(text.data(), text.data() + text.size(), value);
  return value;
}

}  // namespace gaitlab::studies
