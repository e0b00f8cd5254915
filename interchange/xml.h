// XML to be written: elements with attributes and comments, which is all that the robot formats have.
#pragma once
#include <list>
#include <string>
#include <utility>
#include <vector>

namespace gaitlab::interchange {

/// An element or a comment. Our own, and not a library's: whoever reads the robot in the same process may bring such a library
/// in another version, and the dynamic linker gives both programs the first one (MuJoCo 3 exports its own tinyxml2 and crashed
/// so).
struct Xml {
  std::string name;   ///< empty: a comment
  std::string words;  ///< of a comment
  std::vector<std::pair<std::string, std::string>> attributes;
  std::list<Xml> children;  ///< references to them stay valid

  /// nullptr: there is no such attribute.
  [[nodiscard]] const std::string* attribute(const std::string& wanted) const;
};

/// A child element behind the others.
Xml& add(Xml& parent, std::string name);
/// A comment; two hyphens in a row, which XML forbids there, become one.
void comment(Xml& parent, std::string words);
/// Replaces the attribute where there is one of that name. Any text is allowed as a value.
void set(Xml& element, const std::string& name, std::string value);
/// A line per element, indented by four spaces per level, at most 160; UTF-8 as it comes.
std::string print(const Xml& root);

}  // namespace gaitlab::interchange
