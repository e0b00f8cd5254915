// Writes Settings structs as maps, every default in full: the resolved scenario.
#pragma once
#include <string>
#include <vector>

#include "core/plugin/fields.h"
#include "core/scenario/node.h"

namespace gaitlab {

Node scalar_node(std::string text, bool quoted = false);
/// A text: quoted where a reader could take it for something else.
Node text_node(const std::string& text);
/// A list in one line.
Node numbers_node(std::span<const double> values);

/// One map, filled by visiting fields.
class Writer final : public Fields {
 public:
  /// Joints are written by name.
  explicit Writer(const std::vector<std::string>& joints) : joints_(joints) { map_.kind = Node::Kind::map; }

  void number(const char* key, double& value, Spec spec) override;
  void number_or(const char* key, double& value, const char* word, Spec spec) override;
  void integer(const char* key, std::int64_t& value, Spec spec) override;
  void flag(const char* key, bool& value, const char* about) override;
  void text(const char* key, std::string& value, const char* about) override;
  void file(const char* key, std::string& value, const char* about) override;
  void choice(const char* key, int& value, std::span<const char* const> names, const char* about) override;
  void per_joint(const char* key, PerJoint& value, Spec spec) override;
  void joint(const char* key, std::int64_t& value, const char* about) override;
  void vector(const char* key, std::span<double> value, Spec spec) override;
  void numbers(const char* key, std::vector<double>& value, Spec spec) override;
  void rows(const char* key, std::vector<std::vector<double>>& value, Spec spec) override;
  void texts(const char* key, std::vector<std::string>& value, const char* about) override;
  void named(const char* key, std::vector<Named>& values, NamedValues kind, const char* about) override;
  void problem(const char*, std::string_view) override {}
  void problem_at(const char*, std::string_view, std::size_t, std::string_view) override {}
  using Fields::group;
  using Fields::list;
  using Fields::rule_or_list;

  void add(const std::string& key, Node value);
  Node take() { return std::move(map_); }

 private:
  void list(const char* key, const char* about, List list) override;
  void rule_or_list(const char* key, int& rule, std::span<const char* const> names, const char* about, List list) override;
  void group(const char* key, const char* about, Group group) override;

  const std::vector<std::string>& joints_;
  Node map_;
};

}  // namespace gaitlab
