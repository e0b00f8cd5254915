#include "app/app.h"
#include "app/engines.h"
#include "report/build_id.h"

namespace gaitlab::app {

std::string version() { return "gaitlab " + report::build_id() + ", " + bullet_text(); }

}  // namespace gaitlab::app
