// The values of a Reader that name joints: a value per joint, and a joint itself.
#include <fmt/format.h>

#include <algorithm>

#include "core/scenario/reader.h"
#include "core/scenario/value.h"
#include "core/scenario/wording.h"

namespace gaitlab {

void Reader::on(const char* key, const field::EachJoint& field) {
  const Node* node = take(key);
  if (node == nullptr) return;
  if (node->kind == Node::Kind::list) {
    read_joint_list(*node, key, field.spec, field.value);
  } else if (node->kind == Node::Kind::map) {
    read_joint_map(*node, key, field.spec, field.value);
  } else if (node->kind == Node::Kind::scalar) {
    if (read_one(*node, key, field.spec, field.value.common)) field.value.each.clear();
  } else {
    problems_.add(node->place, fmt::format("{} is {}; expected a number{}, a list, or a map of joints", key, found(*node),
                                           in_unit(field.spec)));
  }
}

void Reader::read_joint_list(const Node& node, const std::string& key, const Spec& spec, PerJoint& value) {
  if (joints_ != nullptr && node.items.size() != joints_->size()) {
    problems_.add(node.place, fmt::format("{} has {}; expected one for each of the robot's {}", key,
                                          counted(node.items.size(), "number"), counted(joints_->size(), "joint")));
    return;
  }
  std::vector<double> each(node.items.size());
  read_each(node, key, spec, each);
  value.each = std::move(each);
}

void Reader::read_joint_map(const Node& node, const std::string& key, const Spec& spec, PerJoint& value) {
  PerJoint read = value;
  const Node* common = node.find("default");
  if (common != nullptr && read_one(*common, key + ".default", spec, read.common)) read.each.clear();
  if (node.keys.size() > (common != nullptr ? 1U : 0U) && read.each.empty() && joints_ != nullptr) {
    read.each.assign(joints_->size(), read.common);
  }
  for (std::size_t i = 0; i < node.keys.size(); ++i) {
    const auto& [name, place] = node.keys[i];
    if (name == "default") continue;
    double number = 0;
    const bool good = read_one(node.items[i], fmt::format("{} of {}", key, in_quotes(name)), spec, number);
    const std::int64_t joint = joint_number(name, place);
    if (good && joint >= 0) read.each[static_cast<std::size_t>(joint)] = number;
  }
  value = std::move(read);
}

std::int64_t Reader::joint_number(const std::string& name, const SourceLocation& place) {
  if (joints_ == nullptr) return -1;
  const auto it = std::find(joints_->begin(), joints_->end(), name);
  if (it != joints_->end()) return it - joints_->begin();
  problems_.add(place, "no joint " + in_quotes(name) + offer(name, *joints_, "joints"));
  return -1;
}

void Reader::on(const char* key, const field::Joint& field) {
  const Node* node = take(key);
  if (node == nullptr) {
    // A plugin's default joint may be one that this robot has not; -1 means none.
    const bool beyond = joints_ != nullptr && field.value >= 0 && static_cast<std::size_t>(field.value) >= joints_->size();
    if (beyond && !tolerant_) problems_.add(map_->place, "missing key " + in_quotes(key));
    return;
  }
  if (node->kind != Node::Kind::scalar) {
    problems_.add(node->place, fmt::format("{} is {}; expected a joint's name or number", key, found(*node)));
    return;
  }
  const Reading<std::int64_t> number = read_integer(*node);
  if (!number.ok()) {
    const std::int64_t named = joint_number(node->text, node->place);
    if (named >= 0) field.value = named;
  } else if (joints_ == nullptr || (number.value >= 0 && static_cast<std::size_t>(number.value) < joints_->size())) {
    field.value = number.value;
  } else {
    problems_.add(node->place, fmt::format("{} is {}; the robot has {}, numbered from 0", key, number.value,
                                           counted(joints_->size(), "joint")));
  }
}

}  // namespace gaitlab
