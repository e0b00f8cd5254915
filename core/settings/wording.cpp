#include "core/settings/wording.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace gaitlab {
namespace {

bool unbounded(double limit) { return !(std::abs(limit) < 1e300); }

}  // namespace

std::string number_text(double value) { return fmt::format("{}", value); }

std::string with_unit(double value, const std::string& unit) {
  return unit.empty() ? number_text(value) : number_text(value) + " " + unit;
}

std::string in_unit(const Spec& spec) { return *spec.unit == '\0' ? "" : std::string(" in ") + spec.unit; }

std::string in_degrees(double value, const std::string& unit) {
  if (unit != "rad" || !(std::abs(value) <= 3600 && std::abs(value) > 2 * std::numbers::pi)) return "";
  return fmt::format("; {:.6g} degrees are {:.4g} rad", value, value * std::numbers::pi / 180);
}

std::string counted(std::size_t n, const std::string& what) { return fmt::format("{} {}{}", n, what, n == 1 ? "" : "s"); }

std::string range_text(const Spec& spec) {
  const bool low = !unbounded(spec.min);
  const bool high = !unbounded(spec.max);
  const bool positive = spec.min == kPositive;
  const std::string unit = spec.unit;
  if (positive && high) return "more than 0 and up to " + with_unit(spec.max, unit);
  if (positive) return "more than " + with_unit(0, unit);
  if (low && high) return number_text(spec.min) + " to " + with_unit(spec.max, unit);
  if (low) return "at least " + with_unit(spec.min, unit);
  if (high) return "at most " + with_unit(spec.max, unit);
  return {};
}

std::string clipped(const std::string& text) {
  constexpr std::size_t kLongest = 60;
  std::string out;
  const auto goes_on = [&](std::size_t i) { return i < text.size() && (static_cast<unsigned char>(text[i]) & 0xC0U) == 0x80; };
  for (std::size_t i = 0; i < text.size();) {
    if (out.size() >= kLongest) return out + "...";
    std::size_t character = 1;
    while (character < 4 && goes_on(i + character)) ++character;
    out += one_line(text.substr(i, character));
    i += character;
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

std::string wrapped(const std::string& text, std::size_t indent, std::size_t width) {
  std::string out;
  for (std::size_t begin = 0; begin < text.size();) {
    const auto take = [&] {
      const std::size_t end = std::min(text.find('\n', begin), text.size());
      std::string line = text.substr(begin, end - begin);
      begin = end + 1;
      return line;
    };
    std::string line = take();
    const bool code = line.starts_with("    ");
    const std::size_t own = code ? line.find_first_not_of(' ') : 0;  // blanks before the first word
    while (indent + line.size() > width) {
      std::size_t at = line.rfind(' ', width - indent);
      if (at == std::string::npos || at < line.find_first_not_of(' ')) at = line.find(' ', line.find_first_not_of(' '));
      if (at == std::string::npos) break;
      out += std::string(indent, ' ') + line.substr(0, line.find_last_not_of(' ', at) + 1) + "\n";
      line.erase(0, line.find_first_not_of(' ', at));
      if (code) {
        line.insert(0, own + 8, ' ');
      } else if (begin < text.size() && text[begin] != ' ' && text[begin] != '\n') {
        line += " " + take();  // the rest of the line continues the paragraph
      }
    }
    out += (line.empty() ? "" : std::string(indent, ' ')) + line + "\n";
  }
  return out;
}

std::string aligned(const std::vector<std::vector<std::string>>& rows, std::size_t indent) {
  std::vector<std::size_t> widths(rows.empty() ? 0 : rows.front().size(), 0);
  for (const std::vector<std::string>& row : rows) {
    for (std::size_t i = 0; i < row.size(); ++i) widths[i] = std::max(widths[i], row[i].size());
  }
  std::string text;
  for (const std::vector<std::string>& row : rows) {
    text += fmt::format("{:{}}{:<{}}", "", indent, row[0], widths[0]);
    for (std::size_t i = 1; i < row.size(); ++i) text += fmt::format("  {:>{}}", row[i], widths[i]);
    text += "\n";
  }
  return text;
}

std::string offer(const std::string& found, const std::vector<std::string>& known, const std::string& kind) {
  const std::string near = nearest(found, known);
  if (!near.empty()) return "; did you mean " + in_quotes(near) + "?";
  return known.empty() ? "; there are no " + kind : "; known " + kind + ": " + joined(known);
}

const char* noun(Among among) {
  switch (among) {
    case Among::joints:
    case Among::motors:
      return "joint";
    case Among::modules:
      return "module";
    case Among::bodies:
      return "body";
    case Among::words:
      break;
  }
  return "name";
}

std::vector<std::string> to_strings(std::span<const char* const> names) { return {names.begin(), names.end()}; }

void add_all(const InputError& error, Problems& problems) {
  for (const Problem& problem : error.problems()) problems.add(problem.place, problem.text).notes = problem.notes;
}

bool is_name(const std::string& text, const std::string& also) {
  // The function std::isalnum would depend on the locale.
  const auto within = [](char c, char from, char to) { return c >= from && c <= to; };
  const auto fits = [&](char c) {
    return within(c, 'a', 'z') || within(c, 'A', 'Z') || within(c, '0', '9') || also.find(c) != std::string::npos;
  };
  return !text.empty() && text.size() <= 100 && std::all_of(text.begin(), text.end(), fits);
}

}  // namespace gaitlab
