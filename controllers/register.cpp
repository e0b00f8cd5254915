#include "controllers/register.h"

#include "controllers/hold.h"
#include "controllers/pid.h"

namespace gaitlab::controllers {

void register_controllers(Registry& registry) {
  add_controller<Pid>(registry, "pid", Pid::kManual);
  add_controller<Hold>(registry, "hold", Hold::kManual);
}

}  // namespace gaitlab::controllers
