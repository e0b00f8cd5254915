#include "core/settings/number_syntax.h"

#include <algorithm>
#include <array>
#include <string_view>

namespace gaitlab {
namespace {

std::string lower(std::string text) {
  for (char& c : text) {
    if (c >= 'A' && c <= 'Z') c = static_cast<char>(c - 'A' + 'a');
  }
  return text;
}

}  // namespace

std::size_t skip_digits(const std::string& text, std::size_t at) {
  while (at < text.size() && is_digit(text[at])) ++at;
  return at;
}

std::string without_sign(const std::string& text) {
  return !text.empty() && (text[0] == '+' || text[0] == '-') ? text.substr(1) : text;
}

bool is_decimal(const std::string& text) {
  const std::size_t whole = skip_digits(text, 0);
  std::size_t at = whole;
  bool digits = whole > 0;
  if (at < text.size() && text[at] == '.') {
    const std::size_t end = skip_digits(text, at + 1);
    digits = digits || end > at + 1;
    at = end;
  }
  if (!digits) return false;
  if (at < text.size() && (text[at] == 'e' || text[at] == 'E')) {
    const std::size_t sign = at + 1 < text.size() && (text[at + 1] == '+' || text[at + 1] == '-') ? 2 : 1;
    const std::size_t end = skip_digits(text, at + sign);
    if (end == at + sign) return false;
    at = end;
  }
  return at == text.size();
}

bool has_leading_zero(const std::string& text) { return text.size() > 1 && text[0] == '0' && is_digit(text[1]); }

bool is_not_finite(const std::string& text) {
  const std::string name = lower(text);
  return name == ".nan" || name == ".inf" || name == "nan" || name == "inf" || name == "infinity";
}

bool is_other_base(const std::string& text) {
  return text.size() > 2 && text[0] == '0' && std::string("xXoObB").find(text[1]) != std::string::npos;
}

bool has_separator(const std::string& text) {
  std::string digits = text;
  std::erase(digits, '_');
  return digits.size() < text.size() && is_decimal(digits);
}

bool is_no_text_elsewhere(const std::string& text) {
  static constexpr std::array<std::string_view, 9> kWords{"null", "true", "false", "yes", "no", "on", "off", "y", "n"};
  const bool digits = !text.empty() && is_digit(text[0]) && text.find_first_not_of("0123456789_.:-") == std::string::npos;
  return digits || looks_like_a_number(text) || std::ranges::find(kWords, lower(text)) != kWords.end();
}

bool looks_like_a_number(const std::string& text) {
  const std::string digits = without_sign(text);
  return is_decimal(digits) || is_not_finite(digits) || is_other_base(digits) || has_separator(digits);
}

}  // namespace gaitlab
