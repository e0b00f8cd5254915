#include "core/settings/writer.h"

#include "core/settings/number_syntax.h"
#include "core/settings/wording.h"

namespace gaitlab {

Node scalar_node(std::string text, bool quoted) {
  Node node{Node::Kind::scalar};
  node.text = std::move(text);
  node.quoted = quoted;
  return node;
}

Node text_node(const std::string& text) {
  const bool plain = is_name(text, "_./*-") && !is_no_text_elsewhere(text) && text[0] != '*' && text[0] != '-';
  return scalar_node(text, !plain);
}

std::string yaml_text(const std::string& text) {
  std::string line = print_yaml(text_node(text));
  while (line.ends_with('\n')) line.pop_back();
  return line;
}

Node numbers_node(std::span<const double> values) {
  Node node{Node::Kind::list};
  node.flow = true;
  for (const double value : values) node.items.push_back(scalar_node(number_text(value)));
  return node;
}

void Writer::add(const std::string& key, Node value) {
  map_.keys.emplace_back(key, SourceLocation{});
  map_.items.push_back(std::move(value));
}

void Writer::visit(const Field& field) {
  if (field.is_word != nullptr && *field.is_word) return add(field.key, scalar_node(field.word));
  std::visit([&](const auto& value) { on(field.key, value); }, field.value);
}

void Writer::on(const char* key, const field::Number& field) { add(key, scalar_node(number_text(field.value))); }

void Writer::on(const char* key, const field::NumberOr& field) {
  add(key, scalar_node(field.value > 0 ? number_text(field.value) : field.word));
}

void Writer::on(const char* key, const field::Integer& field) { add(key, scalar_node(std::to_string(field.value))); }

void Writer::on(const char* key, const field::Flag& field) { add(key, scalar_node(field.value ? "true" : "false")); }

void Writer::on(const char* key, const field::Text& field) { add(key, text_node(field.value)); }

void Writer::on(const char* key, const field::File& field) {
  // The reader would take a text on one line for a path.
  add(key, scalar_node(field.value.find('\n') == std::string::npos ? field.value + "\n" : field.value, true));
}

void Writer::on(const char* key, const field::OneOf& field) { add(key, scalar_node(field.value)); }

void Writer::on(const char* key, const field::EachJoint& field) {
  if (field.role == field::Role::rating && field.value == PerJoint()) return;
  if (not_stated(field)) return;
  const PerJoint value = in_force(field);
  add(key, value.each.empty() ? scalar_node(number_text(value.common)) : numbers_node(value.each));
}

void Writer::on(const char* key, const field::Joint& field) {
  // A plugin reads an invalid joint number as "none". This number is the default, so that the key can be omitted.
  if (field.value < 0 || static_cast<std::size_t>(field.value) >= joints_.size()) return;
  add(key, text_node(joints_[static_cast<std::size_t>(field.value)]));
}

void Writer::on(const char* key, const field::Vector& field) { add(key, numbers_node(field.value)); }

void Writer::on(const char* key, const field::Numbers& field) { add(key, numbers_node(field.value)); }

void Writer::on(const char* key, const field::Rows& field) {
  Node node{Node::Kind::list};
  node.flow = field.value.empty();
  for (const std::vector<double>& row : field.value) node.items.push_back(numbers_node(row));
  add(key, std::move(node));
}

void Writer::on(const char* key, const field::Texts& field) {
  Node node{Node::Kind::list};
  node.flow = true;
  for (const std::string& text : field.value) node.items.push_back(text_node(text));
  add(key, std::move(node));
}

void Writer::on(const char* key, const field::Names& field) {
  if (field.value.size() == 1) {
    add(key, text_node(field.value.front()));
  } else {
    on(key, field::Texts{field.value});
  }
}

void Writer::on(const char* key, const field::Periods& field) {
  if (field.most == nullptr || *field.most == field.value) {
    add(key, scalar_node(number_text(field.value)));
  } else {
    const double range[] = {field.value, *field.most};
    add(key, numbers_node(range));
  }
}

void Writer::on(const char* key, const field::Map& field) {
  Writer writer(joints_);
  for (Named& value : field.value) {
    if (value.text.empty()) {
      writer.per_joint(value.name.c_str(), value.number, {});
    } else {
      writer.text(value.name.c_str(), value.text, "");
    }
  }
  Node node = writer.take();
  node.flow = node.items.empty();
  add(key, std::move(node));
}

namespace {

Node column_node(LogColumn& column) {
  if (column.scale == 1) return text_node(column.name);
  const std::vector<std::string> no_joints;
  Writer writer(no_joints);
  column.fields(writer);
  Node node = writer.take();
  node.flow = true;
  return node;
}

}  // namespace

void Writer::on(const char* key, const field::Column& field) { add(key, column_node(field.value)); }

void Writer::on(const char* key, const field::Columns& field) {
  Writer writer(joints_);
  for (JointColumn& one : field.value) {
    if (one.joint >= 0) writer.add(joints_[static_cast<std::size_t>(one.joint)], column_node(one.column));
  }
  Node node = writer.take();
  node.flow = true;
  add(key, std::move(node));
}

void Writer::on(const char* key, const field::List& field) {
  Node node{field.name == nullptr ? Node::Kind::list : Node::Kind::map};
  for (std::size_t i = 0; i < field.size(field.self); ++i) {
    if (field.name != nullptr) node.keys.emplace_back(field.name(field.self, i), SourceLocation{});
    Writer writer(joints_);
    field.visit(field.self, i, writer);
    node.items.push_back(writer.take());
    node.items.back().flow = true;
  }
  node.flow = node.items.empty();
  add(key, std::move(node));
}

void Writer::on(const char* key, const field::RuleOrList& field) {
  if (field.rule.empty()) {
    on(key, field.list);
  } else {
    add(key, scalar_node(field.rule));
  }
}

void Writer::on(const char* key, const field::Group& field) {
  Writer writer(joints_);
  field.visit(field.self, writer);
  Node node = writer.take();
  node.flow = node.items.empty();
  add(key, std::move(node));
}

}  // namespace gaitlab
