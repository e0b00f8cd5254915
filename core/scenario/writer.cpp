#include "core/scenario/writer.h"

#include "core/scenario/value.h"

namespace gaitlab {

Node scalar_node(std::string text, bool quoted) {
  Node node{Node::Kind::scalar};
  node.text = std::move(text);
  node.quoted = quoted;
  return node;
}

Node text_node(const std::string& text) {
  const bool plain = is_name(text, "_./*-") && !read_number(scalar_node(text), "").ok() && text[0] != '*' && text[0] != '-';
  return scalar_node(text, !plain || text == "null" || text == "true" || text == "false");
}

Node numbers_node(std::span<const double> values) {
  Node node{Node::Kind::list};
  node.flow = true;
  for (const double value : values) node.items.push_back(scalar_node(number_text(value)));
  return node;
}

void Writer::add(const std::string& key, Node value) {
  map_.keys.emplace_back(key, Place{});
  map_.items.push_back(std::move(value));
}

void Writer::number(const char* key, double& value, Spec) { add(key, scalar_node(number_text(value))); }

void Writer::number_or(const char* key, double& value, const char* word, Spec) {
  add(key, scalar_node(value > 0 ? number_text(value) : word));
}

void Writer::integer(const char* key, std::int64_t& value, Spec) { add(key, scalar_node(std::to_string(value))); }

void Writer::flag(const char* key, bool& value, const char*) { add(key, scalar_node(value ? "true" : "false")); }

void Writer::text(const char* key, std::string& value, const char*) { add(key, text_node(value)); }

void Writer::file(const char* key, std::string& value, const char*) {
  // A text in one line would be read as a path.
  add(key, scalar_node(value.find('\n') == std::string::npos ? value + "\n" : value, true));
}

void Writer::choice(const char* key, int& value, std::span<const char* const> names, const char*) {
  add(key, scalar_node(names[static_cast<std::size_t>(value)]));
}

void Writer::per_joint(const char* key, PerJoint& value, Spec) {
  add(key, value.each.empty() ? scalar_node(number_text(value.common)) : numbers_node(value.each));
}

void Writer::joint(const char* key, std::int64_t& value, const char*) {
  // A number that is no joint means "none" to its plugin; it is the default, so that leaving it out says the same.
  if (value < 0 || static_cast<std::size_t>(value) >= joints_.size()) return;
  add(key, text_node(joints_[static_cast<std::size_t>(value)]));
}

void Writer::vector(const char* key, std::span<double> value, Spec) { add(key, numbers_node(value)); }

void Writer::numbers(const char* key, std::vector<double>& value, Spec) { add(key, numbers_node(value)); }

void Writer::rows(const char* key, std::vector<std::vector<double>>& value, Spec) {
  Node node{Node::Kind::list};
  node.flow = value.empty();
  for (const std::vector<double>& row : value) node.items.push_back(numbers_node(row));
  add(key, std::move(node));
}

void Writer::texts(const char* key, std::vector<std::string>& value, const char*) {
  Node node{Node::Kind::list};
  node.flow = true;
  for (const std::string& text : value) node.items.push_back(text_node(text));
  add(key, std::move(node));
}

void Writer::named(const char* key, std::vector<Named>& values, NamedValues, const char*) {
  Writer writer(joints_);
  for (Named& value : values) {
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

void Writer::list(const char* key, const char*, List list) {
  Node node{Node::Kind::list};
  for (std::size_t i = 0; i < list.size(list.self); ++i) {
    Writer writer(joints_);
    list.visit(list.self, i, writer);
    node.items.push_back(writer.take());
    node.items.back().flow = true;
  }
  node.flow = node.items.empty();
  add(key, std::move(node));
}

void Writer::rule_or_list(const char* key, int& rule, std::span<const char* const> names, const char* about, List list) {
  if (rule < 0) {
    this->list(key, about, list);
  } else {
    add(key, scalar_node(names[static_cast<std::size_t>(rule)]));
  }
}

void Writer::group(const char* key, const char*, Group group) {
  Writer writer(joints_);
  group.visit(group.self, writer);
  Node node = writer.take();
  node.flow = node.items.empty();
  add(key, std::move(node));
}

}  // namespace gaitlab
