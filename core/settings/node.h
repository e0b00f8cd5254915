// Tree of the nodes of a YAML text with their places in the file, parsed more strictly than by yaml-cpp 0.7 (docs/decisions).
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
  std::string text = {};         ///< text of a scalar
  bool quoted = false;           ///< true for a scalar in quotes, which is a text and never a number
  bool flow = false;             ///< true for a list or map on one line, in [ ] or { }
  std::vector<Node> items = {};  ///< elements of a list, or values of a map in file order
  std::vector<std::pair<std::string, SourceLocation>> keys = {};  ///< keys of a map; keys[i] belongs to items[i]
  std::shared_ptr<const std::string> source = {};                 ///< text that contains the scalar
  std::size_t position = 0;                                       ///< offset of the scalar in `source`

  [[nodiscard]] const Node* find(const std::string& key) const;  ///< value of a map's key, or null
};

/// Description of a node's content for a message, such as `'fast'`, `a list` or `empty`.
std::string found(const Node& node);

/// Parses one YAML document whose root is a map. Throws InputError for invalid or refused text: syntax errors, duplicate keys,
/// anchors, aliases, tags, a second document, nesting deeper than 32, more than 1 MB, or text that is not UTF-8.
Node parse_yaml(const std::string& text, const std::string& file);

/// Parses as above, but adds every error to `problems`. Returns nothing if no tree can be built. Returns the tree in spite of a
/// duplicate key, an anchor or a tag, so that a reader can find further errors.
std::optional<Node> parse_yaml(const std::string& text, const std::string& file, Problems& problems);

/// Parses a file. If the file is missing, throws InputError at `asked_at`, or at the file if `asked_at` is empty.
Node read_yaml(const std::string& path, const SourceLocation& asked_at = {});

/// YAML text of a node, indented by `indent` blanks. parse_yaml() turns the text into the same node, except for places.
std::string print_yaml(const Node& node, int indent = 0);

}  // namespace gaitlab
