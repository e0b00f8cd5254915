// What looks like a number in YAML, decimal or not: for reading numbers strictly and for messages on what is refused.
#pragma once
#include <string>

namespace gaitlab {

inline bool is_digit(char c) { return c >= '0' && c <= '9'; }

/// Where the digits of the text end that begin at `at`.
std::size_t skip_digits(const std::string& text, std::size_t at);
std::string without_sign(const std::string& text);

// Of texts without a sign.
/// digits [. digits] [e [sign] digits], with a digit before or after the point.
bool is_decimal(const std::string& text);
bool has_leading_zero(const std::string& text);
/// nan, inf and how YAML spells them.
bool is_not_finite(const std::string& text);
/// 0x, 0o, 0b ...
bool is_other_base(const std::string& text);
/// 1_000
bool has_separator(const std::string& text);

/// Whether the reader of the text would say it is a number.
bool looks_like_a_number(const std::string& text);

}  // namespace gaitlab
