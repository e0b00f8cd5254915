// The values of a Reader that sensors have: names of parts of the robot, words, and times of whole control periods.
#include <fmt/format.h>

#include <algorithm>

#include "core/settings/joint_patterns.h"
#include "core/settings/reader.h"
#include "core/settings/value.h"
#include "core/settings/wording.h"

namespace gaitlab {

void Reader::on(const char* key, const field::Names& field) {
  const Node* node = take(key);
  if (node == nullptr) {
    if (field.one && field.value.empty() && !tolerant_) missing(key);
    return;
  }
  const bool list = node->kind == Node::Kind::list && !field.one;
  if (!list && node->kind != Node::Kind::scalar) {
    problems_.add(node->place, fmt::format("{} is {}; expected a {}{}", key, found(*node), noun(field.among),
                                           field.one ? "" : ", or a list of them"));
    return;
  }
  field.value.clear();
  for (const Node& item : list ? std::span<const Node>(node->items) : std::span<const Node>(node, 1)) {
    read_name(item, key, field);
  }
}

void Reader::read_name(const Node& item, const char* key, const field::Names& field) {
  const Reading<std::string> reading = read_scalar(item);
  if (!reading.ok()) {
    problems_.add(item.place, std::string(key) + " " + reading.wrong);
    return;
  }
  const std::vector<std::string> words = to_strings(field.words);
  if (field.among == Among::words && std::ranges::find(words, reading.value) == words.end()) {
    problems_.add(item.place,
                  fmt::format("{} {} is unknown{}", key, in_quotes(reading.value), offer(reading.value, words, "names")));
  } else {
    const bool of_joints = !field.one && (field.among == Among::joints || field.among == Among::motors);
    const JointGroup* group = of_joints ? group_named(reading.value, *groups_) : nullptr;
    if (group != nullptr) {
      field.value.insert(field.value.end(), group->joints.begin(), group->joints.end());
    } else if (of_joints && joints_ != nullptr && reading.value.starts_with(kLegGroup)) {  // a pattern of groups
      const std::vector<std::string> meant = joints_meant({reading.value}, *joints_, *groups_);
      field.value.insert(field.value.end(), meant.begin(), meant.end());
    } else {
      field.value.push_back(reading.value);
    }
  }
}

void Reader::on(const char* key, const field::Periods& field) {
  const Node* node = take(key);
  if (node == nullptr) return;
  if (node->kind != Node::Kind::list || field.most == nullptr) {
    if (read_one(*node, key, field.spec, field.value) && field.most != nullptr) *field.most = field.value;
    return;
  }
  if (node->items.size() != 2) {
    problems_.add(node->place,
                  fmt::format("{} has {}; expected one, or a range [a, b]", key, counted(node->items.size(), "number")));
    return;
  }
  double range[2] = {0, 0};
  const std::size_t before = problems_.size();
  read_each(*node, key, field.spec, range);
  if (problems_.size() > before) return;
  if (range[0] > range[1]) {
    problems_.add(node->place, fmt::format("{} is [{}, {}]; expected the smaller number first", key, number_text(range[0]),
                                           number_text(range[1])));
    return;
  }
  field.value = range[0];
  *field.most = range[1];
}

}  // namespace gaitlab
