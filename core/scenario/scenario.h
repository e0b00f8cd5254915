// Scenario with all settings, validated, in SI units and with defaults. read_scenario.h reads a scenario, and resolved.h writes
// it.
#pragma once
#include <cstdint>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "core/laws/contact.h"
#include "core/laws/contact_model.h"
#include "core/laws/ground.h"
#include "core/model/robot.h"
#include "core/model/supply.h"
#include "core/names.h"
#include "core/plugin/plugin_instance.h"
#include "core/robot_files/identification.h"
#include "core/scenario/as_built.h"
#include "core/scenario/measured_section.h"
#include "core/settings/joint_patterns.h"
#include "core/settings/node.h"

namespace gaitlab {

struct Initial {
  PerJoint angles, speeds;                    ///< rad, rad/s
  bool stated = false;                        ///< true if the scenario states the angles; else they follow from the CPG
  Vec3 base_velocity = Vec3::Zero();          ///< velocity of the base frame's origin, world axes, m/s
  Vec3 base_angular_velocity = Vec3::Zero();  ///< angular velocity of the base, world axes, rad/s
  /// True if the angles follow from the CPG and are not 0.
  [[nodiscard]] bool follows() const { return !stated && !(angles == PerJoint{}); }
  void fields(Fields& f);
  void motion(Fields& f);  ///< all keys except `angles`
};

/// Extent of the estimate of the torque error that the steps cause (core/simulation/step_error.h).
enum class Estimate { full, off };

template <>
struct EnumNames<Estimate> {
  using enum Estimate;
  static constexpr EnumName<Estimate> kTable[] = {{full, "full"}, {off, "off"}};
};

struct Physics {
  const Engine* engine = nullptr;
  double step = 0;             ///< s; with `adaptive_step` the longest step that divides the control period
  bool adaptive_step = false;  ///< true for `step: auto` if the integrator divides each step according to `accuracy`
  bool chosen_step = false;    ///< true for `step: auto` if the engine has chosen the step by its stability at the start
  double accuracy = 0.01;      ///< relative accuracy of the torques, for integrators that choose their steps
  Estimate estimate = Estimate::full;
  bool estimated_by_others =
      false;  ///< true for a run of a study whose torque error is estimated from runs of other points; not a setting
  const Integrator* integrator = nullptr;  ///< an integrator of `engine`
  Vec3 gravity{0, 0, -9.81};               ///< gravity in world axes, m/s^2
  /// True if the integrator chooses its steps by `accuracy`.
  [[nodiscard]] bool adapts() const { return integrator != nullptr && integrator->adapts; }
  /// Makes every step more accurate: divides the accuracy by `by`, or else the given step.
  void refine(double by) { (adapts() ? accuracy : step) /= by; }
};

struct ContactSettings {
  ContactLaw law = ContactLaw::penalty;
  ContactSet on = ContactSet::feet;
  PenaltyContact penalty;
  [[nodiscard]] const ContactModel& model() const { return enum_row(law); }
  void fields(Fields& f);
};

struct TraceSettings {
  double period = 0.005;  ///< s
  std::vector<std::string> columns{"joint.*", "base.*", "com.*"};
  void fields(Fields& f);
};

/// Joints that figure.svg draws.
struct FigureSettings {
  std::vector<std::string> joints;  ///< joint names from top to bottom; empty if the figure chooses the joints
  void fields(Fields& f);
};

/// Limits of the verdict on a run (report/verdict/verdict.h).
struct Limits {
  double warn_share = 0.8;           ///< share of a limit of motor, gear or dock; the verdict warns above it
  double tracking_error = 0.1;       ///< largest difference of set point and angle, rad
  double saturated_share = 0.01;     ///< largest share of the judged window at a motor's limit
  double saturated_periods = 3;      ///< longest time at a motor's limit, in control periods
  double height = 0.5;               ///< least height of the centre of mass, as a share of its initial height
  double tilt = 1.0471975511965976;  ///< largest tilt of the base from its start, rad
  double beyond_range = 0.01;        ///< largest angle by which a joint may exceed its range, rad
  double beyond_range_share = 0.01;  ///< largest share of the time in which a joint may be beyond its range
  double start_jump = 0.05;          ///< largest jump of a set point at t = 0, rad
  double touch = 5e-4;               ///< overlap of two bodies above which the verdict warns, m
  double collision = 0.002;          ///< largest overlap of two bodies, m
  double sink = 0.005;               ///< largest depth of a body in the ground, m
  /// Largest residual, as a share of the largest of energy drawn, energy stored and energy to lift the robot by 1 mm.
  double energy_residual = 0.01;
  /// Largest energy that back-driven gears create, as a share of the largest of the energies in `energy_residual`.
  double energy_created = 0.05;
  double slip = 0.2;           ///< largest slip distance of the feet, as a share of the path of the centre of mass
  double torque_error = 0.05;  ///< largest estimated torque error, as a share of a joint's largest torque
  double progress = 0;         ///< least travel per period, as a share of the robot's extent; 0 means no requirement
  /// Depth above which two bodies count as overlapping, m. A recorded scenario may have a `touch` above `collision`.
  [[nodiscard]] double meeting() const { return touch < collision ? touch : collision; }
  /// Largest torque error of a run that is judged: `torque_error`, but at most kMostTorqueError, because a larger error leaves
  /// torques and motion unknown.
  [[nodiscard]] double most_torque_error() const { return torque_error < kMostTorqueError ? torque_error : kMostTorqueError; }
  static constexpr double kMostTorqueError = 0.1;
  bool operator==(const Limits&) const = default;
  void fields(Fields& f);
};

/// Rows of the list of plausible numbers (report/verdict/plausible/plausible_number.h) in which a user may accept a number that
/// no robot can have.
inline constexpr const char* kAcceptable[] = {"density", "moments", "stall torque", "power"};

/// A message for stderr that is not a problem, such as settings that --set dropped, or the set-up of the CPG.
struct Note {
  SourceLocation place;
  std::string text;
  bool operator==(const Note&) const = default;
};

/// A plugin library that the scenario names.
struct PluginFile {
  std::string path;  ///< canonical path
  std::string hash;  ///< FNV-1a hash of the file, 16 hex digits
};

/// A sensor, with its name.
struct SensorSelection {
  std::string name;
  PluginSelection plugin;
};

/// Fault of a joint (docs/real-robot.md). The column `joint.J.fault` has the numbers of the enum.
enum class FaultKind { none, dead, open, stuck, weak, lost, late };

template <>
struct EnumNames<FaultKind> {
  using enum FaultKind;
  static constexpr EnumName<FaultKind> kTable[] = {{none, "none"}, {dead, "dead"}, {open, "open"}, {stuck, "stuck"},
                                                   {weak, "weak"}, {lost, "lost"}, {late, "late"}};
};

/// A fault, and the joints that get it.
struct JointFault {
  std::vector<std::string> joints;  ///< names or patterns
  FaultKind kind = FaultKind::none;
  double share = 0;  ///< weak: share of the torque that is left; lost: share of the set points that are lost
  double delay = 0;  ///< late: s
};

/// A change at a given time of the run: new settings, faults of joints, or both. The change takes effect at the first control
/// tick at `t` or later.
struct Change {
  double t = 0;                     ///< s
  Node set = {Node::Kind::map};     ///< settings by key, such as `cpg.frequency`
  PluginSelection cpg, controller;  ///< with the settings of this change and of all before it
  std::vector<JointFault> faults;
};

struct Scenario {
  std::string file, name;
  std::vector<PluginFile> plugins;
  std::shared_ptr<const Robot> robot;  ///< as built
  std::vector<BodyPair> may_overlap;   ///< bodies of the robot that are not compared for collisions
  JointGroups groups;                  ///< joints by the names of section `groups`
  Tolerances tolerances;
  AsBuilt as_built;       ///< differences of the robot from the drawings, stated and drawn
  std::size_t drawn = 0;  ///< count of numbers in as_built that were drawn; not a setting
  /// Documents of the module types as read from files, one per entry of Robot::types. The resolved scenario contains them.
  std::shared_ptr<const std::vector<Node>> module_documents = std::make_shared<const std::vector<Node>>();
  Base base = Base::floating;
  bool on_ground = true;            ///< true if the robot is lowered onto the ground at x, y; false if it is at `position`
  Vec3 position = Vec3::Zero();     ///< position of the base frame, m; z is 0 with on_ground
  Vec3 orientation = Vec3::Zero();  ///< roll, pitch and yaw of the base frame, rad
  Initial initial;
  Physics physics;
  Ground ground;
  ContactSettings contact;
  PluginSelection actuator, controller, cpg;
  Supply supply;  ///< battery of all motors that have none of their own (docs/equations.md, 3); voltage 0 without one
  std::vector<Battery> batteries;  ///< by module, of its motors; voltage 0 without one; empty if no module has one
  MeasuredSettings measured;       ///< log of the real robot
  std::vector<double> duty_volts;  ///< voltage of duty 1 by joint, if it is not that of the supply or the motors; not a setting
  std::string actuator_source;     ///< origin of the values in the section `actuator`; empty if not stated
  Identification identified;       ///< logs of the motors of that section
  double control_period = 0.015;   ///< s
  double cpg_step = 0;             ///< sub-step of the CPG's RK4 integration, s
  double duration = 0;             ///< s
  TraceSettings trace;
  FigureSettings figure;
  Limits limits;
  std::vector<std::string> accept;  ///< rows of the list of plausible numbers (kAcceptable) whose numbers the user has checked
  std::vector<SensorSelection> sensors;
  std::vector<Change> changes;  ///< section `at`, in the order of time
  std::int64_t seed = 1;
  std::vector<Note> notes;
  /// Place at which the user gave a key, such as `physics.step` or `trace.columns`. If this is a rollout of a template,
  /// `own_places` contains the places of its additional settings.
  using Places = std::map<std::string, SourceLocation>;
  Places own_places;
  std::shared_ptr<const Places> places = std::make_shared<const Places>();

  /// Place of `key` for errors that are found later. If the user did not give the key, the place is the file.
  [[nodiscard]] SourceLocation place(const std::string& key) const {
    for (const Places* known : {&own_places, places.get()}) {
      if (const auto at = known->find(key); at != known->end()) return at->second;
    }
    return SourceLocation{file};
  }
  /// Place of `key`, or else of its section, or else the file.
  [[nodiscard]] SourceLocation nearest_place(const std::string& key) const {
    const SourceLocation exact = place(key);
    return exact.line > 0 || exact.file != file ? exact : place(key.substr(0, key.find('.')));
  }
};

}  // namespace gaitlab
