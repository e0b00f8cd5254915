#include "app/app.h"
#include "app/engines.h"
#include "core/build_id.h"

namespace gaitlab::app {

std::string version() { return "gaitlab " + build_id() + ", " + bullet_text(); }

}  // namespace gaitlab::app
