#include "core/robot_files/key_reader.h"

#include <fmt/format.h>

#include "core/settings/wording.h"

namespace gaitlab {

KeyReader::KeyReader(const Node& node, const ModuleMap& map, const std::string& name, std::int64_t format, Problems& problems)
    : map_(map), format_(format), problems_(problems), reader_(node, name, problems, nullptr) {
  for (const ModuleKey& key : map.keys) {
    const Node* value = reader_.take(key.key);
    if (value != nullptr && newer(key)) need_format(key.format, in_quotes(key.key) + " is a key", value->place);
  }
  for (const ModuleKey& key : map.keys) {
    if (key.required) require(key.key);
  }
  std::string source;
  text("source", source);
}

const Node* KeyReader::take(const char* key) { return newer(map_.at(key)) ? nullptr : reader_.take(key); }

void KeyReader::text(const char* key, std::string& value) {
  if (has(key)) reader_.text(key, value, map_.at(key).spec.about);
}

void KeyReader::number(const char* key, double& value) {
  if (has(key)) reader_.number(key, value, map_.at(key).spec);
}

void KeyReader::integer(const char* key, std::int64_t& value) {
  if (has(key)) reader_.integer(key, value, map_.at(key).spec);
}

void KeyReader::flag(const char* key, bool& value) {
  if (has(key)) reader_.flag(key, value, map_.at(key).spec.about);
}

void KeyReader::vector(const char* key, std::span<double> value) {
  if (has(key)) reader_.vector(key, value.first(map_.at(key).size), map_.at(key).spec);
}

void KeyReader::numbers(const char* key, std::vector<double>& value) {
  if (has(key)) reader_.numbers(key, value, map_.at(key).spec);
}

bool KeyReader::word(const char* key, const char* word) {
  const Node* node = take(key);
  if (node == nullptr || node->kind != Node::Kind::scalar || node->text != word) return false;
  for (const ModuleWord& one : map_.at(key).words) {
    if (node->text == one.word && one.format > format_)
      need_format(one.format, fmt::format("{}: {} is", key, word), node->place);
  }
  return true;
}

std::vector<const char*> KeyReader::known_words(const char* key) {
  std::vector<const char*> known;
  for (const ModuleWord& one : map_.at(key).words) {
    if (one.format <= std::max<std::int64_t>(format_, 1)) {
      known.push_back(one.word);
    } else if (word(key, one.word)) {
      return {};
    }
  }
  return known;
}

Pose KeyReader::frame() {
  Vec3 origin = Vec3::Zero(), turn = Vec3::Zero();
  vector("origin", span_of(origin));
  vector("rpy", span_of(turn));
  return {rpy(turn), origin};
}

void KeyReader::need_format(std::int64_t format, const std::string& what, const SourceLocation& place) {
  if (format_ == 0) return;
  problems_.add(place, fmt::format("{} of module format {}, but this file has format {}; write gaitlab_module: {}", what,
                                   format, format_, format));
}

}  // namespace gaitlab
