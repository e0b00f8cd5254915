// Writer of XML with elements, attributes and comments, which suffice for the robot formats.
#pragma once
#include <list>
#include <string>
#include <utility>
#include <vector>

namespace gaitlab::interchange {

/// An element or a comment. No XML library is used, because a program that reads the robot in the same process may contain
/// another version of that library. The dynamic linker then gives both the version that was loaded first (MuJoCo 3 exports its
/// tinyxml2 and crashed in this way).
struct Xml {
  std::string name;   ///< name of the element; empty for a comment
  std::string words;  ///< text of the comment
  std::vector<std::pair<std::string, std::string>> attributes;
  std::list<Xml> children;  ///< a list, so that references to children remain valid

  /// Value of the attribute, or nullptr if there is none of this name.
  [[nodiscard]] const std::string* attribute(const std::string& wanted) const;
};

/// Adds a child element after the existing children.
Xml& add(Xml& parent, std::string name);
/// Adds a comment. Two consecutive hyphens, which XML forbids in a comment, become one.
void comment(Xml& parent, std::string words);
/// Sets an attribute or replaces its value. Any text is allowed as a value.
void set(Xml& element, const std::string& name, std::string value);
/// XML text with one element per line, indented by four spaces per level but at most 160. UTF-8 is not changed.
std::string print(const Xml& root);

}  // namespace gaitlab::interchange
