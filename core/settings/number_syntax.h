// Syntax of numbers in YAML, decimal and other, for the strict reader and for its messages about refused texts.
#pragma once
#include <string>

namespace gaitlab {

inline bool is_digit(char c) { return c >= '0' && c <= '9'; }

/// Position after the last digit of the digits that begin at `at`.
std::size_t skip_digits(const std::string& text, std::size_t at);
std::string without_sign(const std::string& text);

// Decimal number in a text without a sign: digits [. digits] [e [sign] digits], with a digit before or after the point.
bool is_decimal(const std::string& text);
bool has_leading_zero(const std::string& text);
/// True for nan, inf and the spellings of these in YAML.
bool is_not_finite(const std::string& text);
/// True for prefixes such as 0x, 0o and 0b.
bool is_other_base(const std::string& text);
/// True for underscores between digits, as in 1_000.
bool has_separator(const std::string& text);

/// True if a human reader would probably take the text for a number.
bool looks_like_a_number(const std::string& text);

/// True if some reader of YAML 1.1 or 1.2 takes the text for a number, a date, a flag or null, such as 0x10, 010, 2026-01-02,
/// yes and null.
bool is_no_text_elsewhere(const std::string& text);

}  // namespace gaitlab
