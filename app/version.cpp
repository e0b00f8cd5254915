#include <fmt/format.h>

#include "app/app.h"
#include "physics_bullet/engine.h"
#include "report/build_id.h"

namespace gaitlab::app {

std::string version() { return fmt::format("gaitlab {}, Bullet {}", build_id(), bullet_version()); }

}  // namespace gaitlab::app
