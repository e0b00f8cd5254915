// Writer of Settings structs as YAML maps that contain every default, for the resolved scenario.
#pragma once
#include <string>
#include <vector>

#include "core/plugin/fields.h"
#include "core/settings/node.h"

namespace gaitlab {

Node scalar_node(std::string text, bool quoted = false);
/// Node of a text, in quotes if a reader could mistake the text for another type.
Node text_node(const std::string& text);
/// YAML of a text on one line, in quotes where it needs them.
std::string yaml_text(const std::string& text);
/// Node of a list on one line.
Node numbers_node(std::span<const double> values);

/// Writer of one map, filled by visiting fields.
class Writer final : public Fields {
 public:
  /// `joints` are the joint names, by which joints are written.
  explicit Writer(const std::vector<std::string>& joints) : joints_(joints) { map_.kind = Node::Kind::map; }

  void visit(const Field& field) override;
  void problem_at(const char*, std::string_view, std::size_t, std::string_view) override {}

  void add(const std::string& key, Node value);
  Node take() { return std::move(map_); }

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
  void on(const char*, const field::Other&) {}

  const std::vector<std::string>& joints_;
  Node map_;
};

}  // namespace gaitlab
