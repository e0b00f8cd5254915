// Syntax of numbers in YAML, decimal or not: for strict reading and for messages about texts that are refused.
#pragma once
#include <string>

namespace gaitlab {

inline bool is_digit(char c) { return c >= '0' && c <= '9'; }

/// End of the digits that begin at `at`.
std::size_t skip_digits(const std::string& text, std::size_t at);
std::string without_sign(const std::string& text);

// For texts without a sign: digits [. digits] [e [sign] digits], with a digit before or after the point.
bool is_decimal(const std::string& text);
bool has_leading_zero(const std::string& text);
/// nan, inf and YAML's spellings of them.
bool is_not_finite(const std::string& text);
/// 0x, 0o, 0b ...
bool is_other_base(const std::string& text);
/// 1_000
bool has_separator(const std::string& text);

/// Whether a human reader would take the text for a number.
bool looks_like_a_number(const std::string& text);

}  // namespace gaitlab
