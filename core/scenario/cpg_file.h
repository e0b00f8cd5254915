// Files with a pattern generator: equations with parameters, or the model of another type.
#pragma once
#include <optional>
#include <string>
#include <vector>

#include "core/plugin/catalog.h"
#include "core/settings/node.h"

namespace gaitlab {

/// A number that the file gives a name, and that a scenario states under `cpg:`.
struct CpgParameter {
  std::string name, unit, about;
  double value = 0, low = -1e9, high = 1e9;
  void fields(Fields& f);
};

/// A file: equations with parameters, or the `type` and `model` of another CPG. Its keys frequency, amplitude, offset,
/// phase_lag, couplings and step are defaults for the scenario's section.
struct CpgFile {
  std::string path, manual;
  std::vector<CpgParameter> parameters;
  Node text;  ///< the whole file
};

/// Reads a file with the key gaitlab_cpg. Returns nothing after a problem. Throws InputError if it cannot be read or is of
/// another kind.
std::optional<CpgFile> read_cpg_file(const std::string& path, const SourceLocation& asked_at, Problems& problems);

/// Manual of such a file as `gaitlab explain` prints it.
std::string manual_of(const CpgFile& file);

/// Expands the section `cpg` of a scenario if its type is a file: a path, or the name of a file in scenarios/cpg that is not
/// the name of a CPG. The type is then `equations`, or the type in the file. Keys that are parameters of the file become
/// `model.parameters`. `folder` is that of the scenario. Returns the section as it was, or nothing if it stays.
std::optional<Node> insert_cpg_file(Node& root, const std::string& folder, const Catalog& catalog, Problems& problems);

}  // namespace gaitlab
