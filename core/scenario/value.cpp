#include "core/scenario/value.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <limits>

namespace gaitlab {
namespace {

bool is_digit(char c) { return c >= '0' && c <= '9'; }
bool is_letter(char c) { return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z'); }

std::string lower(std::string text) {
  for (char& c : text) {
    if (c >= 'A' && c <= 'Z') c = static_cast<char>(c - 'A' + 'a');
  }
  return text;
}

std::string without_sign(const std::string& text) {
  return !text.empty() && (text[0] == '+' || text[0] == '-') ? text.substr(1) : text;
}

std::size_t skip_digits(const std::string& text, std::size_t at) {
  while (at < text.size() && is_digit(text[at])) ++at;
  return at;
}

/// digits [. digits] [e [sign] digits], with a digit before or after the point.
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

bool has_leading_zero(const std::string& unsigned_text) {
  return unsigned_text.size() > 1 && unsigned_text[0] == '0' && is_digit(unsigned_text[1]);
}

bool is_not_finite(const std::string& unsigned_text) {
  const std::string text = lower(unsigned_text);
  return text == ".nan" || text == ".inf" || text == "nan" || text == "inf" || text == "infinity";
}

bool is_other_base(const std::string& unsigned_text) {
  return unsigned_text.size() > 2 && unsigned_text[0] == '0' &&
         std::string("xXoObB").find(unsigned_text[1]) != std::string::npos;
}

bool has_separator(const std::string& unsigned_text) {
  std::string text = unsigned_text;
  std::erase(text, '_');
  return text.size() < unsigned_text.size() && is_decimal(text);
}

/// "is FOUND; expected a KIND in UNIT": `kind` like "number", `how` an adjective or an afterthought.
std::string expected(const Node& node, const std::string& before, const std::string& kind, const std::string& unit,
                     const std::string& after = {}) {
  return fmt::format("is {}; expected a {}{}{}{}", found(node), before, kind, unit.empty() ? "" : " in " + unit, after);
}

/// Why a plain scalar that is not a decimal number is refused.
std::string refuse_number(const Node& node, const std::string& kind, const std::string& unit) {
  if (node.kind != Node::Kind::scalar) return expected(node, "", kind, unit);
  if (node.quoted) return expected(node, "", kind, unit, ", without quotes");
  const std::string text = without_sign(node.text);
  if (is_not_finite(text)) return expected(node, "finite ", kind, unit);
  if (is_other_base(text)) return expected(node, "decimal ", kind, unit);
  if (has_separator(text)) return expected(node, "", kind, unit, " without '_'");
  if (has_leading_zero(text)) return expected(node, "", kind, unit, " without a leading zero");
  return expected(node, "", kind, unit);
}

bool unbounded(double limit) { return !(std::abs(limit) < 1e300); }

}  // namespace

Reading<double> read_number(const Node& node, const std::string& unit) {
  const std::string text = without_sign(node.text);
  if (node.kind != Node::Kind::scalar || node.quoted || !is_decimal(text) || has_leading_zero(text)) {
    return {0, refuse_number(node, "number", unit)};
  }
  double value = 0;
  const auto [end, failure] = std::from_chars(text.data(), text.data() + text.size(), value);
  const bool zero = text.find_first_of("123456789") >= std::min(text.find_first_of("eE"), text.size());
  // Both are checked: whether from_chars reports an underflow differs between library versions.
  if (failure == std::errc::result_out_of_range || !std::isfinite(value) || (value == 0 && !zero)) {
    return {0, fmt::format("is {}; expected a number that fits a double (0, or 5e-324 to 1.8e+308)", clipped(node.text))};
  }
  if (failure != std::errc() || end != text.data() + text.size()) return {0, refuse_number(node, "number", unit)};
  return {node.text[0] == '-' ? -value : value};
}

Reading<std::int64_t> read_integer(const Node& node) {
  const std::string text = without_sign(node.text);
  const bool whole = !text.empty() && skip_digits(text, 0) == text.size();
  if (node.kind != Node::Kind::scalar || node.quoted || !whole || has_leading_zero(text)) {
    return {0, refuse_number(node, "whole number", "")};
  }
  std::int64_t value = 0;
  const auto [end, failure] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (failure != std::errc()) return {0, fmt::format("is {}; expected a whole number that fits 64 bits", clipped(node.text))};
  return {node.text[0] == '-' ? -value : value};
}

Reading<bool> read_flag(const Node& node) {
  if (node.kind == Node::Kind::scalar && !node.quoted && (node.text == "true" || node.text == "false")) {
    return {node.text == "true"};
  }
  return {false, fmt::format("is {}; expected true or false", found(node))};
}

Reading<std::string> read_scalar(const Node& node) {
  if (node.kind == Node::Kind::scalar) return {node.text};
  return {{}, fmt::format("is {}; expected a text", found(node))};
}

std::string number_text(double value) { return fmt::format("{}", value); }

std::string with_unit(double value, const std::string& unit) {
  return unit.empty() ? number_text(value) : number_text(value) + " " + unit;
}

std::string in_unit(const Spec& spec) { return *spec.unit == '\0' ? "" : std::string(" in ") + spec.unit; }

std::string counted(std::size_t n, const std::string& what) { return fmt::format("{} {}{}", n, what, n == 1 ? "" : "s"); }

std::string range_text(const Spec& spec) {
  const bool low = !unbounded(spec.min);
  const bool high = !unbounded(spec.max);
  const bool positive = spec.min == std::numeric_limits<double>::denorm_min();
  const std::string unit = spec.unit;
  if (positive && high) return "more than 0 and up to " + with_unit(spec.max, unit);
  if (positive) return "more than " + with_unit(0, unit);
  if (low && high) return number_text(spec.min) + " to " + with_unit(spec.max, unit);
  if (low) return "at least " + with_unit(spec.min, unit);
  if (high) return "at most " + with_unit(spec.max, unit);
  return {};
}

std::string found(const Node& node) {
  switch (node.kind) {
    case Node::Kind::null:
      return "empty";
    case Node::Kind::list:
      return "a list";
    case Node::Kind::map:
      return "a map";
    case Node::Kind::scalar:
      break;
  }
  if (node.quoted) return "\"" + clipped(node.text) + "\" in quotes";
  const std::string text = without_sign(node.text);
  const bool numeric = is_decimal(text) || is_not_finite(text) || is_other_base(text) || has_separator(text);
  return numeric ? clipped(node.text) : in_quotes(node.text);
}

std::string clipped(const std::string& text) {
  constexpr std::size_t kLongest = 60;
  std::string out;
  for (std::size_t i = 0; i < text.size(); ++i) {
    const auto c = static_cast<unsigned char>(text[i]);
    const bool starts_character = (c & 0xC0U) != 0x80;
    if (out.size() >= kLongest && starts_character) return out + "...";
    out += c < 0x20 || c == 0x7F ? fmt::format("\\x{:02x}", c) : std::string(1, text[i]);
  }
  return out;
}

std::string in_quotes(const std::string& text) { return "'" + clipped(text) + "'"; }

std::string joined(const std::vector<std::string>& names) {
  constexpr std::size_t kMost = 24;
  std::string out;
  for (std::size_t i = 0; i < names.size() && i < kMost; ++i) out += (i > 0 ? ", " : "") + clipped(names[i]);
  if (names.size() > kMost) out += fmt::format(" and {} more", names.size() - kMost);
  return out;
}

std::string offer(const std::string& found, const std::vector<std::string>& known, const std::string& kind) {
  // A name far too long is near to none, and its edit distance costs time.
  const std::string near = found.size() > 200 ? std::string{} : nearest(found, known);
  if (!near.empty()) return "; did you mean " + in_quotes(near) + "?";
  return known.empty() ? "; there are no " + kind : "; known " + kind + ": " + joined(known);
}

std::vector<std::string> to_strings(std::span<const char* const> names) { return {names.begin(), names.end()}; }

void add_all(const InputError& error, Problems& problems) {
  for (const Problem& problem : error.problems()) problems.add(problem.place, problem.text).notes = problem.notes;
}

bool is_name(const std::string& text, const std::string& also) {
  const auto fits = [&](char c) { return is_letter(c) || is_digit(c) || also.find(c) != std::string::npos; };
  return !text.empty() && text.size() <= 100 && std::all_of(text.begin(), text.end(), fits);
}

}  // namespace gaitlab
