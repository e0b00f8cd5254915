#include "app/app.h"
#include "core/build_id.h"
#include "kit/engines.h"

namespace gaitlab::app {

std::string version() { return "gaitlab " + build_id() + ", " + bullet_text(); }

}  // namespace gaitlab::app
