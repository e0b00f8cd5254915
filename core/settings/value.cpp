#include "core/settings/value.h"

#include <fmt/format.h>

#include <charconv>
#include <cmath>

#include "core/settings/number_syntax.h"
#include "core/settings/wording.h"

namespace gaitlab {
namespace {

/// Text "is FOUND; expected a KIND in UNIT". `before` precedes the kind, and `after` follows it.
std::string expected(const Node& node, const std::string& before, const std::string& kind, const std::string& unit,
                     const std::string& after = {}) {
  return fmt::format("is {}; expected a {}{}{}{}", found(node), before, kind, unit.empty() ? "" : " in " + unit, after);
}

bool is_digits(const std::string& text) { return !text.empty() && skip_digits(text, 0) == text.size(); }

/// Reason to refuse a plain scalar that is not a decimal number.
std::string refuse_number(const Node& node, const std::string& kind, const std::string& unit) {
  if (node.kind != Node::Kind::scalar) return expected(node, "", kind, unit);
  if (node.quoted) return expected(node, "", kind, unit, ", without quotes");
  const std::string text = without_sign(node.text);
  if (is_not_finite(text)) return expected(node, "finite ", kind, unit);
  if (is_other_base(text)) return expected(node, "decimal ", kind, unit);
  if (has_separator(text)) return expected(node, "", kind, unit, " without '_'");
  if (has_leading_zero(text)) return expected(node, "", kind, unit, " without a leading zero");
  if (const std::size_t comma = text.find(','); is_digits(text.substr(0, comma)) && is_digits(text.substr(comma + 1))) {
    return expected(
        node, "", kind, unit,
        fmt::format("; use a decimal point: {}.{}", node.text.substr(0, node.text.find(',')), text.substr(comma + 1)));
  }
  return expected(node, "", kind, unit);
}

}  // namespace

Reading<double> read_number(const Node& node, const std::string& unit) {
  const std::string text = without_sign(node.text);
  if (node.kind != Node::Kind::scalar || node.quoted || !is_decimal(text) || has_leading_zero(text)) {
    return {0, refuse_number(node, "number", unit)};
  }
  double value = 0;
  const auto [end, failure] = std::from_chars(text.data(), text.data() + text.size(), value);
  const bool zero = text.find_first_of("123456789") >= std::min(text.find_first_of("eE"), text.size());
  // Overflow and underflow are checked here, because versions of from_chars report an underflow differently.
  if (failure == std::errc::result_out_of_range || !std::isfinite(value) || (value == 0 && !zero)) {
    return {0, fmt::format("is {}; expected a number that fits a double (0, or 5e-324 to 1.8e+308)", clipped(node.text))};
  }
  if (failure != std::errc() || end != text.data() + text.size()) return {0, refuse_number(node, "number", unit)};
  return {node.text[0] == '-' ? -value : value};
}

Reading<std::int64_t> read_integer(const Node& node) {
  const std::string text = without_sign(node.text);
  if (node.kind != Node::Kind::scalar || node.quoted || !is_digits(text) || has_leading_zero(text)) {
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

std::string decimal_comma(const Node& map, std::size_t i) {
  const std::string& rest = map.keys[i].first;
  if (i == 0 || map.items[i].kind != Node::Kind::null || !is_digits(rest)) return "";
  const Node& before = map.items[i - 1];
  if (before.kind != Node::Kind::scalar || before.quoted || !is_digits(without_sign(before.text))) return "";
  return fmt::format("{0}: {1},{2} is two entries; write {1}.{2}", clipped(map.keys[i - 1].first), before.text, clipped(rest));
}

}  // namespace gaitlab
