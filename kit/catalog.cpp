#include "kit/catalog.h"

#include "actuators/register.h"
#include "controllers/register.h"
#include "core/scenario/plugin_files.h"
#include "cpg/register.h"
#include "kit/engines.h"
#include "sensors/register.h"

namespace gaitlab::kit {

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

}  // namespace gaitlab::kit
