// A YAML text as a tree of nodes with their places. Reading is strict where yaml-cpp 0.7 is lax (docs/decisions).
#pragma once
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "core/errors.h"

namespace gaitlab {

struct Node {
  enum class Kind { null, scalar, list, map } kind = Kind::null;
  SourceLocation place = {};
  std::string text = {};                                          ///< scalar
  bool quoted = false;                                            ///< scalar in quotes: a text, never a number
  bool flow = false;                                              ///< list or map on one line: { } [ ]
  std::vector<Node> items = {};                                   ///< list; values of a map, in file order
  std::vector<std::pair<std::string, SourceLocation>> keys = {};  ///< map: key of items[i]
  std::shared_ptr<const std::string> source = {};                 ///< scalar read from a text: that text
  std::size_t position = 0;                                       ///< scalar: its offset in `source`

  [[nodiscard]] const Node* find(const std::string& key) const;  ///< value of a map's key, or nullptr
};

/// Description of a node's content for a message: `'fast'`, `a list`, `empty`.
std::string found(const Node& node);

/// Parses one YAML document whose root is a map. Throws InputError (syntax, duplicate key, anchor, alias, tag, second document,
/// deeper than 32, larger than 1 MB, not UTF-8 text, ...).
Node parse_yaml(const std::string& text, const std::string& file);

/// The same with every finding in `problems`; nothing if the text has no tree. A duplicate key, an anchor or a tag is an error,
/// but the tree is returned, so that a reader can find its other errors.
std::optional<Node> parse_yaml(const std::string& text, const std::string& file, Problems& problems);

/// The same from a file; for a missing file InputError at `asked_at` (or the file itself).
Node read_yaml(const std::string& path, const SourceLocation& asked_at = {});

/// YAML text of a node, indented by `indent`; parse_yaml gives the same node, places excepted.
std::string print_yaml(const Node& node, int indent = 0);

}  // namespace gaitlab
