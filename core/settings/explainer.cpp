#include "core/settings/explainer.h"

#include <algorithm>

#include "core/settings/wording.h"

namespace gaitlab {
namespace {

constexpr const char* kColumn = "column | {column, scale}";

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

std::string if_among(std::span<const char* const> names, const std::string& name) {
  return std::find(names.begin(), names.end(), name) != names.end() ? name : "";
}

}  // namespace

std::string table(const std::vector<KeyRow>& rows) {
  std::string out;
  for (const KeyRow& row : rows) {
    const std::size_t depth = row.key.find_first_not_of(' ') / 2 * 4;  // depth of the group, as a number of blanks
    std::string head = row.key.substr(row.key.find_first_not_of(' '));
    if (!row.unit.empty()) head += " (" + row.unit + ")";
    std::string limits = row.preset.empty() ? "" : "default " + row.preset;
    if (!row.range.empty()) limits += (limits.empty() ? "" : "; ") + row.range;
    out += wrapped(limits.empty() ? head : head + ": " + limits, depth);
    out += wrapped(row.about, depth + 4);
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
    // Spaces at the left state the depth, but a table in Markdown would drop them.
    const std::size_t depth = std::min(row.key.find_first_not_of(' '), row.key.size());
    std::string key;
    for (std::size_t i = 0; i < depth; ++i) key += "&nbsp;";
    out += "| " + key + code(row.key.substr(depth)) + " | " + plain(row.unit) + " | " + code(row.preset) + " | " +
           plain(row.range) + " | " + plain(row.about) + " |\n";
  }
  return out;
}

void Explainer::row(const std::string& key, const std::string& unit, const std::string& preset, const std::string& range,
                    const std::string& about, std::vector<std::string> words) {
  KeyRow& made =
      rows_.emplace_back(KeyRow{prefix_ + key, unit, need_ == Need::preset ? preset : "", range, about, std::move(words)});
  if (word_ != nullptr) made.range += std::string(" | ") + made.words.emplace_back(word_);
  if (need_ == Need::required) made.range = "required; " + made.range;
  need_ = Need::preset;
  word_ = nullptr;
  if (depth_ == 0) keys_.push_back(key);
}

void Explainer::visit(const Field& field) {
  need_ = field.need;
  word_ = field.word;
  std::visit([&](const auto& value) { on(field.key, field.about, value); }, field.value);
}

void Explainer::on(const char* key, const char* about, const field::Number& field) {
  row(key, field.spec.unit, number_text(field.value), range_without_unit(field.spec), about);
}

void Explainer::on(const char* key, const char* about, const field::NumberOr& field) {
  row(key, field.spec.unit, field.value > 0 ? number_text(field.value) : field.word,
      field.word + (" | " + range_without_unit(field.spec)), about, {field.word});
}

void Explainer::on(const char* key, const char* about, const field::Integer& field) {
  row(key, field.spec.unit, std::to_string(field.value), range_without_unit(field.spec), about);
}

void Explainer::on(const char* key, const char* about, const field::Flag& field) {
  row(key, "", field.value ? "true" : "false", "true | false", about, {"true", "false"});
}

void Explainer::on(const char* key, const char* about, const field::Text& field) { row(key, "", field.value, "text", about); }

void Explainer::on(const char* key, const char* about, const field::File&) { row(key, "", "", "file, or its text", about); }

void Explainer::on(const char* key, const char* about, const field::OneOf& field) {
  row(key, "", if_among(field.names, field.value), alternatives(field.names), about, {field.names.begin(), field.names.end()});
}

void Explainer::on(const char* key, const char* about, const field::EachJoint& field) {
  const std::string range = range_without_unit(field.spec);
  const std::string preset = field.value.each.empty() ? number_text(field.value.common) : list_text(field.value.each);
  const bool absent = field.value == PerJoint();
  row(key, field.spec.unit,
      not_stated(field)                               ? "see text"
      : absent && field.role == field::Role::rating   ? "not stated"
      : absent && field.role == field::Role::required ? ""
                                                      : preset,
      (range.empty() ? "" : range + ", ") + (field.of_modules ? "per module" : "per joint"), about);
}

void Explainer::on(const char* key, const char* about, const field::Joint& field) {
  row(key, "", field.value < 0 ? "" : std::to_string(field.value), "joint name or number", about);
}

void Explainer::on(const char* key, const char* about, const field::Vector& field) {
  const std::string range = range_without_unit(field.spec);
  row(key, field.spec.unit, list_text(field.value),
      std::to_string(field.value.size()) + " numbers" + (range.empty() ? "" : ", ") + range, about);
}

void Explainer::on(const char* key, const char* about, const field::Numbers& field) {
  const std::string range = range_without_unit(field.spec);
  const std::string form = field.whole ? "list of integers" : "list of numbers";
  row(key, field.spec.unit, list_text(field.value), form + (range.empty() ? "" : ", ") + range, about);
}

void Explainer::on(const char* key, const char* about, const field::Rows& field) {
  const std::string range = range_without_unit(field.spec);
  row(key, field.spec.unit, "", "list of rows of numbers" + std::string(range.empty() ? "" : ", ") + range, about);
}

void Explainer::on(const char* key, const char* about, const field::Texts& field) {
  std::string preset;
  for (const std::string& text : field.value) preset += (preset.empty() ? "" : ", ") + text;
  row(key, "", "[" + preset + "]", "list of texts", about);
}

void Explainer::on(const char* key, const char* about, const field::Names& field) {
  std::string preset;
  for (const std::string& text : field.value) preset += (preset.empty() ? "" : ", ") + text;
  const bool words = field.among == Among::words;
  const std::string name = words ? alternatives(field.words) : noun(field.among);
  row(key, "",
      field.one                 ? ""
      : field.value.size() == 1 ? preset
                                : "[" + preset + "]",
      field.one ? name : name + (words ? " | list" : " | pattern | list"), about,
      words ? std::vector<std::string>(field.words.begin(), field.words.end()) : std::vector<std::string>());
}

void Explainer::on(const char* key, const char* about, const field::Periods& field) {
  row(key, field.spec.unit, number_text(field.value),
      range_without_unit(field.spec) + (field.most == nullptr ? "" : " | [a, b]"), about);
}

void Explainer::on(const char* key, const char* about, const field::Map& field) {
  std::string names;
  for (const Named& value : field.value) names += (names.empty() ? "" : ", ") + value.name;
  row(key, "", names.empty() ? "{}" : names, field.kind == NamedValues::texts ? "NAME: text" : "NAME: text | number, per joint",
      about);
}

void Explainer::on(const char* key, const char* about, const field::Column&) { row(key, "", "", kColumn, about); }

void Explainer::on(const char* key, const char* about, const field::Columns& field) {
  row(key + std::string(".JOINT"), "", field.value.empty() ? "{}" : "", kColumn, about);
}

void Explainer::elements(const char* key, const field::List& list) {
  const std::size_t size = list.size(list.self);
  if (size == 0) list.resize(list.self, 1);  // one element with its defaults, for the list of keys
  const std::string before = prefix_;
  prefix_ += nested_ ? "  " : key + std::string(list.name == nullptr ? "[]." : ".NAME.");
  ++depth_;
  list.visit(list.self, 0, *this);
  --depth_;
  prefix_ = before;
  if (size == 0) list.resize(list.self, 0);
}

void Explainer::on(const char* key, const char* about, const field::List& field) {
  // The keys of two lists with the same structs are listed once, below the second list.
  if (nested_ && structs_ == field.visit && end_ == rows_.size()) rows_.resize(first_);
  const char* const mark = field.name != nullptr ? ".NAME" : nested_ ? "[]" : "";
  row(key + std::string(mark), "", field.size(field.self) == 0 ? "[]" : "", field.name != nullptr ? "map by name" : "list",
      about);
  const std::size_t first = rows_.size();
  elements(key, field);
  structs_ = field.visit;
  first_ = first;
  end_ = rows_.size();
}

void Explainer::on(const char* key, const char* about, const field::RuleOrList& field) {
  row(key, "", field.rule, alternatives(field.names) + " | list", about, {field.names.begin(), field.names.end()});
  elements(key, field.list);
}

void Explainer::on(const char* key, const char* about, const field::Group& field) {
  const bool in_list = prefix_.ends_with('.');
  row(std::string(key) + (in_list || nested_ ? "" : ":"), "", "", nested_ ? "map" : "", about);
  if (depth_ == 0) keys_.back() = key;
  const std::string before = prefix_;
  prefix_ += in_list ? std::string(key) + "." : "  ";
  ++depth_;
  field.visit(field.self, *this);
  --depth_;
  prefix_ = before;
}

void Explainer::on(const char* key, const char* about, const field::Other& field) {
  row(key, "", field.preset, field.form, about);
}

}  // namespace gaitlab
