// Scenarios as Python holds them.
#pragma once
#include <pybind11/pybind11.h>

#include <memory>
#include <mutex>
#include <string>
#include <utility>
#include <vector>

#include "core/plugin/catalog.h"
#include "core/scenario/read_scenario.h"

namespace gaitlab::python {

using Texts = std::vector<std::string>;  ///< settings `key.path=value`, or sentences

/// Plugins that a scenario may load: all, or only the named libraries.
struct Trusted {
  bool all = true;
  Texts files = {};
};

/// A file that was read, with the catalog that its scenarios refer to. Scenarios that differ in settings share it.
struct ReadFile {
  explicit ReadFile(Catalog made) : catalog(std::move(made)) {}
  std::string path;
  Texts sets;
  Trusted trusted;
  std::size_t classes = 0;  ///< classes_added() when the catalog was made
  Catalog catalog;
  std::unique_ptr<ScenarioTemplate> common;
  std::mutex one_at_a_time;  ///< guards `common`
  [[nodiscard]] Scenario with(const Texts& own) {
    const std::lock_guard lock(one_at_a_time);
    return common->with(own);
  }
};

struct PyScenario {
  std::shared_ptr<ReadFile> file;  ///< destroyed after the scenario, whose plugins are entries of this catalog
  Texts own;                       ///< settings in addition to those of `file`
  Scenario scenario;
};

/// The trust of a catalog. A message of refusal names the argument `plugins` of the Python function `call`. Throws InputError
/// if a file does not exist.
PluginTrust trust_of(const Trusted& trusted, const std::string& call);

std::shared_ptr<PyScenario> read_python(const std::string& file, const Texts& sets, const Trusted& trusted);
/// The scenario with further settings. If a Python class was registered since the file was read, the file is read again, and
/// InputError is thrown if it has changed.
std::shared_ptr<PyScenario> with_sets(const PyScenario& scenario, const Texts& sets);

/// Warnings, and notes, on a scenario, each with its place.
Texts warnings_of(const PyScenario& scenario, bool severe);

/// Numbers of `gaitlab check`, by name.
pybind11::dict check_of(const PyScenario& scenario);

}  // namespace gaitlab::python
