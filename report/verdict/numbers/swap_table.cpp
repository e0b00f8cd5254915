#include "report/verdict/numbers/swap_table.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <string_view>

#include "core/recording/csv.h"
#include "core/settings/wording.h"
#include "report/verdict/numbers/number_texts.h"

namespace gaitlab::report {

namespace {

using Json = nlohmann::ordered_json;

constexpr std::string_view kOutcome = "outcome";

bool broke_off(const NamedRun& one) { return !one.run.summary.outcome.done(); }

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

std::string in_one_line(std::string text) {
  std::replace(text.begin(), text.end(), '\n', ' ');
  return text;
}

/// CSV cell on one line, because many readers end a row at a line break within quotes.
std::string quoted(std::string text) { return csv_quoted(in_one_line(std::move(text))); }

std::string csv_cell(const Json& value) {
  if (value.is_null()) return "";
  if (value.is_string()) return quoted(value.get<std::string>());
  if (!value.is_number_float()) return value.dump();
  return std::isfinite(value.get<double>()) ? number_text(value) : "";
}

/// Line below a table on the energy that gears create in a run, which makes the run's cost of transport too low. Empty if this
/// energy is small.
std::string created_line(const std::string& name, const NamedRun& one) {
  const std::string much = broke_off(one) ? "" : texts::much_created(one.run);
  return much.empty() ? "" : fmt::format("{}: {}\n", name, much);
}

}  // namespace

std::string swap_table(const std::vector<NamedRun>& runs) {
  std::size_t width = 3;
  for (const NamedRun& one : runs) width = std::max(width, one.name.size());
  const auto name = [&](const std::string& text) { return fmt::format("{:<{}}", text, width); };
  std::string text = cells(name(""), [](const SummaryNumber& number) { return number.swap.head; }) +
                     cells(name("cpg"), [](const SummaryNumber& number) { return number.swap.under; });
  for (const NamedRun& one : runs) {
    text += broke_off(one) ? without_blanks_at_end(name(one.name) + " " + one.run.summary.outcome.text())
                           : cells(name(one.name), [&](const SummaryNumber& number) { return number.swap.cell(one.run); });
  }
  for (const NamedRun& one : runs) text += created_line(one.name, one);
  return text;
}

namespace {

/// CSV line: `text`, then a cell for each entry of the summary that is a single number or text and is not measured by the
/// clock.
template <class Cell>
std::string csv_row(std::string text, const Cell& cell) {
  for (const SummaryNumber& number : summary_numbers()) {
    if (number.of_joint == nullptr && !number.list && !number.clock) text += "," + cell(number);
  }
  return text + "\n";
}

std::string csv_head(const std::string& first) {
  return csv_row(first, [](const SummaryNumber& number) {
    return *number.unit == '\0' ? std::string(number.key) : fmt::format("{} ({})", number.key, number.unit);
  });
}

std::string csv_numbers(const std::string& first, const NamedRun& one) {
  return csv_row(first, [&](const SummaryNumber& number) {
    return broke_off(one) && number.key != kOutcome ? "" : csv_cell(number.value(one.run));
  });
}

Json json_numbers(const NamedRun& one) {
  Json numbers = numbers_json(one.run);
  for (const SummaryNumber& number : summary_numbers()) {
    if (number.clock) numbers.erase(number.key);
  }
  for (auto& [key, value] : numbers.items()) {
    if (broke_off(one) && key != kOutcome) value = nullptr;
  }
  return numbers;
}

/// Numbers in the columns of the matrix, which are a selection of the columns of `swap`.
std::vector<const SummaryNumber*> matrix_columns() {
  std::vector<const SummaryNumber*> columns;
  for (const SummaryNumber* number : placed(&SummaryNumber::swap)) {
    const std::string_view key = number->key;
    if (key == "speed" || key == "cost_of_transport.electrical") columns.push_back(number);
  }
  return columns;
}

}  // namespace

std::string swap_csv(const std::vector<NamedRun>& runs) {
  std::string text = csv_head("cpg");
  for (const NamedRun& one : runs) text += csv_numbers(quoted(one.name), one);
  return text;
}

std::string swap_json(const std::vector<NamedRun>& runs) {
  Json all = Json::object();
  for (const NamedRun& one : runs) all[one.name] = json_numbers(one);
  return all.dump(2) + "\n";
}

std::string why_not(const MatrixRun& one) {
  if (broke_off(one.named)) return in_one_line(one.named.run.summary.outcome.text());
  return in_one_line(one.verdict.why());
}

std::string matrix_table(const std::vector<MatrixRun>& runs) {
  std::size_t cpg = 3;
  std::size_t scenario = 8;
  for (const MatrixRun& one : runs) {
    cpg = std::max(cpg, one.named.name.size());
    scenario = std::max(scenario, one.scenario.size());
  }
  const std::vector<const SummaryNumber*> columns = matrix_columns();
  const auto row = [&](const std::string& name, const std::string& of, const auto& cell, const std::string& behind) {
    std::string text = fmt::format("{:<{}} {:<{}}", name, cpg, of, scenario);
    for (const SummaryNumber* column : columns) text += fmt::format(" {:>{}}", cell(*column), column->swap.width);
    return without_blanks_at_end(text + "  " + behind);
  };
  std::string text = row(
                         "", "", [](const SummaryNumber& number) { return number.swap.head; }, "") +
                     row(
                         "cpg", "scenario", [](const SummaryNumber& number) { return number.swap.under; }, "feasible");
  for (const MatrixRun& one : runs) {
    const Word word = one.verdict.word;
    const char* mark = word == Word::feasible ? "y" : word == Word::not_judged ? "-" : "n";
    const auto cell = [&](const SummaryNumber& number) { return broke_off(one.named) ? "-" : number.swap.cell(one.named.run); };
    text += row(one.named.name, one.scenario, cell, fmt::format("{}  {}", mark, why_not(one)));
  }
  for (const MatrixRun& one : runs) text += created_line(one.named.name + " in " + one.scenario, one.named);
  return text;
}

std::string matrix_csv(const std::vector<MatrixRun>& runs) {
  std::string text = csv_head("cpg,scenario,verdict,why");
  for (const MatrixRun& one : runs) {
    const std::string first = fmt::format("{},{},{},{}", quoted(one.named.name), quoted(one.scenario),
                                          quoted(name_of(one.verdict.word)), quoted(why_not(one)));
    text += csv_numbers(first, one.named);
  }
  return text;
}

std::string matrix_json(const std::vector<MatrixRun>& runs) {
  Json all = Json::object();
  for (const MatrixRun& one : runs) {
    Json& cell = all[one.named.name][one.scenario] = json_numbers(one.named);
    cell["verdict"] = name_of(one.verdict.word);
    cell["why"] = why_not(one);
  }
  return all.dump(2) + "\n";
}

}  // namespace gaitlab::report
