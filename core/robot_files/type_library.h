// Library of the module types of a scenario, by name, file or inline map, each of which is read only once.
#pragma once
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "core/model/module_type.h"
#include "core/settings/file_of_name.h"
#include "core/settings/node.h"

namespace gaitlab {

class TypeLibrary {
 public:
  /// `folder` is the folder of the scenario file. Names and relative paths are searched there.
  TypeLibrary(std::string folder, Problems& problems) : folder_(std::move(folder)), problems_(problems) {}

  /// Reads `robot.types`, a map from names to inline types.
  void define(const Node& types);

  /// Index of the type that a node refers to, in the order of first use. Returns nothing if the type has problems, which are
  /// reported once per type. The nodes must outlive the library.
  std::optional<std::size_t> find(const Node& node);

  /// File of the type with this name: the user's file or the shipped file.
  [[nodiscard]] std::optional<FileOfName> named_file(const std::string& name) const;

  /// True if a map is an inline type, and false if it is a map of types by module number.
  static bool is_inline(const Node& map);

  std::vector<ModuleType> types;
  std::vector<Node> documents;
  std::vector<Problem> notes;  ///< notes on names for which a user's file hides the shipped one

 private:
  using Index = std::optional<std::size_t>;

  Index find_name(const Node& node);
  Index read_file(const std::string& path, const SourceLocation& asked_at);
  Index read(const Node& document, bool versioned, Problems& problems);
  /// Folders of module types; the last one contains the shipped types.
  [[nodiscard]] std::vector<std::string> search_folders() const;

  std::string folder_;
  Problems& problems_;
  std::map<std::string, Index> seen_ = {};  ///< indices by name or canonical path
  std::map<const Node*, Index> inline_ = {};
  std::map<std::string, const Node*> defined_ = {};  ///< maps of robot.types by name
};

}  // namespace gaitlab
