#include "controllers/register.h"

#include "controllers/hold.h"
#include "controllers/pid.h"
#include "controllers/rc_servo.h"
#include "controllers/replay.h"

namespace gaitlab::controllers {

void register_controllers(Registry& registry) {
  add_controller<Pid>(registry, "pid", Pid::kManual);
  add_controller<RcServo>(registry, "rc_servo", RcServo::kManual);
  add_controller<Replay>(registry, "replay", Replay::kManual);
  add_controller<Hold>(registry, "hold", Hold::kManual);
}

}  // namespace gaitlab::controllers
