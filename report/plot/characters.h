// Characters of a UTF-8 text, one after another.
#pragma once
#include <cstddef>
#include <string_view>

namespace gaitlab::report {

struct Character {
  std::size_t length =
      0;  ///< bytes; 0 for invalid UTF-8 and for a control character, a surrogate or a noncharacter, which XML forbids
  char32_t code = 0;
};

/// The first character of `text`, which must not be empty.
Character first_character(std::string_view text);

}  // namespace gaitlab::report
