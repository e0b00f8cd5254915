// What exists: one line a kind.
#include "actuators/register.h"
#include "app/app.h"
#include "controllers/register.h"
#include "cpg/register.h"
#include "physics_bullet/engine.h"

namespace gaitlab::app {

Catalog standard_catalog() {
  Catalog catalog;
  register_bullet(catalog);
  register_actuators(catalog);
  register_controllers(catalog);
  register_cpgs(catalog);
  return catalog;
}

}  // namespace gaitlab::app
