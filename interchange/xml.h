// Writer of XML: elements with attributes and comments, which suffice for the robot formats.
#pragma once
#include <list>
#include <string>
#include <utility>
#include <vector>

namespace gaitlab::interchange {

/// An element or a comment. Not from a library: a program that reads the robot in the same process may use another version of
/// that library, and the dynamic linker gives both the first one (MuJoCo 3 exports its tinyxml2, and crashed so).
struct Xml {
  std::string name;   ///< empty: a comment
  std::string words;  ///< of a comment
  std::vector<std::pair<std::string, std::string>> attributes;
  std::list<Xml> children;  ///< references to them remain valid

  /// nullptr: no such attribute.
  [[nodiscard]] const std::string* attribute(const std::string& wanted) const;
};

/// Adds a child element behind the others.
Xml& add(Xml& parent, std::string name);
/// Adds a comment; two hyphens in a row, which XML forbids there, become one.
void comment(Xml& parent, std::string words);
/// Sets an attribute, replacing one of that name. Any text is allowed as a value.
void set(Xml& element, const std::string& name, std::string value);
/// Text with a line per element, indented by four spaces per level, at most 160; UTF-8 unchanged.
std::string print(const Xml& root);

}  // namespace gaitlab::interchange
