// Module types by what a scenario calls them: a name, a file or an inline map; each read once.
#pragma once
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "core/model/module_type.h"
#include "core/settings/node.h"

namespace gaitlab {

class TypeLibrary {
 public:
  /// `folder`: the scenario file's, where names and relative paths are looked for.
  TypeLibrary(std::string folder, Problems& problems) : folder_(std::move(folder)), problems_(problems) {}

  /// `robot.types`, a map of names to inline types.
  void define(const Node& types);

  /// Index of the type that a node means, in the order of first use; nothing with a problem (reported once a type).
  /// The nodes given must outlive the library.
  std::optional<std::size_t> find(const Node& node);

  /// A map is a type of its own, rather than types by module number.
  static bool is_inline(const Node& map);

  std::vector<ModuleType> types;
  std::vector<Node> documents;

 private:
  using Index = std::optional<std::size_t>;

  Index find_name(const Node& node);
  Index read_file(const std::string& path, const SourceLocation& asked_at);
  Index read(const Node& document, bool versioned, Problems& problems);
  [[nodiscard]] std::vector<std::string> search_folders() const;

  std::string folder_;
  Problems& problems_;
  std::map<std::string, Index> seen_ = {};  ///< by name or canonical path
  std::map<const Node*, Index> inline_ = {};
  std::map<std::string, const Node*> defined_ = {};  ///< robot.types
};

}  // namespace gaitlab
