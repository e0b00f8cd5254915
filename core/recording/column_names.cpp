#include "core/recording/column_names.h"

#include <charconv>
#include <cstddef>
#include <string_view>

namespace gaitlab {

namespace {

/// Turns `stop_torque` into `stop torque` and `torque.rms` into `torque RMS`.
std::string words(std::string_view key) {
  std::string text;
  for (const char c : key) text += c == '.' || c == '_' ? ' ' : c;
  if (text == "rms" || text.ends_with(" rms")) text.replace(text.size() - 3, 3, "RMS");
  return text;
}

struct NumberedColumn {
  std::string_view kind;      // joint
  std::size_t number = 0;     // 15
  std::string_view quantity;  // torque
};

/// Splits the name of a column of a part. The kind is empty if the column does not belong to a part.
NumberedColumn numbered(std::string_view column) {
  NumberedColumn found;
  const std::size_t dot = column.find('.');
  if (dot == std::string_view::npos) return {};
  const char* const last = column.data() + column.size();
  const auto [end, error] = std::from_chars(column.data() + dot + 1, last, found.number);
  if (error != std::errc() || (end != last && *end != '.')) return {};
  found.kind = column.substr(0, dot);
  if (end != last) found.quantity = std::string_view(end + 1, static_cast<std::size_t>(last - end - 1));
  return found;
}

}  // namespace

std::string readable_column(const std::string& column, const PartNames& names) {
  const NumberedColumn part = numbered(column);
  const bool joint = part.kind == "joint" && !part.quantity.empty();
  const bool error = part.kind == "torque_error" && part.quantity.empty();
  const bool contact = part.kind == "contact" && !part.quantity.empty();
  const std::vector<std::string>& parts = contact ? names.contacts : names.joints;
  if ((!joint && !error && !contact) || part.number >= parts.size() || parts[part.number].empty()) return column;
  return parts[part.number] + " " + words(error ? part.kind : part.quantity);
}

std::string readable_number(const std::string& number) {
  const std::size_t slash = number.find('/');
  if (slash == std::string::npos) return number;
  const std::size_t dot = number.find('.', slash);
  return dot == std::string::npos ? number : number.substr(0, dot) + " " + words(std::string_view(number).substr(dot + 1));
}

}  // namespace gaitlab
