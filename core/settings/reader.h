// Reader of Settings structs from a YAML map. It checks types, ranges and names and reports every problem with its place.
#pragma once
#include <functional>
#include <initializer_list>
#include <string>
#include <vector>

#include "core/plugin/fields.h"
#include "core/settings/joint_patterns.h"
#include "core/settings/node.h"

namespace gaitlab {

/// Names of the robot's joints. Null if the robot could not be built; values that depend on its joints are then not checked.
using JointNames = const std::vector<std::string>*;

inline const JointGroups kNoGroups;

/// An unknown key and its map: the keys that lead to the map, such as `contact`, or "" for the file itself. `near` is a similar
/// key of the same map, or "".
struct UnknownKey {
  std::string section, key, near;
};

/// End of a message about an unknown key, which may belong elsewhere in the file: `; did you mean ground.friction?`. An empty
/// text means that the known keys of the map are offered.
using Elsewhere = std::function<std::string(const UnknownKey& unknown)>;

/// Reader of one map. After the visits of all fields, finish() reports the keys that were not read. A field keeps its value if
/// its key is absent or invalid.
class Reader final : public Fields {
 public:
  /// Reader of `node`, called `name` in messages. A node that is not a map is a problem. The node and the problems must outlive
  /// the reader. Relative file paths start at `folder`.
  Reader(const Node& node, const std::string& name, Problems& problems, JointNames joints, std::string folder = {});
  /// Reader of an absent map. Every field then keeps its default. `place` is the place of the parent.
  Reader(const SourceLocation& place, Problems& problems, JointNames joints, std::string folder = {});

  void visit(const Field& field) override;
  void problem_at(const char* key, std::string_view name, std::size_t offset, std::string_view what) override;

  /// Value of a key, or null. The key then counts as known.
  const Node* take(const char* key);
  [[nodiscard]] bool has(const char* key) const { return map_->find(key) != nullptr; }
  /// True if the map has no such key, but an unknown one that was probably meant to be it.
  [[nodiscard]] bool misspelt(const char* key) const;
  /// Reads a format version. Returns false, and adds a problem, for any version except 1.
  bool version(const char* key);
  /// Names of the robot's modules, for values per module.
  void modules(JointNames names) { modules_ = names; }
  /// Groups of joints, whose names may stand where patterns may. They must outlive the reader.
  void groups(const JointGroups& groups) { groups_ = &groups; }
  /// Search for unknown keys, also of nested maps. It must outlive the reader. `section`: keys that lead to this map.
  void elsewhere(const Elsewhere* search, std::string section = {}) {
    elsewhere_ = search;
    section_ = std::move(section);
  }
  /// Restricts reading to these keys. Fields with other keys keep their values.
  void only(std::vector<std::string> keys) { only_ = std::move(keys); }
  /// Reports each of these keys that is missing.
  void require(std::initializer_list<const char*> keys);
  /// Reports every key that was not read.
  void finish();
  /// Faulty elements of the lists and maps by name in this map.
  [[nodiscard]] const std::vector<const Node*>& faulty() const { return faulty_; }

 private:
  void on(const char* key, const field::Number& field);
  void on(const char* key, const field::NumberOr& field);
  void on(const char* key, const field::Integer& field);
  void on(const char* key, const field::Flag& field);
  void on(const char* key, const field::Text& field);
  void on(const char* key, const field::File& field);
  void on(const char* key, const field::OneOf& field);
  void on(const char* key, const field::EachJoint& field);
  void on(const char* key, const field::Joint& field);
  void on(const char* key, const field::Vector& field);
  void on(const char* key, const field::Numbers& field);
  void on(const char* key, const field::Rows& field);
  void on(const char* key, const field::Texts& field);
  void on(const char* key, const field::Names& field);
  void on(const char* key, const field::Periods& field);
  void on(const char* key, const field::Map& field);
  void on(const char* key, const field::Column& field);
  void on(const char* key, const field::Columns& field);
  void on(const char* key, const field::List& field);
  void on(const char* key, const field::RuleOrList& field);
  void on(const char* key, const field::Group& field);
  void on(const char* key, const field::Other&) { take(key); }

  void unknown(const std::string& key, const Node& value, const SourceLocation& place);
  [[nodiscard]] std::string meant(const std::string& key, const Node& value) const;
  /// Reports that a required key is missing. If finish() finds it misspelt, that becomes the problem instead.
  void missing(const char* key);
  void read_name(const Node& item, const char* key, const field::Names& field);
  const Node* take_list(const char* key, const char* expected);
  void read_elements(const char* key, const Node& node, const field::List& list);
  bool read_one(const Node& node, const std::string& what, const Spec& spec, double& value);
  /// Reads entries of a list by their numbers, as --set KEY.1=VALUE gives them. The other entries keep their values.
  void read_entries(const Node& map, const std::string& key, const field::Vector& field, const std::string& expected);
  void read_each(const Node& node, const std::string& key, const Spec& spec, std::span<double> value);
  /// The parts of the robot that have a value in a field, by name, and their noun.
  struct Parts {
    JointNames names;  ///< null if the robot could not be built
    const char* noun;
    const JointGroups& groups;
  };
  [[nodiscard]] Parts joints() const { return {joints_, "joint", *groups_}; }
  [[nodiscard]] Parts parts(const field::EachJoint& field) const {
    return field.of_modules ? Parts{modules_, "module", kNoGroups} : joints();
  }
  void read_each_joint(const Node& node, const char* key, const field::EachJoint& field);
  /// Reports the first joint without a value, for a field without a default.
  void require_each(const char* key, const Node* node, const PerJoint& value);
  void read_joint_list(const Node& node, const std::string& key, const Spec& spec, PerJoint& value, Parts of);
  /// Reads a map of values per part. Returns true if every part gets a value, by name, pattern or default.
  bool read_joint_map(const Node& node, const std::string& key, const Spec& spec, PerJoint& value, Parts of);
  void read_named(const Node& node, const std::string& what, NamedValues kind, Named& value);
  void read_named_numbers(const Node& node, const std::string& what, PerJoint& value);
  void read_column(const Node& node, const std::string& what, LogColumn& value);
  /// Number of a joint by its name or number, or -1 with a problem that calls it `what` if the robot has no such joint.
  std::int64_t read_joint(const Node& node, const std::string& what);
  /// Number of a part by its name, or -1 with a problem if the name is unknown.
  std::int64_t number_of(const std::string& name, const SourceLocation& place, Parts of);

  Node empty_;  ///< node used for an absent map, or for a value that is not a map
  const Node* map_;
  Problems& problems_;
  JointNames joints_, modules_ = nullptr;
  std::string folder_, section_;
  const Elsewhere* elsewhere_ = nullptr;
  const JointGroups* groups_ = &kNoGroups;
  std::vector<std::string> known_, only_;
  std::vector<const Node*> faulty_;
  std::vector<std::pair<std::string, std::size_t>> missing_;  ///< required keys that are missing, each with its problem
  Need need_ = Need::preset;                                  ///< of the field that is read
  std::string or_word_;                                       ///< end of a message, about the word that the field permits
  bool tolerant_ = false;  ///< true if the set of known keys is uncertain, so that unknown keys are not reported
};

}  // namespace gaitlab
