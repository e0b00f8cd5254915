// The values of a Reader that are lists: numbers, texts and structs.
#include <fmt/format.h>

#include "core/settings/reader.h"
#include "core/settings/value.h"
#include "core/settings/wording.h"

namespace gaitlab {
namespace {

std::string element(const std::string& key, std::size_t index) { return fmt::format("{}[{}]", key, index); }

}  // namespace

const Node* Reader::take_list(const char* key, const char* expected) {
  const Node* node = take(key);
  if (node == nullptr || node->kind == Node::Kind::list) return node;
  problems_.add(node->place, fmt::format("{} is {}; expected {}{}", key, found(*node), expected, or_word_));
  return nullptr;
}

void Reader::read_each(const Node& node, const std::string& key, const Spec& spec, std::span<double> value) {
  for (std::size_t i = 0; i < value.size(); ++i) read_one(node.items[i], element(key, i), spec, value[i]);
}

void Reader::on(const char* key, const field::Vector& field) {
  const std::string expected = "a list of " + counted(field.value.size(), "number") + in_unit(field.spec);
  if (const Node* map = map_->find(key); map != nullptr && map->kind == Node::Kind::map && or_word_.empty()) {
    static_cast<void>(take(key));
    return read_entries(*map, key, field, expected);
  }
  const Node* node = take_list(key, expected.c_str());
  if (node == nullptr) return;
  if (node->items.size() == field.value.size()) {
    read_each(*node, key, field.spec, field.value);
  } else {
    problems_.add(node->place, fmt::format("{} has {}; expected {}", key, counted(node->items.size(), "number"), expected));
  }
}

void Reader::read_entries(const Node& map, const std::string& key, const field::Vector& field, const std::string& expected) {
  for (std::size_t i = 0; i < map.keys.size(); ++i) {
    const auto& [name, place] = map.keys[i];
    std::size_t at = 0;
    while (at < field.value.size() && name != std::to_string(at)) ++at;
    if (at == field.value.size()) {
      problems_.add(place,
                    fmt::format("{} is {}; {} is not an element (they are numbered from 0)", key, expected, in_quotes(name)));
    } else {
      read_one(map.items[i], element(key, at), field.spec, field.value[at]);
    }
  }
}

void Reader::on(const char* key, const field::Numbers& field) {
  const Node* node = take_list(key, ("a list of numbers" + in_unit(field.spec)).c_str());
  if (node == nullptr) return;
  std::vector<double> read(node->items.size());
  read_each(*node, key, field.spec, read);
  field.value = std::move(read);
}

void Reader::on(const char* key, const field::Texts& field) {
  const Node* node = take_list(key, "a list of texts");
  if (node == nullptr) return;
  std::vector<std::string> read;
  for (std::size_t i = 0; i < node->items.size(); ++i) {
    Reading<std::string> reading = read_scalar(node->items[i]);
    if (!reading.ok()) problems_.add(node->items[i].place, element(key, i) + " " + reading.wrong);
    read.push_back(std::move(reading.value));
  }
  field.value = std::move(read);
}

void Reader::on(const char* key, const field::List& field) {
  const Node* node = field.name == nullptr ? take_list(key, "a list of maps") : take(key);
  if (node == nullptr) return;
  const bool map = node->kind == Node::Kind::map, some = need_ == Need::required;
  if (field.name == nullptr || (map && !(some && node->items.empty()))) {
    read_elements(key, *node, field);
  } else {
    problems_.add(node->place, fmt::format("{} is {}; expected a map {}NAME: {}", key, map ? "an empty map" : found(*node),
                                           some ? "with at least one " : "", field.example));
  }
}

void Reader::read_elements(const char* key, const Node& node, const field::List& list) {
  list.resize(list.self, 0);  // so that no element keeps a value of the default or of an earlier file
  list.resize(list.self, node.items.size());
  for (std::size_t i = 0; i < node.items.size(); ++i) {
    const std::size_t before = problems_.size();
    if (list.name != nullptr) list.name(list.self, i) = node.keys[i].first;
    Reader reader(node.items[i], list.name != nullptr ? in_quotes(node.keys[i].first) : element(key, i), problems_, joints_,
                  folder_);
    reader.modules(modules_);
    reader.groups(*groups_);
    list.visit(list.self, i, reader);
    reader.finish();
    if (problems_.size() > before) faulty_.push_back(&node.items[i]);
  }
}

}  // namespace gaitlab
