// What exists: one line a kind.
#include "actuators/register.h"
#include "app/app.h"
#include "controllers/register.h"
#include "core/scenario/plugin_files.h"
#include "cpg/register.h"
#include "physics_articulated/engine.h"
#ifdef GAITLAB_BULLET
#include "physics_bullet/engine.h"
#endif

namespace gaitlab::app {

Catalog standard_catalog(const std::vector<std::string>& plugins) {
  Catalog catalog;
#ifdef GAITLAB_BULLET
  register_bullet(catalog);
#endif
  register_articulated(catalog);
  actuators::register_actuators(catalog);
  controllers::register_controllers(catalog);
  cpg::register_cpgs(catalog);
  for (const std::string& plugin : plugins) load_plugin_file(plugin, catalog);
  return catalog;
}

}  // namespace gaitlab::app
