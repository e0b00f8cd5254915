#include "core/settings/reader.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <set>

#include "core/settings/node_places.h"
#include "core/settings/offers.h"
#include "core/settings/text_file.h"
#include "core/settings/value.h"
#include "core/settings/wording.h"

namespace gaitlab {
namespace {

/// Key in the form of --set, such as docs.0.1 for `docs[0][1]`.
std::string dotted(const std::string& key) {
  std::string text;
  for (const char c : key) {
    if (c != ']') text += c == '[' ? '.' : c;
  }
  return clipped(text);
}

/// True if other keys of the map depend on this key, in the map of a plugin, ground or panel.
bool decides(std::string_view key) { return key == "type" || key == "kind"; }

Node empty_map(const SourceLocation& place) { return {Node::Kind::map, place}; }

}  // namespace

Reader::Reader(const Node& node, const std::string& name, Problems& problems, JointNames joints, std::string folder)
    : empty_(empty_map(node.place)),
      map_(node.kind == Node::Kind::map ? &node : &empty_),
      problems_(problems),
      joints_(joints),
      folder_(std::move(folder)),
      tolerant_(node.kind != Node::Kind::map) {
  if (tolerant_) problems_.add(node.place, fmt::format("{} is {}; expected a map", name, found(node)));
}

Reader::Reader(const SourceLocation& place, Problems& problems, JointNames joints, std::string folder)
    : empty_(empty_map(place)), map_(&empty_), problems_(problems), joints_(joints), folder_(std::move(folder)) {}

const Node* Reader::take(const char* key) {
  if (std::find(known_.begin(), known_.end(), key) == known_.end()) known_.emplace_back(key);
  return map_->find(key);
}

bool Reader::version(const char* key) {
  const Node* node = take(key);
  if (node == nullptr) return true;
  const Reading<std::int64_t> reading = read_integer(*node);
  if (reading.ok() && reading.value == 1) return true;
  problems_.add(node->place, fmt::format("{} is {}; expected 1, the only format version", key, found(*node)));
  return false;
}

bool Reader::misspelt(const char* key) const {
  const auto meant = [&](const auto& one) { return !nearest(one.first, std::vector<std::string>{key}).empty(); };
  return !has(key) && std::ranges::any_of(map_->keys, meant);
}

void Reader::require(std::initializer_list<const char*> keys) {
  if (tolerant_) return;
  for (const char* key : keys) {
    if (!has(key)) missing(key);
  }
}

void Reader::missing(const char* key) {
  missing_.emplace_back(key, problems_.size());
  problems_.add(map_->place, "missing key " + in_quotes(key));
}

void Reader::finish() {
  if (tolerant_) return;
  const std::set<std::string> known(known_.begin(), known_.end());
  for (std::size_t i = 0; i < map_->keys.size(); ++i) {
    const auto& [key, place] = map_->keys[i];
    if (known.count(key) > 0) continue;
    const std::size_t colon = key.find(':');
    // In YAML, {a:1} is a key without a value. The user probably meant a: 1.
    if (map_->items[i].kind == Node::Kind::null && colon != std::string::npos) {
      problems_.add(place, "unknown key " + in_quotes(key) + "; put a space after the colon").unknown_key = key;
    } else if (const std::string comma = decimal_comma(*map_, i); !comma.empty()) {
      problems_.add(place, comma);
    } else {
      unknown(key, map_->items[i], place);
    }
  }
}

void Reader::unknown(const std::string& key, const Node& value, const SourceLocation& place) {
  const bool of_a_list = key.find('[') != std::string::npos;
  const std::string remedy = of_a_list                        ? "; an item of a list is addressed by its number: " + dotted(key)
                             : problems_.size() < kMostOffers ? meant(key, value)
                                                              : "";
  const Problem problem{place, "unknown key " + in_quotes(key) + remedy, {}, key};
  const std::string near = missing_.empty() ? "" : nearest(key, known_);
  const auto misspelt = std::ranges::find(missing_, near, [](const auto& one) { return one.first; });
  if (misspelt == missing_.end() || of_a_list) {
    problems_.add(problem);
  } else {
    problems_.replace(misspelt->second, problem);
    missing_.erase(misspelt);
  }
}

std::string Reader::meant(const std::string& key, const Node& value) const {
  const bool searched = elsewhere_ != nullptr && *elsewhere_;
  for (const auto& [inner, place] : value.keys) {  // a key of this map within another map: tolerances.actuator.R
    if (searched && !section_.empty() && std::ranges::find(known_, inner) != known_.end())
      return fmt::format("; did you mean {}.{}?", section_, clipped(inner));
  }
  const std::string found = searched ? (*elsewhere_)({section_, key, nearest(key, known_)}) : "";
  return found.empty() ? offer(key, known_, "keys") : found;
}

bool Reader::read_one(const Node& node, const std::string& what, const Spec& spec, double& value) {
  const Reading<double> reading = read_number(node, spec.unit);
  if (!reading.ok()) {
    problems_.add(node.place, what + " " + reading.wrong);
    return false;
  }
  if (reading.value < spec.min || reading.value > spec.max) {
    problems_.add(node.place, fmt::format("{} is {}; expected {}{}", what, with_unit(reading.value, spec.unit),
                                          range_text(spec), in_degrees(reading.value, spec.unit)));
    return false;
  }
  value = reading.value;
  return true;
}

void Reader::on(const char* key, const field::Number& field) {
  if (const Node* node = take(key)) read_one(*node, key, field.spec, field.value);
}

void Reader::on(const char* key, const field::NumberOr& field) {
  const Node* node = take(key);
  if (node == nullptr) return;
  if (node->kind == Node::Kind::scalar && node->text == field.word) {
    field.value = 0;
    return;
  }
  const Reading<double> reading = read_number(*node, field.spec.unit);
  if (!reading.ok()) {
    problems_.add(node->place, fmt::format("{} {}, or {}", key, reading.wrong, field.word));
  } else {
    read_one(*node, key, field.spec, field.value);
  }
}

void Reader::on(const char* key, const field::Integer& field) {
  const Node* node = take(key);
  if (node == nullptr) return;
  const Reading<std::int64_t> reading = read_integer(*node);
  const auto number = static_cast<double>(reading.value);
  if (!reading.ok()) {
    problems_.add(node->place, std::string(key) + " " + reading.wrong);
  } else if (number < field.spec.min || number > field.spec.max) {
    problems_.add(node->place, fmt::format("{} is {}; expected {}", key, reading.value, range_text(field.spec)));
  } else {
    field.value = reading.value;
  }
}

void Reader::on(const char* key, const field::Flag& field) {
  const Node* node = take(key);
  if (node == nullptr) return;
  const Reading<bool> reading = read_flag(*node);
  if (reading.ok()) {
    field.value = reading.value;
  } else {
    problems_.add(node->place, std::string(key) + " " + reading.wrong);
  }
}

void Reader::on(const char* key, const field::Text& field) {
  const Node* node = take(key);
  if (node == nullptr) return;
  Reading<std::string> reading = read_scalar(*node);
  if (reading.ok()) {
    field.value = std::move(reading.value);
  } else {
    problems_.add(node->place, std::string(key) + " " + reading.wrong);
  }
}

void Reader::on(const char* key, const field::File& field) {
  const Node* node = take(key);
  if (node == nullptr) return;
  if (node->kind != Node::Kind::scalar) {
    problems_.add(node->place, fmt::format("{} is {}; expected a file, or its text", key, found(*node)));
  } else if (node->text.find('\n') != std::string::npos) {
    field.value = node->text;
  } else {
    try {
      field.value = read_text((std::filesystem::path(folder_) / node->text).string(), node->place);
    } catch (const InputError& error) {
      for (const Problem& problem : error.problems()) problems_.add(problem.place, problem.text);
    }
  }
}

void Reader::on(const char* key, const field::OneOf& field) {
  const Node* node = take(key);
  if (node == nullptr) return;
  const std::vector<std::string> known = to_strings(field.names);
  const auto it = std::find(known.begin(), known.end(), node->text);
  if (node->kind == Node::Kind::scalar && it != known.end()) {
    field.value = *it;
    return;
  }
  // The other keys of a map depend on its type, so that they cannot be checked without the type.
  tolerant_ = tolerant_ || decides(key);
  if (node->kind == Node::Kind::scalar) {
    problems_.add(node->place,
                  fmt::format("{} {} is unknown{}", key, in_quotes(node->text), offer(node->text, known, "names")));
  } else {
    problems_.add(node->place, fmt::format("{} is {}; expected one of {}", key, found(*node), joined(known)));
  }
}

namespace {

bool opens_a_bracket(const Node& node) {
  return node.kind == Node::Kind::scalar && !node.quoted &&
         std::ranges::count(node.text, '(') > std::ranges::count(node.text, ')');
}

}  // namespace

void Reader::on(const char* key, const field::Map& field) {
  const Node* node = take(key);
  if (node == nullptr) return;
  if (node->kind != Node::Kind::map) {
    problems_.add(node->place, fmt::format("{} is {}; expected a map of names", key, found(*node)));
    return;
  }
  field.value.clear();
  for (std::size_t i = 0; i < node->keys.size(); ++i) {
    const auto& [name, place] = node->keys[i];
    if (node->flow && opens_a_bracket(node->items[i])) {
      problems_.add(
          node->items[i].place,
          fmt::format(
              "{} {} ends within a bracket: in {{ }} a comma ends the text; put the text in quotes, or on a separate line",
              clipped(name), found(node->items[i])));
      field.value.push_back({name, "0"});  // so that later checks find the name
      return;                              // the following keys are fragments of the text
    }
    if (!is_name(name, "_") || name[0] == '_' || (name[0] >= '0' && name[0] <= '9')) {
      problems_.add(place, in_quotes(name) + " is not a name; expected a letter, then letters, digits and `_`");
      continue;
    }
    read_named(node->items[i], fmt::format("{}.{}", key, clipped(name)), field.kind, field.value.emplace_back(Named{name}));
  }
}

void Reader::read_named(const Node& node, const std::string& what, NamedValues kind, Named& value) {
  const bool may_be_number = kind == NamedValues::texts_or_numbers;
  const bool scalar = node.kind == Node::Kind::scalar;
  if (may_be_number && scalar && read_number(node, "").ok()) {
    value.number.common = read_number(node, "").value;
  } else if (scalar && !node.text.empty()) {
    value.text = node.text;
  } else if (may_be_number && (node.kind == Node::Kind::list || node.kind == Node::Kind::map)) {
    read_named_numbers(node, what, value.number);
  } else {
    problems_.add(node.place, fmt::format("{} is {}; expected {}", what, scalar ? "empty" : found(node),
                                          may_be_number ? "a number, a text, a list, or a map of joints" : "a text"));
  }
}

void Reader::read_named_numbers(const Node& node, const std::string& what, PerJoint& value) {
  constexpr Spec kAny{"", -1e300, 1e300, ""};
  if (node.kind == Node::Kind::list) {
    read_joint_list(node, what, kAny, value, joints());
    return;
  }
  const std::size_t before = problems_.size();
  const bool every = read_joint_map(node, what, kAny, value, joints());
  if (every || problems_.size() > before) return;
  // Without a default, the remaining joints would have no value.
  problems_.add(node.place, what + " names only some joints; add default: for the others");
}

void Reader::visit(const Field& field) {
  if (!only_.empty() && std::ranges::find(only_, std::string_view(field.key)) == only_.end()) {
    static_cast<void>(take(field.key));
    return;
  }
  const Node* node = map_->find(field.key);
  if (node == nullptr && field.need == Need::required && !tolerant_) missing(field.key);
  need_ = field.need;
  or_word_ = field.word == nullptr ? "" : std::string(", or ") + field.word;
  if (field.word != nullptr && node != nullptr) {
    *field.is_word = node->kind == Node::Kind::scalar && node->text == field.word;
    if (*field.is_word) return static_cast<void>(take(field.key));
  }
  std::visit([&](const auto& value) { on(field.key, value); }, field.value);
}

void Reader::problem_at(const char* key, std::string_view name, std::size_t offset, std::string_view what) {
  tolerant_ = tolerant_ || decides(key);  // an invalid type makes the set of known keys uncertain
  const Node* node = map_->find(key);
  if (node == nullptr) {
    problems_.add(map_->place, std::string(what));
    return;
  }
  if (name.empty() && offset == std::string_view::npos) {
    problems_.add(node->place, std::string(what));
    return;
  }
  if (name.empty()) {
    add_in(*node, offset, what, problems_);
    return;
  }
  const auto key_of_it = std::find_if(node->keys.begin(), node->keys.end(), [&](const auto& one) { return one.first == name; });
  if (key_of_it == node->keys.end()) {
    problems_.add(node->place, std::string(what));
  } else if (offset == std::string_view::npos) {
    problems_.add(key_of_it->second, std::string(what));
  } else {
    add_in(*node->find(key_of_it->first), offset, what, problems_);
  }
}

void Reader::on(const char* key, const field::RuleOrList& field) {
  const Node* node = take(key);
  if (node == nullptr) return;
  const std::vector<std::string> known = to_strings(field.names);
  const auto it = std::find(known.begin(), known.end(), node->text);
  if (node->kind == Node::Kind::list) {
    field.rule.clear();
    read_elements(key, *node, field.list);
  } else if (node->kind == Node::Kind::scalar && it != known.end()) {
    field.rule = *it;
    field.list.resize(field.list.self, 0);
  } else if (node->kind == Node::Kind::scalar) {
    problems_.add(node->place,
                  fmt::format("{} {} is unknown{}", key, in_quotes(node->text), offer(node->text, known, "names")));
  } else {
    problems_.add(node->place, fmt::format("{} is {}; expected {} or a list", key, found(*node), joined(known)));
  }
}

void Reader::on(const char* key, const field::Group& field) {
  const Node* node = take(key);
  Reader reader =
      node != nullptr ? Reader(*node, key, problems_, joints_, folder_) : Reader(map_->place, problems_, joints_, folder_);
  reader.modules(modules_);
  reader.elsewhere(elsewhere_, section_ + (section_.empty() ? "" : ".") + key);
  reader.groups(*groups_);
  field.visit(field.self, reader);
  reader.finish();
}

}  // namespace gaitlab
