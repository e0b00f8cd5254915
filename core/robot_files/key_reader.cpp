#include "core/robot_files/key_reader.h"

namespace gaitlab {

KeyReader::KeyReader(const Node& node, const ModuleMap& map, const std::string& name, Problems& problems)
    : map_(map), reader_(node, name, problems, nullptr) {
  for (const ModuleKey& key : map.keys) reader_.take(key.key);
  for (const ModuleKey& key : map.keys) {
    if (key.required) require(key.key);
  }
  std::string source;
  text("source", source);
}

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
  return node != nullptr && node->kind == Node::Kind::scalar && node->text == word;
}

Pose KeyReader::frame() {
  Vec3 origin = Vec3::Zero(), turn = Vec3::Zero();
  vector("origin", span_of(origin));
  vector("rpy", span_of(turn));
  return {rpy(turn), origin};
}

}  // namespace gaitlab
