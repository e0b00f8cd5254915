#include <fmt/format.h>

#include "app/app.h"
#include "report/build_id.h"
#ifdef GAITLAB_BULLET
#include "physics_bullet/engine.h"
#endif

namespace gaitlab::app {

std::string version() {
#ifdef GAITLAB_BULLET
  return fmt::format("gaitlab {}, Bullet {}", report::build_id(), bullet_version());
#else
  return fmt::format("gaitlab {}, without Bullet", report::build_id());
#endif
}

}  // namespace gaitlab::app
