#include "core/scenario/explainer.h"

#include <algorithm>
#include <array>

#include "core/scenario/value.h"

namespace gaitlab {
namespace {

std::string list_text(std::span<const double> values) {
  std::string out;
  for (const double value : values) out += (out.empty() ? "" : ", ") + number_text(value);
  return "[" + out + "]";
}

std::string alternatives(std::span<const char* const> names) {
  std::string out;
  for (const char* name : names) out += (out.empty() ? "" : " | ") + std::string(name);
  return out;
}

std::string range_without_unit(Spec spec) {
  spec.unit = "";
  return range_text(spec);
}

std::string name_at(std::span<const char* const> names, int index) {
  return index >= 0 && static_cast<std::size_t>(index) < names.size() ? names[static_cast<std::size_t>(index)] : "";
}

}  // namespace

std::string table(const std::vector<KeyRow>& rows) {
  std::vector<std::array<std::string, 5>> cells{{"key", "unit", "default", "range", "meaning"}};
  for (const KeyRow& row : rows) cells.push_back({row.key, row.unit, row.preset, row.range, row.about});
  std::array<std::size_t, 4> width{};
  for (const auto& line : cells) {
    for (std::size_t i = 0; i < width.size(); ++i) width[i] = std::max(width[i], line[i].size());
  }
  std::string out;
  for (const auto& line : cells) {
    std::string text;
    for (std::size_t i = 0; i < width.size(); ++i) text += line[i] + std::string(width[i] - line[i].size() + 2, ' ');
    text += line[4];
    out += text.substr(0, text.find_last_not_of(' ') + 1) + "\n";
  }
  return out;
}

std::string markdown_table(const std::vector<KeyRow>& rows) {
  const auto code = [](const std::string& text) {
    std::string out;
    for (const char c : text) out += c == '|' ? std::string("\\|") : std::string(1, c);
    return out.empty() ? out : "`" + out + "`";
  };
  const auto plain = [](const std::string& text) {
    std::string out;
    bool in_code = false;
    for (const char c : text) {
      in_code = in_code != (c == '`');
      if (std::string(in_code ? "|" : "|<>*_").find(c) != std::string::npos) out += '\\';
      out += c;
    }
    return out;
  };
  std::string out = "| key | unit | default | range | meaning |\n|---|---|---|---|---|\n";
  for (const KeyRow& row : rows) {
    // Spaces at the left show depth, which a table of Markdown would swallow.
    const std::size_t depth = std::min(row.key.find_first_not_of(' '), row.key.size());
    std::string key;
    for (std::size_t i = 0; i < depth; ++i) key += "&nbsp;";
    out += "| " + key + code(row.key.substr(depth)) + " | " + plain(row.unit) + " | " + code(row.preset) + " | " +
           plain(row.range) + " | " + plain(row.about) + " |\n";
  }
  return out;
}

void Explainer::row(const std::string& key, const std::string& unit, const std::string& preset, const std::string& range,
                    const std::string& about) {
  rows_.push_back({prefix_ + key, unit, preset, range, about});
  if (depth_ == 0) keys_.push_back(key);
}

void Explainer::number(const char* key, double& value, Spec spec) {
  row(key, spec.unit, number_text(value), range_without_unit(spec), spec.about);
}

void Explainer::number_or(const char* key, double& value, const char* word, Spec spec) {
  row(key, spec.unit, value > 0 ? number_text(value) : word, word + (" | " + range_without_unit(spec)), spec.about);
}

void Explainer::integer(const char* key, std::int64_t& value, Spec spec) {
  row(key, spec.unit, std::to_string(value), range_without_unit(spec), spec.about);
}

void Explainer::flag(const char* key, bool& value, const char* about) {
  row(key, "", value ? "true" : "false", "true | false", about);
}

void Explainer::text(const char* key, std::string& value, const char* about) { row(key, "", value, "text", about); }

void Explainer::file(const char* key, std::string&, const char* about) { row(key, "", "", "file, or its text", about); }

void Explainer::choice(const char* key, int& value, std::span<const char* const> names, const char* about) {
  row(key, "", name_at(names, value), alternatives(names), about);
}

void Explainer::per_joint(const char* key, PerJoint& value, Spec spec) {
  const std::string range = range_without_unit(spec);
  row(key, spec.unit, value.each.empty() ? number_text(value.common) : list_text(value.each),
      range.empty() ? "per joint" : range + ", per joint", spec.about);
}

void Explainer::joint(const char* key, std::int64_t& value, const char* about) {
  row(key, "", value < 0 ? "" : std::to_string(value), "joint name or number", about);
}

void Explainer::vector(const char* key, std::span<double> value, Spec spec) {
  const std::string range = range_without_unit(spec);
  row(key, spec.unit, list_text(value), std::to_string(value.size()) + " numbers" + (range.empty() ? "" : ", ") + range,
      spec.about);
}

void Explainer::numbers(const char* key, std::vector<double>& value, Spec spec) {
  const std::string range = range_without_unit(spec);
  row(key, spec.unit, list_text(value), "list of numbers" + std::string(range.empty() ? "" : ", ") + range, spec.about);
}

void Explainer::rows(const char* key, std::vector<std::vector<double>>&, Spec spec) {
  const std::string range = range_without_unit(spec);
  row(key, spec.unit, "", "list of rows of numbers" + std::string(range.empty() ? "" : ", ") + range, spec.about);
}

void Explainer::texts(const char* key, std::vector<std::string>& value, const char* about) {
  std::string preset;
  for (const std::string& text : value) preset += (preset.empty() ? "" : ", ") + text;
  row(key, "", "[" + preset + "]", "list of texts", about);
}

void Explainer::named(const char* key, std::vector<Named>& values, NamedValues kind, const char* about) {
  std::string names;
  for (const Named& value : values) names += (names.empty() ? "" : ", ") + value.name;
  row(key, "", names.empty() ? "{}" : names, kind == NamedValues::texts ? "NAME: text" : "NAME: text | number, per joint",
      about);
}

void Explainer::elements(const char* key, const List& list) {
  const std::size_t size = list.size(list.self);
  if (size == 0) list.resize(list.self, 1);  // an element with its defaults, to look at
  const std::string before = prefix_;
  prefix_ += std::string(key) + "[].";
  ++depth_;
  list.visit(list.self, 0, *this);
  --depth_;
  prefix_ = before;
  if (size == 0) list.resize(list.self, 0);
}

void Explainer::list(const char* key, const char* about, List list) {
  row(key, "", list.size(list.self) == 0 ? "[]" : "", "list", about);
  elements(key, list);
}

void Explainer::rule_or_list(const char* key, int& rule, std::span<const char* const> names, const char* about, List list) {
  row(key, "", name_at(names, rule), alternatives(names) + " | list", about);
  elements(key, list);
}

void Explainer::group(const char* key, const char* about, Group group) {
  row(std::string(key) + ":", "", "", "", about);
  if (depth_ == 0) keys_.back() = key;
  const std::string before = prefix_;
  prefix_ += "  ";
  ++depth_;
  group.visit(group.self, *this);
  --depth_;
  prefix_ = before;
}

}  // namespace gaitlab
