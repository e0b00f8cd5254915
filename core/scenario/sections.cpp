#include "core/scenario/sections.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <limits>

#include "core/plugin/plugin_instance.h"
#include "core/settings/overlay.h"
#include "core/settings/wording.h"

namespace gaitlab {
namespace {

constexpr const char* kNone = "none";
constexpr const char* kDefaultEngine = "bullet";

/// Names as texts, and as pointers to these for Fields::one_of, which are valid as long as this object.
struct Names {
  std::vector<std::string> texts;
  std::vector<const char*> pointers;

  explicit Names(std::vector<std::string> names) : texts(std::move(names)) {
    for (const std::string& text : texts) pointers.push_back(text.c_str());
  }
  [[nodiscard]] bool has(const std::string& name) const { return std::find(texts.begin(), texts.end(), name) != texts.end(); }
};

std::size_t count(const Problems* problems) { return problems == nullptr ? 0 : problems->size(); }

}  // namespace

void BaseFields::fields(Fields& f) {
  f.choice("base", scenario.base, enum_names<Base>(), "floating; fixed; planar: world x, world z and rotation about world y.");
  f.flag("on_ground", scenario.on_ground,
         "Lower the robot onto the ground until its first contact element touches; false if `position` has a "
         "height.");
  if (with_position) {
    std::vector<double> position{scenario.position.x(), scenario.position.y()};
    if (!scenario.on_ground) position.push_back(scenario.position.z());
    f.numbers("position", position,
              {"m", -1e6, 1e6,
               "Start of the base frame's origin, world: [x, y] with the height from on_ground, or [x, y, z], which turns "
               "on_ground off."});
    numbers = position.size();
    if (numbers == 2 || numbers == 3) {
      scenario.position = {position[0], position[1], numbers == 3 ? position[2] : 0};
    } else {
      f.problem("position", fmt::format("position has {} number{}; expected [x, y] (on_ground gives the height) or [x, y, z] "
                                        "(on_ground is off)",
                                        numbers, numbers == 1 ? "" : "s"));
    }
  }
  f.vector("orientation", span_of(scenario.orientation), {"rad", -100, 100, "Start of the base frame: roll, pitch, yaw."});
}

void Initial::fields(Fields& f) {
  f.per_joint("angles", angles,
              {"rad", -1000, 1000,
               "Joint angles, within each hinge's range. Default: 0; with a CPG that has a ramp, its first set points."});
  motion(f);
}

void Initial::motion(Fields& f) {
  f.per_joint("speeds", speeds, {"rad/s", -1e4, 1e4, "Joint speeds."});
  f.vector("base_velocity", span_of(base_velocity), {"m/s", -1e4, 1e4, "Velocity of the base frame's origin, world axes."});
  f.vector("base_angular_velocity", span_of(base_angular_velocity),
           {"rad/s", -1e4, 1e4, "Angular velocity of the base, world axes."});
}

void PhysicsFields::fields(Fields& f) {
  const Names names(catalog != nullptr ? catalog->engines() : std::vector<std::string>{physics.engine->name});
  std::string name = physics.engine != nullptr ? physics.engine->name : kDefaultEngine;
  const std::size_t before = count(problems);
  f.one_of("engine", name, names.pointers, "Physics engine; its manual: gaitlab explain engine NAME.");
  const bool known = count(problems) == before && names.has(name);
  if (names.texts.empty()) {
    f.problem("engine", "no physics engine is built in");
  } else if (!names.has(name) && count(problems) == before) {  // not replaced by another engine, which would give other numbers
    f.problem("engine",
              fmt::format("this program was built without the default engine '{0}'; write physics: {{engine: {1}}}, or "
                          "add --set physics.engine={1}",
                          kDefaultEngine, names.texts.front()));
  }
  if (known && catalog != nullptr) physics.engine = catalog->engine(name);
  const bool filled = physics.step > 0;
  double step = physics.adaptive_step ? 0 : physics.step;
  const bool own_step = enum_row(law).has_step_of_its_own;
  const bool chooses = known && !own_step && physics.engine->choose_step != nullptr;
  if (known && !filled && !chooses && (own_step || physics.engine->adaptive() == nullptr)) {
    step = physics.engine->given_step(own_step);
  }
  f.number_or(
      "step", step, "auto",
      {"s", 1e-9, 1,
       "Time step; the default depends on engine, integrator and contact law. auto: chosen by accuracy (integrator "
       "adaptive), or by the stability limit at the start (semi_implicit, rk4). gaitlab converge shows the error of a step."});
  if (known) {
    const Engine& engine = *physics.engine;
    const bool stated = filled && physics.integrator != nullptr;
    const Integrator& preset = stated                 ? *physics.integrator
                               : step > 0 || own_step ? engine.fixed()
                                                      : engine.integrators.front();
    const Names integrators(engine.integrator_names());
    std::string integrator = preset.name;
    f.one_of("integrator", integrator, integrators.pointers, "Integrator of the engine.");
    physics.integrator = engine.integrator(integrator);
    physics.adaptive_step = step <= 0 && physics.adapts();
    physics.chosen_step = step <= 0 && chooses && physics.integrator != nullptr && physics.integrator->limited;
    if (step > 0 || !physics.adapts()) physics.step = step > 0 ? step : engine.step;
    if (physics.adapts() || catalog != nullptr) {  // read always, but written only if it has an effect
      f.number(
          "accuracy", physics.accuracy,
          {"", 1e-6, 0.5,
           "Accuracy of the motor torques, relative to a joint's largest torque so far (at least 1 % of its motor's torque "
           "at rest). The integrator adaptive divides its steps until the torques are that accurate."});
    }
  } else {
    std::string any;  // the set of names depends on the engine
    f.text("integrator", any, "");
  }
  f.vector("gravity", span_of(physics.gravity), {"m/s^2", -1000, 1000, "Acceleration of gravity, world axes."});
  if (catalog == nullptr && physics.estimate == Estimate::full) return;
  f.choice("estimate", physics.estimate, enum_names<Estimate>(),
           "Estimate of the torque error. full: from additional rollouts, with finer and coarser steps and with gravity times "
           "1 + 1e-9, which add a quarter to the run time in engine articulated and once to twice the run time in engine "
           "bullet (a tenth if the step is given: only windows of a rollout have other "
           "steps). off: no estimate; the run is bit-identical, but the verdict lacks evidence.");
}

void ContactSettings::fields(Fields& f) {
  f.choice("law", law, enum_names<ContactLaw>(),
           "penalty: Fn = Kn p^k + Cd p^d p' >= 0; friction -f Fn v/v_lim up to v_lim, then -f Fn v/|v|. bullet: Bullet's own "
           "solver, for comparison and clutter; it uses only the key `on`.");
  f.choice("on", on, enum_names<ContactSet>(),
           "Contact elements that touch the ground: feet of the free blocks, all, or none.");
  if (!model().penalty_settings) return;
  f.number(
      "stiffness", penalty.kn,
      {"N/m^k", kPositive, 1e12, "Kn of the spring. On stiffer ground the robot sinks in less, and steps must be shorter."});
  f.number("exponent", penalty.k, {"", 1, 10, "k: exponent of the depth in the spring's force."});
  f.number("damping", penalty.cd, {"N s/m^(d+1)", 0, 1e12, "Cd of the damper."});
  f.number("damping_exponent", penalty.d, {"", 0, 10, "d: exponent of the depth in the damper's force."});
  f.number("slip_speed", penalty.v_lim,
           {"m/s", kPositive, 1000,
            "v_lim, below which friction is viscous. With a smaller v_lim feet creep less, and steps must be shorter."});
}

void PluginFields::choose(Fields& f) {
  const std::size_t before = count(problems);
  std::vector<std::string> known;
  if (catalog != nullptr) {
    known = catalog->names(kind);
  } else if (choice.entry != nullptr) {
    known.emplace_back(choice.entry->name);
  }
  if (describe(kind).may_be_none) known.emplace_back(kNone);
  const Names names(std::move(known));
  std::string name = choice.entry != nullptr ? std::string(choice.entry->name) : type;
  f.one_of("type", name, names.pointers, describe(kind).about_type);
  if (!names.has(name)) {
    if (count(problems) > before) return;  // the given type is unknown
    f.problem("type",
              "type is missing, and the default " + in_quotes(type) + " is not registered" + offer(type, names.texts, "names"));
    return;
  }
  none = describe(kind).may_be_none && name == kNone;
  if (none || catalog == nullptr) return;
  choice.entry = catalog->find(kind, name);
  choice.settings = default_settings(*choice.entry);
  if (presets) presets(*choice.entry, choice.settings.get());
}

void PluginFields::fields(Fields& f) {
  const std::size_t before = count(problems);
  try {
    choose(f);
    if (host && !none) host(f);
    sound = count(problems) == before;
    if (sound && choice.entry != nullptr && own_keys) visit_settings(*choice.entry, choice.settings.get(), f);
  } catch (const PluginError& error) {
    if (problems == nullptr) throw;  // otherwise the error would be lost
    f.problem("type", error.what());
  }
  sound = count(problems) == before;
}

void TraceSettings::fields(Fields& f) {
  f.number("period", period, {"s", 1e-9, 1e6, "Time between rows; a whole multiple of the step if one is given."});
  f.texts("columns", columns, "Names or patterns with * and ? of the columns to keep.");
}

void FigureSettings::fields(Fields& f) {
  f.texts("joints", joints,
          "Names of the joints to draw, or patterns with * and ?, from top to bottom; none: the most loaded joint and, for a "
          "robot on legs, the middle of its spine.");
}

void Limits::fields(Fields& f) {
  f.number("warn_share", warn_share,
           {"", 0, 1,
            "Share of the limits of motors, gears and docks (torque at that speed, ratings) above which the verdict warns. "
            "Default: our choice."});
  f.number("tracking_error", tracking_error,
           {"rad", kPositive, 1000,
            "Largest allowed difference of set point and angle; up to twice this difference is a warning, a larger one a "
            "failure. Default: the axis range in figure 14 of the paper."});
  f.number(
      "saturated_share", saturated_share,
      {"", 0, 1,
       "Share of the judged window that a joint may be at a limit of its motor; a smaller share is a warning, a larger one a "
       "failure. Default: chosen."});
  f.number(
      "saturated_periods", saturated_periods,
      {"", 0, 1e6,
       "Longest stretch at the limit, in control periods; a longer one is a failure. Default: our choice; a step of the set "
       "point takes one or two."});
  f.number("height", height,
           {"", 0, 1,
            "Height of the centre of mass below which the robot has fallen, as a share of the lower of two heights: in the "
            "start pose, on the ground, and in the pose of the set points. Default: our choice."});
  f.number("tilt", tilt,
           {"rad", kPositive, 4,
            "Largest allowed tilt of the robot from its orientation at the start; a larger one is a warning, one beyond the "
            "horizontal a failure, unless the base rolls. Default: 60 degrees, our choice."});
  f.number(
      "beyond_range", beyond_range,
      {"rad", 0, 100,
       "Largest angle of a joint beyond its range; a smaller angle is a warning. Default: our choice, the deflection of a soft "
       "stop."});
  f.number("beyond_range_share", beyond_range_share,
           {"", 0, 1,
            "Share of the time that a joint may be beyond its range; a smaller share is a warning. Default: our "
            "choice."});
  f.number("start_jump", start_jump,
           {"rad", 0, 100,
            "Jump of a set point at t = 0 above which there is a warning. Default: half of the axis range in figure 14 of the "
            "paper."});
  f.number(
      "touch", touch,
      {"m", 0, 10,
       "Overlap of two bodies above which there is a warning. The default covers the error of cylinders (computed as prisms) "
       "and the deflection of a hinge's stop."});
  f.number("collision", collision,
           {"m", 0, 10,
            "Largest overlap of two bodies; a smaller one is a warning, a larger one a failure. Default: our "
            "choice."});
  f.number("sink", sink,
           {"m", 0, 10, "Largest depth of a body in the ground. The default covers the compression of the ground."});
  f.number(
      "energy_residual", energy_residual,
      {"", 0, 1,
       "Share of the energy drawn that may be unaccounted for without a warning; above 5 % a run is not judged. Default: the "
       "torque error of an accurate run."});
  f.number(
      "energy_created", energy_created,
      {"", 0, 1, "Largest energy created by back-driven gears (eq. 2), as a share of the energy drawn. Default: our choice."});
  f.number("slip", slip,
           {"", 0, 1e6,
            "Largest slip distance of the feet, weighted by their loads, as a share of the robot's path; a larger distance is "
            "a warning. Default: our choice."});
  f.number(
      "torque_error", torque_error,
      {"", kPositive, 1,
       "Estimated error of a joint's torque, as a share of its largest torque, above which a run is not judged. Values above "
       "0.1 count as 0.1, because with a larger error neither torques nor motion are known. Default: chosen."});
  f.number("progress", progress,
           {"", 0, 1000,
            "Least travel per period, as a share of the robot's extent; a smaller travel is a failure. With the default, 0, a "
            "travel below a hundredth is a warning."});
}

SectionFields::SectionFields(Scenario& s, const Catalog* catalog, const Problems* problems, const std::string& actuator_type)
    : scenario(s),
      physics{s.physics, catalog, problems},
      actuator{Kind::actuator, s.actuator, actuator_type, catalog},
      controller{Kind::controller, s.controller, describe(Kind::controller).default_type, catalog},
      cpg{Kind::cpg, s.cpg, describe(Kind::cpg).default_type, catalog} {
  actuator.problems = controller.problems = cpg.problems = problems;
  // The key is replaced by the keys of the servo file before the section is read (core/robot_files/servo_file.h).
  const auto model = [this](Fields& f) {
    std::string name;
    if (!writing)
      f.text("model", name, "Name of a servo (gaitlab list servo), whose keys stand for those that are not stated.");
    if (!name.empty()) f.problem("model", "a servo cannot change within a run; expected the keys that change");
  };
  actuator.host = [this, model, &s](Fields& f) {
    model(f);
    if (!writing || !s.actuator_source.empty()) {
      f.text("source", s.actuator_source,
             "Source of the values that this section gives instead of the module types', such as a data sheet; the verdict "
             "cites it. Without a source they count as chosen.");
    }
    if (!writing || s.identified.any())
      f.group(kIdentified, s.identified, "Logs to which these values were fitted; a servo file states them.");
  };
  controller.host = [model, &s](Fields& f) {
    model(f);
    f.number("period", s.control_period,
             {"s", 1e-9, 1000, "Time between commands; a whole multiple of the step if one is given."});
  };
  cpg.host = [&s](Fields& f) {
    if (s.cpg_step <= 0) s.cpg_step = s.control_period;
    f.number("step", s.cpg_step, {"s", 1e-9, 1000, "RK4 sub-step of the CPG's states; default: the control period."});
  };
}

/// The keys of `initial` without the angles.
struct MotionAtStart {
  Initial& initial;
  void fields(Fields& f) const { initial.motion(f); }
};

void SectionFields::fields(Fields& f) {
  GroundFields ground{scenario.ground, writing};
  if (!writing || scenario.tolerances.any()) {
    f.group(kTolerancesSection, scenario.tolerances,
            "Deviations of real robots from the drawings; each seed draws another robot.");
  }
  if (!writing || scenario.as_built.any() || scenario.tolerances.any()) {  // a stated number is not drawn
    f.group(kAsBuiltSection, scenario.as_built,
            "Differences of this robot from the drawings, by part, such as mass: {m3: 1.05}. Numbers that are not stated here "
            "are drawn within the tolerances.");
  }
  MotionAtStart motion{scenario.initial};
  if (writing && scenario.initial.follows()) {  // angles that follow from the gait follow again when the text is read
    f.group("initial", motion, "State at the start.");
  } else {
    f.group("initial", scenario.initial, "State at the start.");
  }
  f.group("physics", physics, "Engine and time integration.");
  f.group("ground", ground, "The ground.");
  f.group("contact", scenario.contact, "Contact of the robot with the ground.");
  const auto group = [&f](PluginFields& section) {
    const PluginKind& kind = describe(section.kind);
    f.group(kind.section, section, kind.about);
  };
  group(actuator);
  if (!writing || scenario.supply.any())
    f.group(kSupplySection, scenario.supply, "Battery or power supply of all motors whose module types have no battery.");
  if (!actuator.none) group(controller);
  if (has_cpg) group(cpg);
  f.number("duration", scenario.duration, {"s", kPositive, 1e6, "Simulated time; required."});
  scenario.measured.brief = writing;
  if (!writing || scenario.measured.any())
    f.group(kMeasuredSection, scenario.measured, "Log of the real robot, with which the run is compared.");
  f.group("trace", scenario.trace, "The recorded trace.");
  if (!writing || scenario.limits != Limits()) f.group("limits", scenario.limits, "Limits of the verdict.");
  if (!writing || !scenario.accept.empty()) {
    f.words("accept", scenario.accept, kAcceptable,
            "Numbers that look implausible but are right. Without a row here, a run with impossible numbers is not judged.");
  }
  if (!writing || !scenario.figure.joints.empty()) f.group("figure", scenario.figure, "Content of figure.svg.");
  f.integer("seed", scenario.seed,
            {"", 0, 9e18,
             "Seed of all draws: the robot within its tolerances; noise, zeros, delays and losses of its sensors; lost set "
             "points (`at`)."});
}

std::vector<std::string> joint_names(const Robot& robot) {
  std::vector<std::string> names;
  for (const Joint& joint : robot.joints) names.push_back(joint.name);
  return names;
}

std::vector<std::string> body_names(const Robot& robot) {
  std::vector<std::string> names;
  for (const Body& body : robot.bodies) names.push_back(body.name);
  return names;
}

}  // namespace gaitlab
