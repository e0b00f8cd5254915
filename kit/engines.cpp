#include "kit/engines.h"

#include "physics_articulated/engine.h"
#include "physics_bullet/engine.h"

namespace gaitlab::kit {

void register_engines(Catalog& catalog) {
  register_bullet(catalog);
  register_articulated(catalog);
}

std::string bullet_text() { return "Bullet " + bullet_version(); }

}  // namespace gaitlab::kit
