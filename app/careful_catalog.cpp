// Catalog for commands that read files from unknown sources, and the command line for its messages.
#include <filesystem>
#include <system_error>
#include <utility>

#include "app/app.h"
#include "core/errors.h"

namespace gaitlab::app {

Catalog careful_catalog(const PluginArguments& allowed) {
  constexpr std::size_t kLongest = 200;  // bytes of the longest command line that a message repeats
  PluginTrust trust{.all = allowed.from_scenario};
  for (const std::string& file : allowed.files) {
    std::error_code failure;
    trust.files.insert(std::filesystem::canonical(file, failure).string());
    if (failure) throw InputError(SourceLocation{"--plugin " + file}, "cannot be loaded: " + failure.message());
  }
  trust.remedy = "if you trust " + (typed().size() > kLongest ? "it, add" : "it: " + typed()) +
                 " --plugins-from-scenario, or --plugin FILE for each plugin";
  Catalog catalog = standard_catalog();
  catalog.set_trust(std::move(trust));
  return catalog;
}

std::string& typed() {
  static std::string line = "gaitlab";
  return line;
}

}  // namespace gaitlab::app
