// The values of a Reader that depend on parts of the robot: a value per joint or module, and the name of a joint.
#include <fmt/format.h>

#include <algorithm>

#include "core/settings/joint_patterns.h"
#include "core/settings/reader.h"
#include "core/settings/value.h"
#include "core/settings/wording.h"

namespace gaitlab {

void Reader::on(const char* key, const field::EachJoint& field) {
  const Node* node = take(key);
  const std::size_t before = problems_.size();
  if (node != nullptr) read_each_joint(*node, key, field);
  if (field.role == field::Role::required && problems_.size() == before) require_each(key, node, field.value);
}

void Reader::require_each(const char* key, const Node* node, const PerJoint& value) {
  std::size_t joint = 0;
  while (joint < value.each.size() && value.each[joint] > 0) ++joint;
  if (value.each.empty() ? value.common > 0 : joint == value.each.size()) return;
  if (node == nullptr) {
    missing(key);
  } else if (joints_ != nullptr && joint < joints_->size()) {
    problems_.add(node->place,
                  fmt::format("{} is missing for joint {}; add it, or default:", key, in_quotes((*joints_)[joint])));
  }
}

void Reader::read_each_joint(const Node& node, const char* key, const field::EachJoint& field) {
  if (node.kind == Node::Kind::list) {
    read_joint_list(node, key, field.spec, field.value, parts(field));
  } else if (node.kind == Node::Kind::map) {
    read_joint_map(node, key, field.spec, field.value, parts(field));
  } else if (node.kind == Node::Kind::scalar) {
    if (read_one(node, key, field.spec, field.value.common)) field.value.each.clear();
  } else {
    problems_.add(node.place, fmt::format("{} is {}; expected a number{}, a list, or a map of {}s", key, found(node),
                                          in_unit(field.spec), parts(field).noun));
  }
}

void Reader::read_joint_list(const Node& node, const std::string& key, const Spec& spec, PerJoint& value, Parts of) {
  if (of.names != nullptr && node.items.size() != of.names->size()) {
    problems_.add(node.place, fmt::format("{} has {}; expected one for each of the robot's {}", key,
                                          counted(node.items.size(), "number"), counted(of.names->size(), of.noun)));
    return;
  }
  std::vector<double> each(node.items.size());
  read_each(node, key, spec, each);
  value.each = std::move(each);
}

namespace {

using Key = std::pair<std::string, SourceLocation>;

/// Value that an entry of a map gives to a part.
struct Said {
  const Key* key = nullptr;  ///< null if no entry gives a value
  double number = 0;
};

/// Reports two patterns that give different values to a part. `more` is the number of further parts with this conflict.
void report_clash(const std::string& noun, const std::string& part, std::size_t more, const Said& first, const Key& key,
                  double number, Problems& problems) {
  problems
      .add(key.second,
           fmt::format("{} {} is given {} by {} and {} by {}{}; give it by its name, which beats patterns", noun,
                       in_quotes(part), number_text(first.number), in_quotes(first.key->first), number_text(number),
                       in_quotes(key.first), more == 0 ? "" : fmt::format(" (and so {} more)", counted(more, noun))))
      .notes.emplace_back(first.key->second, in_quotes(first.key->first) + " is here");
}

}  // namespace

bool Reader::read_joint_map(const Node& node, const std::string& key, const Spec& spec, PerJoint& value, Parts of) {
  PerJoint read = value;
  const Node* common = node.find("default");
  if (common != nullptr && read_one(*common, key + ".default", spec, read.common)) read.each.clear();
  if (node.keys.size() > (common != nullptr ? 1U : 0U) && read.each.empty() && of.names != nullptr) {
    read.each.assign(of.names->size(), read.common);
  }
  // The entry of each part, with its name or else with a pattern.
  std::vector<Said> said(of.names == nullptr ? 0 : of.names->size());
  std::vector<std::pair<const Key*, double>> patterns;
  for (std::size_t i = 0; i < node.keys.size(); ++i) {
    const auto& [name, place] = node.keys[i];
    if (name == "default") continue;
    if (const std::string comma = decimal_comma(node, i); !comma.empty()) {
      problems_.add(place, comma);
      continue;
    }
    double number = 0;
    const bool good = read_one(node.items[i], fmt::format("{} of {}", key, in_quotes(name)), spec, number);
    if (means_several(name, of.groups)) {
      if (const std::string wrong = of.names == nullptr ? "" : no_joint(name, *of.names, of.noun, of.groups); !wrong.empty())
        problems_.add(place, wrong);
      if (good) patterns.emplace_back(&node.keys[i], number);
      continue;
    }
    const std::int64_t joint = number_of(name, place, of);
    if (joint >= 0)
      said[static_cast<std::size_t>(joint)] = {&node.keys[i], good ? number : read.each[static_cast<std::size_t>(joint)]};
  }
  for (const auto& [pattern, number] : patterns) {
    std::size_t clashes = 0;
    const std::string* part = nullptr;
    const Said* other = nullptr;
    for (const std::size_t j :
         of.names == nullptr ? std::vector<std::size_t>() : joints_of(pattern->first, *of.names, of.groups)) {
      if (said[j].key == nullptr) said[j] = {pattern, number};
      if (!means_several(said[j].key->first, of.groups) || said[j].number == number || clashes++ > 0) continue;
      part = &(*of.names)[j];
      other = &said[j];
    }
    if (clashes > 0) report_clash(of.noun, *part, clashes - 1, *other, *pattern, number, problems_);
  }
  for (std::size_t j = 0; j < said.size(); ++j) {
    if (said[j].key != nullptr) read.each[j] = said[j].number;
  }
  value = std::move(read);
  return common != nullptr || std::ranges::all_of(said, [](const Said& one) { return one.key != nullptr; });
}

std::int64_t Reader::number_of(const std::string& name, const SourceLocation& place, Parts of) {
  if (of.names == nullptr) return -1;
  const auto it = std::find(of.names->begin(), of.names->end(), name);
  if (it != of.names->end()) return it - of.names->begin();
  problems_.add(place, not_one_joint(name, *of.names, of.noun, of.groups));
  return -1;
}

void Reader::on(const char* key, const field::Joint& field) {
  const Node* node = take(key);
  if (node == nullptr) {
    // The default joint of a plugin may not exist in this robot. A default of -1 means no joint.
    const bool beyond = joints_ != nullptr && field.value >= 0 && static_cast<std::size_t>(field.value) >= joints_->size();
    if (beyond && !tolerant_) missing(key);
    return;
  }
  if (node->kind != Node::Kind::scalar) {
    problems_.add(node->place, fmt::format("{} is {}; expected a joint's name or number", key, found(*node)));
    return;
  }
  if (const std::int64_t joint = read_joint(*node, key); joint >= 0) field.value = joint;
}

std::int64_t Reader::read_joint(const Node& node, const std::string& what) {
  const Reading<std::int64_t> number = read_integer(node);
  if (!number.ok()) return number_of(node.text, node.place, joints());
  if (joints_ == nullptr || (number.value >= 0 && static_cast<std::size_t>(number.value) < joints_->size()))
    return number.value;
  problems_.add(node.place, fmt::format("{} is {}; the robot has {}, numbered from 0", what, number.value,
                                        counted(joints_->size(), "joint")));
  return -1;
}

void Reader::on(const char* key, const field::Column& field) {
  if (const Node* node = take(key)) read_column(*node, key, field.value);
}

void Reader::on(const char* key, const field::Columns& field) {
  const Node* node = take(key);
  if (node == nullptr) return;
  if (node->kind != Node::Kind::map) {
    problems_.add(node->place, fmt::format("{} is {}; expected a map JOINT: COLUMN", key, found(*node)));
    return;
  }
  std::vector<JointColumn> read;
  for (std::size_t i = 0; i < node->keys.size(); ++i) {
    const auto& [name, place] = node->keys[i];
    Node joint{Node::Kind::scalar, place};
    joint.text = name;
    JointColumn one{read_joint(joint, "joint")};
    if (one.joint >= 0 && std::ranges::find(read, one.joint, &JointColumn::joint) != read.end())
      problems_.add(place, fmt::format("joint {} has a column already", in_quotes(name)));
    read_column(node->items[i], fmt::format("{} of {}", key, in_quotes(name)), one.column);
    read.push_back(std::move(one));
  }
  field.value = std::move(read);
}

void Reader::read_column(const Node& node, const std::string& what, LogColumn& value) {
  value = {};
  if (node.kind == Node::Kind::map) {
    Reader reader(node, what, problems_, joints_, folder_);
    value.fields(reader);
    reader.finish();
  } else if (node.kind == Node::Kind::scalar) {
    value.name = node.text;
  } else {
    problems_.add(node.place, fmt::format("{} is {}; expected the name of a column, or {{column: NAME, scale: NUMBER}}", what,
                                          found(node)));
  }
}

}  // namespace gaitlab
