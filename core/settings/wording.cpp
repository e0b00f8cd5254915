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
  if (low && high && spec.min == spec.max) return with_unit(spec.min, unit);
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

namespace {

/// A line of a text, with the columns of its first word and of its last cell, which two or more blanks precede.
struct Layout {
  explicit Layout(const std::string& line) : own(std::min(line.find_first_not_of(' '), line.size())), cell(own) {
    const std::size_t gap = line.rfind("  ");
    if (gap != std::string::npos && gap >= own) cell = gap + 2;
  }
  [[nodiscard]] bool cells() const { return cell > own; }
  std::size_t own, cell;
};

/// True if a line continues an earlier line: as part of a paragraph, or of a last cell that begins in the same column.
bool continues(const std::string& line, const Layout& first) {
  const Layout next(line);
  if (line.empty() || next.cells()) return false;
  return first.cells() ? next.own == first.cell : first.own < 4 && next.own == 0;
}

/// Position of the blank at which a line is broken.
std::size_t break_of(const std::string& line, std::size_t room) {
  const std::size_t first = line.find_first_not_of(' ');
  const std::size_t at = line.rfind(' ', room);
  return at == std::string::npos || at < first ? line.find(' ', first) : at;
}

}  // namespace

std::string wrapped(const std::string& text, std::size_t indent, std::size_t width) {
  constexpr std::size_t kLeastCell = 30;  // a narrower cell is placed below the line
  std::string out;
  std::size_t begin = 0;
  const auto next = [&] { return text.substr(begin, std::min(text.find('\n', begin), text.size()) - begin); };
  while (begin < text.size()) {
    std::string line = next();
    begin += line.size() + 1;
    const Layout layout(line);
    const bool narrow = layout.cells() && indent + layout.cell + kLeastCell > width;
    bool below = narrow && indent + layout.cell <= width;
    const std::size_t rest_at = layout.cells() && !narrow ? layout.cell : layout.own >= 4 || narrow ? layout.own + 8 : 0;
    while (indent + line.size() > width) {
      const std::size_t at = below ? layout.cell - 1 : break_of(line, width - indent);
      if (at == std::string::npos) break;
      below = false;
      out += std::string(indent, ' ') + line.substr(0, line.find_last_not_of(' ', at) + 1) + "\n";
      line.erase(0, line.find_first_not_of(' ', at));
      if (begin < text.size() && continues(next(), layout)) {
        const std::string more = next();
        begin += more.size() + 1;
        line += " " + more.substr(more.find_first_not_of(' '));
      }
      line.insert(0, rest_at, ' ');
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
  for (const Problem& problem : error.problems()) problems.add(problem);
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
