#include "kit/engines.h"
#include "physics_articulated/engine.h"

namespace gaitlab::kit {

void register_engines(Catalog& catalog) { register_articulated(catalog); }

std::string bullet_text() { return "without Bullet"; }

}  // namespace gaitlab::kit
