// Catalog of the program: engines, actuators, controllers, CPGs and plugin libraries.
#include <filesystem>
#include <system_error>
#include <utility>

#include "actuators/register.h"
#include "app/app.h"
#include "app/engines.h"
#include "controllers/register.h"
#include "core/errors.h"
#include "core/scenario/plugin_files.h"
#include "cpg/register.h"
#include "sensors/register.h"

namespace gaitlab::app {

Catalog standard_catalog(const std::vector<std::string>& plugins) {
  Catalog catalog;
  register_engines(catalog);
  actuators::register_actuators(catalog);
  controllers::register_controllers(catalog);
  cpg::register_cpgs(catalog);
  sensors::register_sensors(catalog);
  for (const std::string& plugin : plugins) load_plugin_file(plugin, catalog);
  return catalog;
}

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
