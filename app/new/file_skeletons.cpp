// Templates of a module, of a scenario and of a bench, and the function that fills templates.
#include "app/new/skeletons.h"

namespace gaitlab::app {

std::string filled(std::string text, const std::string& mark, const std::string& value) {
  for (std::size_t at = text.find(mark); at != std::string::npos; at = text.find(mark, at + value.size())) {
    text.replace(at, mark.size(), value);
  }
  return text;
}

const char* const kSkeletonModule =
    R"(# Module @NAME@: two boxes on one hinge, driven by a servo. It is valid; replace every number.
# Measure first: masses (scale), boxes (ruler); then the hinge, the servo's data sheet, and the docking faces.
# Units: m, kg, N m, rad, s, V, A. Every key: gaitlab explain module
gaitlab_module: 1
name: @TEXT@
source: "chosen: the example of gaitlab new module"   # origin of the numbers; begin with "chosen" if they are not measured

bodies:                                # inertia and centre of mass follow from shape and mass; com and inertia replace them
  base:                                # the root: no hinge moves it, and its frame is the module's
    mass: 0.06                         # kg, with servo, electronics and screws
    shape:                             # box: edges; cylinder: [radius, length] along y; sphere: radius
      - {box: [0.04, 0.05, 0.05], origin: [-0.02, 0, 0]}   # origin: its middle
  head:
    mass: 0.03
    shape:
      - {box: [0.04, 0.05, 0.05], origin: [0.02, 0, 0]}

hinges:
  - name: hinge                        # its joint in module 0 is m0/hinge
    parent: base
    child: head
    origin: [0, 0, 0]                  # m, in the frame of base
    axis: [0, 1, 0]                    # a positive angle turns head about it by the right-hand rule
    range: [-1.5708, 1.5708]           # rad, +-90 degrees; or free, without a stop

actuator:                              # the servo's data sheet
  type: servo
  voltage: 4.8                         # V, at which the sheet states the next two numbers
  stall_torque: 0.31381                # N m: 3.2 kgf cm (1 kgf cm = 0.0980665 N m)
  no_load_speed: 4.553                 # rad/s: 0.23 s/60 degrees (1.0472 rad / 0.23 s)
  source: "chosen: a hobby servo"      # name of the data sheet; without it, or with "chosen", verdicts call the motor chosen
controller:
  type: pid
  Kp: 49                               # V/rad: 0.7 voltage/(no_load_speed 0.015 s) takes 70 % of the error each 15 ms
  Kd: 0

faces:                                 # where modules dock
  - {id: 0, body: base, gender: none, origin: [-0.04, 0, 0], normal: [-1, 0, 0], reference: [0, 1, 0]}
  - {id: 1, body: head, gender: none, origin: [0.04, 0, 0], normal: [1, 0, 0], reference: [0, 1, 0]}

contacts:
  all: shapes                          # what touches the ground: the corners of the boxes, or a list of points and spheres

may_overlap: [[base, head]]            # the boxes meet at the hinge and overlap when it bends; delete this line for real shapes
)";

const char* const kSkeletonScenario =
    R"(# Scenario @NAME@: @WHAT@ @ROBOT@. @PROMISE@: gaitlab run @FILE@
# Change first: @CHANGE@ of the gait. Every key: gaitlab explain
gaitlab: 1
name: @TEXT@

robot:
  modules: @MODULE@
@DOCKS@@BASE@
physics:
  engine: articulated      # bullet: an independent engine, for comparison
  accuracy: @ACCURACY@          # of the motors' torques

@GROUND@
@INITIAL@@CONTROLLER@cpg:
@CPG@
duration: @DURATION@                # s: @PERIODS@
)";

const char* const kSkeletonWave =
    R"(  type: phase_oscillator   # others: gaitlab list cpg
  frequency: @FREQUENCY@           # Hz
  amplitude: @AMPLITUDE@           # rad
  offset: @OFFSET@                # rad, middle of the motion
  phase_lag: 1             # rad from joint to joint; negative: the wave runs the other way
)";

const char* const kSkeletonBench =
    R"(# Bench @NAME@: a servo moves an arm with a mass. Its numbers follow from logs: gaitlab identify @FILE@ LOG.csv LOG.csv ...
# Every key: gaitlab explain. Units: m, kg, N m, rad, s, V, A.
gaitlab: 1
name: @TEXT@

robot:
  base: fixed
  position: [0, 0, 1]
  modules:
    gaitlab_module: 1
    name: bench
    bodies:
      stand: {mass: 1, inertia: [1, 1, 1, 0, 0, 0]}
      arm:                             # all that turns, without the servo's own gear
        mass: @MASS@                      # kg
        com: [0, 0, -@LENGTH@]              # distance of its centre from the axis; at angle 0 it hangs down
        inertia: [@INERTIA@, @INERTIA@, @INERTIA@, 0, 0, 0]   # about its centre; of a ball with a sixth of the length as radius
    hinges: [{name: hinge, parent: stand, child: arm, axis: [0, 1, 0], range: free}]

ground: {type: none}
contact: {"on": none}
physics: {engine: articulated, estimate: off}

actuator: @ACTUATOR@   # u_max: the supply of the bench, V; 0: the voltage of the data sheet
controller: @CONTROLLER@   # a column controller.P in a table of logs has the gain of each log

# The goals are replayed, and the angles compared. `identify` puts each log in place of log.csv.
cpg: {type: table, model: {file: log.csv, time: t, columns: {m0/hinge: goal}, interpolation: linear, repeat: false}}
measured:
  file: log.csv
  time: t                              # s
  # "on": on                           # column that is 0 while the servo has no torque
  columns:
    # In rad and SI units, or {column: NAME, scale: NUMBER FOR 1}; also speed, duty, voltage, current, torque.
    m0/hinge: {angle: angle}

trace: {period: 0.002, columns: [t, joint.*]}
duration: 10                           # s; identify takes the length of each log
)";

}  // namespace gaitlab::app
