// Kinds of named things that come with the program or with its plugins. `gaitlab list` prints their names, `gaitlab explain`
// the manual of one.
#pragma once
#include <functional>
#include <string>
#include <vector>

#include "core/plugin/catalog.h"

namespace gaitlab::app {

struct ListedKind {
  std::string name, plural;
  std::function<std::vector<std::string>(const Catalog&)> names;
  std::function<std::string(const std::string& name, Catalog&)> about;   ///< one line
  std::function<std::string(const std::string& name, Catalog&)> manual;  ///< text that `gaitlab explain` prints
};

/// All kinds, in the order of `gaitlab list`.
const std::vector<ListedKind>& listed_kinds();
/// Kind with this name, in singular or plural, or nullptr.
const ListedKind* listed_kind(const std::string& name);
/// Manual of a servo file: its first comment, and the table of its numbers.
std::string servo_manual(const std::string& file, const Catalog& catalog);

/// Lines `  NAME  what it is` for the names of a kind.
std::string name_rows(const ListedKind& kind, Catalog& catalog);

/// Throws InputError for an unknown word: `unknown WHAT 'x'; did you mean 'y'?`, with all known words and a hint.
[[noreturn]] void refuse_unknown(const std::string& command, const std::string& what, const std::string& found,
                                 const std::vector<std::string>& known, const std::string& hint = "");

/// Manual of a CPG file.
std::string cpg_manual(const std::string& file);

/// Manual of the module type in a file.
std::string module_manual(const std::string& file, Catalog& catalog);

}  // namespace gaitlab::app
