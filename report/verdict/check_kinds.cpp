// The list of all checks of the verdict.
#include "report/verdict/checks.h"
#include "report/verdict/load_checks.h"

namespace gaitlab::report {

namespace {

using Group = CheckGroup;
constexpr CheckSpan kWindow = CheckSpan::window, kWhole = CheckSpan::whole_run;

template <DockQuantity kQuantity>
void dock(const CheckedRun& run, Check& made) {
  judge_docks(run.scenario, run.record, kQuantity, dock_limits(*run.scenario.robot, kQuantity), made);
  if (made.status == CheckStatus::not_judged || run.torque_errors.empty()) return;
  // All docks get the torque error of the worst joint, so that the dock with the least margin decides.
  const ErrorBar bar = ErrorBar::around(made.worst, made.value / made.limit, std::ranges::max(run.torque_errors));
  widen(run.scenario, {&bar, 1}, made);
}
void slip(const CheckedRun& run, Check& made) {
  judge_slip(run.scenario, run.record, run.summary, made);
  made.source = threshold("slip", run.limits().slip, Limits().slip);
}
void creep(const CheckedRun& run, Check& made) { judge_creep(run.scenario, run.record, run.summary, made); }
void stability(const CheckedRun& run, Check& made) { judge_stability(run.scenario, run.record, run.summary, made); }

constexpr const char* kGentler = "a smaller amplitude or frequency, or a stronger motor; --demand computes what is missing";
constexpr const char* kSmaller = "smaller amplitudes or offsets";
constexpr const char* kShorter = "a smaller physics.accuracy, or a smaller physics.step where one is given";

// id, group, unit, title, definition, fails, warns, span, key, remedy, judge, least, of_all_loads, rating
constexpr CheckKind kChecks[] = {
    {"outcome", Group::run, "s", "Run finished", "simulated time against the duration", "the run ended early", "", kWhole,
     "duration", "the message of the run names the remedy", checks::outcome, true},
    {"fall", Group::run, "", "Does not fall",
     "least height of the centre of mass above the ground, at control ticks, over the lower of two heights: in the start pose, "
     "lowered "
     "onto the ground, and in the pose of the set points at that time, upright (mean orientation of all links as at the start) "
     "on its lowest "
     "contact elements",
     "below limits.height", "", kWhole, "limits.height", "a gait with more support, or limits.height", checks::height, true},
    {"progress", Group::run, "m", "Goes somewhere", "travel of the centre of mass per period (without periods: in the window)",
     "below limits.progress of the robot's extent (diagonal of the box around links and contact elements at the start) where "
     "that is set; or the robot slides down its ground faster and faster: gravity does more work along the ground than the "
     "motors",
     "below a hundredth of the robot's extent (without periods: a tenth), with as little turning", kWindow, "limits.progress",
     "limits.progress, if standing still must be a failure", checks::progress, true},
    {"upright", Group::run, "rad", "Stays upright",
     "largest tilt from the start, of the base or of the mean of all links by mass, whichever is less, at control ticks",
     "the axes that pointed upwards, of the base and of that mean, point below the horizontal, except for a base that rolls",
     "above limits.tilt", kWhole, "limits.tilt", "a gait with more support", checks::upright},
    {"voltage", Group::motor, "", "Voltage suffices", "share of the window at the limit of the voltage, over all steps",
     "above limits.saturated_share, or a stretch of more than limits.saturated_periods control periods", "any", kWindow,
     "actuator.u_max", kGentler, checks::voltage},
    {"current", Group::motor, "", "Current suffices",
     "share of the window at the limit of the current (of other actuators: of their limit), over all steps",
     "above limits.saturated_share, or a stretch of more than limits.saturated_periods control periods", "any", kWindow,
     "actuator.i_max", kGentler, checks::current},
    {"envelope", Group::motor, "", "Torque within reach",
     "largest torque over the largest torque of the actuator at that speed in that direction, over all steps", "",
     "above limits.warn_share", kWindow, "actuator", kGentler, checks::envelope},
    {"speed", Group::motor, "rad/s", "Speed within reach",
     "largest speed, over all steps: in the window against the speed at which the actuator has no torque left, in the whole "
     "run against the rated one",
     "above that speed", "above limits.warn_share of it", kWindow, "actuator.speed_max", kGentler, checks::speed},
    {"stall", Group::motor, "N m", "Motors hold at rest",
     "torque of a joint while it turns at less than 5 % of its no-load speed, RMS over all this time and over any 0.1 s on "
     "end, against the stall torque at the supply",
     "above that stall torque, if the law of the motor allows it", "RMS over all this time above half of it", kWindow,
     "actuator.stall_torque",
     "a pose with less load, or a stronger motor; with efficiency_model: directional friction of the gear helps to hold",
     checks::stall},
    {"heat", Group::motor, "A", "Motors stay cool", "RMS current in the window against the continuous rating, over all steps",
     "above actuator.i_continuous", "above limits.warn_share of it", kWindow, "actuator.i_continuous", kGentler, checks::heat,
     false, false, true},
    {"gear_peak", Group::motor, "N m", "Gears bear the peaks",
     "largest torque that the gear passes on in the whole run (that of the motor less what turns its rotor) against its rating",
     "above actuator.gear_torque_peak", "above limits.warn_share of it", kWhole, "actuator.gear_torque_peak",
     "a softer start or landing, or another gear", checks::gear_peak, false, false, true},
    {"gear_continuous", Group::motor, "N m", "Gears last",
     "RMS torque in the window against the rating of the gear, over all steps", "above actuator.gear_torque_continuous",
     "above limits.warn_share of it", kWindow, "actuator.gear_torque_continuous", kGentler, checks::gear_continuous, false,
     false, true},
    {"tracking", Group::motion, "rad", "Joints follow their set points",
     "largest |set point - angle| in the window, over all steps", "above twice limits.tracking_error",
     "above limits.tracking_error", kWindow, "controller", "larger gains, or a slower gait", checks::tracking},
    {"stops", Group::motion, "rad", "Joints keep their ranges",
     "largest excess over the range of the hinge, of the whole run, over all steps",
     "above limits.beyond_range, or for more than limits.beyond_range_share of the time; of a hinge without a motor, which is "
     "meant to touch its stop, above 0.05 rad (2.5 N m of the stop), or limits.beyond_range if that is more",
     "any, of joints with a motor", kWhole, "cpg", kSmaller, checks::stops},
    {"setpoints", Group::motion, "", "Set points keep the ranges",
     "largest share of the time that a set point is beyond the range of its hinge, over all steps", "", "any", kWhole, "cpg",
     kSmaller, checks::setpoints},
    {"start", Group::motion, "rad", "Starts at its set points", "largest jump of a set point at t = 0", "",
     "above limits.start_jump", kWhole, "cpg", "initial.angles", checks::start},
    {"collision", Group::structure, "m", "Bodies keep apart",
     "deepest overlap of two bodies, of bodies of one module the part beyond 1.41 times their overlap with all hinges at 0; "
     "pairs of may_overlap are left out; in the whole run, at control ticks",
     "above limits.collision", "above limits.touch", kWhole, "robot",
     "smaller amplitudes or offsets, or may_overlap for bodies whose shapes are rougher than the real ones", checks::collision},
    {"dock_tension", Group::structure, "N", "Docks are not pulled apart",
     "largest tension of a dock against its rating, of the whole run, at control ticks", "above what the dock holds",
     "above limits.warn_share of it", kWhole, "robot", "a softer landing, or stronger connectors", dock<DockQuantity::tension>,
     false, true, true},
    {"dock_shear", Group::structure, "N", "Docks do not shear",
     "largest shear force of a dock against its rating, of the whole run, at control ticks", "above what the dock holds",
     "above limits.warn_share of it", kWhole, "robot", "a softer landing, or stronger connectors", dock<DockQuantity::shear>,
     false, true, true},
    {"dock_bending", Group::structure, "N m", "Docks are not bent open",
     "largest bending moment of a dock against its rating, of the whole run, at control ticks", "above what the dock holds",
     "above limits.warn_share of it", kWhole, "robot", "fewer modules in the air at a time, or stronger connectors",
     dock<DockQuantity::bending>, false, true, true},
    {"dock_torsion", Group::structure, "N m", "Docks are not twisted",
     "largest torsion moment of a dock against its rating, of the whole run, at control ticks", "above what the dock holds",
     "above limits.warn_share of it", kWhole, "robot", "fewer modules in the air at a time, or stronger connectors",
     dock<DockQuantity::torsion>, false, true, true},
    {"in_ground", Group::ground, "m", "Bodies stay above the ground",
     "depth of a body in the ground, of the whole run, at control ticks", "above limits.sink", "", kWhole, "contact.on",
     "contact.on: all, or a larger contact.stiffness", checks::in_ground},
    {"slip", Group::ground, "", "Feet hold",
     "slip distance of the loaded feet over the distance of the centre of mass, both at control ticks", "", "above limits.slip",
     kWindow, "ground.friction", "feet that are lifted higher, or ground.friction", slip},
    {"airborne", Group::ground, "", "Keeps to the ground",
     "share of the window in which the ground carries less than 5 % of the weight", "", "any", kWindow, "cpg", "a slower gait",
     checks::airborne},
    {"stability", Group::ground, "m", "Stands on its feet",
     "least distance of the centre of mass to the edge of the support polygon, inside positive", "", "", kWindow, "cpg",
     "only a note: a dynamic gait may fall from foot to foot", stability, false, true},
    {"field", Group::ground, "s", "Stays on its field", "time when the centre of mass leaves the heightfield", "", "any",
     kWhole, "ground.heightfield", "a larger field or spacing", checks::field},
    {"periodic", Group::trust, "", "Repeats",
     "error of the limit cycle: difference of angles and set points from their values a period later", "",
     "2 % and more, of set points that repeat", kWindow, "duration", "a longer duration", checks::periodic},
    {"evidence", Group::trust, "s", "Long enough, borne and to be trusted",
     "judged time, the ground's share of the weight, and the errors of torques and energy", "", "", kWindow, "duration",
     "the check's text names the missing evidence", checks::evidence},
    {"torque_error", Group::trust, "", "Torques are accurate", "estimated error of a joint's torque over its peak", "",
     "above physics.accuracy (1 % with a given step); above limits.torque_error, at most 10 %, the verdict is not judged",
     kWhole, "physics.step", kShorter, checks::torque_error},
    {"predictable", Group::trust, "", "Motion is predictable",
     "change of a joint's torque, RMS over its peak, under gravity times 1 + 1e-6 (1 + 1e-9, if that suffices)", "",
     "above 1 %, or physics.accuracy; a check that some of four rollouts fail is then too close to its limit", kWhole,
     "physics.gravity", "several runs with other seeds or starts; no smaller step helps", checks::predictable},
    {"creep", Group::trust, "", "Feet that hold stay",
     "net displacement, weighted by load, of feet that slide below contact.slip_speed, where a real ground holds them, over "
     "that of the centre of mass",
     "", "above 2 %", kWindow, "contact.slip_speed", "a smaller contact.slip_speed", creep},
    {"ledger", Group::trust, "", "Energy adds up",
     "residual of the energy over the energy drawn (or stored, or for lifting the robot by 1 mm, if that is more)", "",
     "above limits.energy_residual; above 5 % the verdict is not judged", kWhole, "physics.step", kShorter, checks::ledger},
    {"created", Group::trust, "", "Gears create no energy",
     "energy that back-driven gears create (eq. 2) over the energy of check ledger", "", "above limits.energy_created", kWhole,
     "actuator", "actuator.efficiency_model: directional", checks::created},
    {"supply", Group::trust, "J", "Motors draw energy", "energy drawn from the supply", "", "below 0", kWhole, "actuator",
     "Kt, Ks and the efficiency of the motors", checks::supply, true},
    {"step", Group::trust, "", "Steps are short enough", "share of the control ticks at which h lambda exceeds 1", "",
     "above 1 %", kWhole, "physics.step", "a smaller physics.step", checks::step},
    {"coarse", Group::trust, "", "Steps reach the accuracy",
     "share of the time in which the shortest steps do not reach physics.accuracy", "",
     "above 10 %, and the verdict is not judged", kWhole, "physics.step", "damping, or bounds on the drive of the joints",
     checks::coarse},
    {"law", Group::trust, "", "Torques satisfy the law of their motor",
     "number of joint-steps that end off the law of their motor or stop", "", "any", kWhole, "physics.step",
     "an actuator whose torque falls with the speed", checks::law},
};

}  // namespace

std::span<const CheckKind> check_kinds() { return kChecks; }

}  // namespace gaitlab::report
