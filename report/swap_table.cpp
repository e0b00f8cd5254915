#include "report/swap_table.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <string_view>

#include "core/scenario/wording.h"

namespace gaitlab::report {

namespace {

using Json = nlohmann::ordered_json;

constexpr std::string_view kOutcome = "outcome";

bool broke_off(const NamedRun& one) { return one.run.summary.outcome != "done"; }

std::string without_blanks_at_end(std::string row) {
  row.erase(row.find_last_not_of(' ') + 1);
  return row + "\n";
}

template <class Text>
std::string cells(std::string row, Text text) {
  for (const SummaryNumber* number : placed(&SummaryNumber::swap)) {
    const int width = number->swap.width;
    row += width < 0 ? fmt::format(" {:<{}}", text(*number), -width) : fmt::format(" {:>{}}", text(*number), width);
  }
  return without_blanks_at_end(row);
}

/// RFC 4180; a line break of an outcome would end the row for many readers.
std::string quoted(std::string text) {
  std::replace(text.begin(), text.end(), '\n', ' ');
  if (text.find_first_of(",\"\r") == std::string::npos) return text;
  std::string all = "\"";
  for (const char c : text) all += c == '"' ? std::string(2, c) : std::string(1, c);
  return all + '"';
}

std::string csv_cell(const Json& value) {
  if (value.is_null()) return "";
  if (value.is_string()) return quoted(value.get<std::string>());
  if (!value.is_number_float()) return value.dump();
  return std::isfinite(value.get<double>()) ? number_text(value) : "";
}

}  // namespace

std::string swap_table(const std::vector<NamedRun>& runs) {
  std::size_t width = 3;
  for (const NamedRun& one : runs) width = std::max(width, one.name.size());
  const auto name = [&](const std::string& text) { return fmt::format("{:<{}}", text, width); };
  std::string text = cells(name(""), [](const SummaryNumber& number) { return number.swap.head; }) +
                     cells(name("cpg"), [](const SummaryNumber& number) { return number.swap.under; });
  for (const NamedRun& one : runs) {
    text += broke_off(one) ? without_blanks_at_end(name(one.name) + " " + one.run.summary.outcome)
                           : cells(name(one.name), [&](const SummaryNumber& number) { return number.swap.cell(one.run); });
  }
  return text;
}

std::string swap_csv(const std::vector<NamedRun>& runs) {
  const auto row = [](std::string text, const auto& cell) {
    for (const SummaryNumber& number : summary_numbers()) {
      if (number.of_joint == nullptr && !number.list && !number.clock) text += "," + cell(number);
    }
    return text + "\n";
  };
  std::string text = row("cpg", [](const SummaryNumber& number) {
    return *number.unit == '\0' ? std::string(number.key) : fmt::format("{} ({})", number.key, number.unit);
  });
  for (const NamedRun& one : runs) {
    text += row(quoted(one.name), [&](const SummaryNumber& number) {
      return broke_off(one) && number.key != kOutcome ? "" : csv_cell(number.value(one.run));
    });
  }
  return text;
}

std::string swap_json(const std::vector<NamedRun>& runs) {
  Json all = Json::object();
  for (const NamedRun& one : runs) {
    Json& numbers = all[one.name] = numbers_json(one.run);
    for (const SummaryNumber& number : summary_numbers()) {
      if (number.clock) numbers.erase(number.key);
    }
    for (auto& [key, value] : numbers.items()) {
      if (broke_off(one) && key != kOutcome) value = nullptr;
    }
  }
  return all.dump(2) + "\n";
}

}  // namespace gaitlab::report
