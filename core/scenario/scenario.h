// Scenario as a value: all settings of the user, validated, SI, defaults filled in. read_scenario.h reads it, resolved.h writes
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
#include "core/names.h"
#include "core/plugin/plugin_instance.h"
#include "core/settings/node.h"

namespace gaitlab {

struct Initial {
  PerJoint angles, speeds;                    ///< rad, rad/s
  Vec3 base_velocity = Vec3::Zero();          ///< of the base frame's origin, world axes, m/s
  Vec3 base_angular_velocity = Vec3::Zero();  ///< world axes, rad/s
  void fields(Fields& f);
};

/// Estimate of the torque error that the steps cause (core/simulation/step_error.h).
enum class Estimate { full, off };

template <>
struct EnumNames<Estimate> {
  using enum Estimate;
  static constexpr EnumName<Estimate> kTable[] = {{full, "full"}, {off, "off"}};
};

struct Physics {
  const Engine* engine = nullptr;
  double step = 0;             ///< s; with `adaptive_step` the longest that divides the control period
  bool adaptive_step = false;  ///< `step: auto`: the integrator divides each step as `accuracy` asks
  bool chosen_step = false;    ///< `step: auto`: the engine has chosen the step by its stability at the start
  double accuracy = 0.01;      ///< relative accuracy of the torques, for integrators that choose their steps
  Estimate estimate = Estimate::full;
  bool estimated_by_others =
      false;  ///< not a setting: a run of a study whose torque error is estimated from other points' runs
  const Integrator* integrator = nullptr;  ///< one of the engine's
  Vec3 gravity{0, 0, -9.81};               ///< m/s^2, world
  /// Whether the integrator chooses its steps by `accuracy`.
  [[nodiscard]] bool adapts() const { return integrator != nullptr && integrator->adapts; }
  /// Makes every step more accurate: divides the accuracy, or the step if it is given.
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

/// Joints and contents of figure.svg.
struct FigureSettings {
  std::vector<std::string> joints;  ///< names, from top to bottom; empty: chosen by the figure
  void fields(Fields& f);
};

/// Limits of the verdict on a run (report/verdict/verdict.h).
struct Limits {
  double warn_share = 0.8;           ///< share of a limit of motor, gear or dock
  double tracking_error = 0.1;       ///< rad
  double saturated_share = 0.01;     ///< share of the judged window
  double saturated_periods = 3;      ///< consecutive control periods
  double height = 0.5;               ///< share of the centre of mass's height at the start
  double tilt = 1.0471975511965976;  ///< rad
  double beyond_range = 0.01;        ///< rad
  double beyond_range_share = 0.01;  ///< share of time
  double start_jump = 0.05;          ///< rad
  double touch = 5e-4;               ///< m: bodies that overlap more collide
  double collision = 0.002;          ///< m
  double sink = 0.005;               ///< m
  double energy_residual = 0.01;     ///< share of the energy drawn, or stored, or of the least that counts
  double energy_created = 0.05;      ///< likewise
  double slip = 0.2;                 ///< share of the centre of mass's path
  double torque_error = 0.05;        ///< share of a joint's largest torque
  double progress = 0;               ///< share of the robot's extent, per period; 0: no requirement
  /// Depth from which on two bodies count as overlapping, m. A record may have a `touch` above `collision`.
  [[nodiscard]] double meeting() const { return touch < collision ? touch : collision; }
  bool operator==(const Limits&) const = default;
  void fields(Fields& f);
};

/// A line for stderr that is not a problem: settings that --set dropped, set-up of the CPG.
struct Note {
  SourceLocation place;
  std::string text;
  bool operator==(const Note&) const = default;
};

/// A plugin library that the scenario names.
struct PluginFile {
  std::string path;  ///< canonical
  std::string hash;  ///< FNV-1a of the file, 16 hex digits
};

struct Scenario {
  std::string file, name;
  std::vector<PluginFile> plugins;
  std::shared_ptr<const Robot> robot;
  /// Documents of the module types as read, one per entry of Robot::types (for the resolved scenario).
  std::shared_ptr<const std::vector<Node>> module_documents = std::make_shared<const std::vector<Node>>();
  Base base = Base::floating;
  bool on_ground = true;            ///< lowered onto the ground at x, y; false: at `position`
  Vec3 position = Vec3::Zero();     ///< of the base frame, m; z: 0 with on_ground
  Vec3 orientation = Vec3::Zero();  ///< roll pitch yaw, rad
  Initial initial;
  Physics physics;
  Ground ground;
  ContactSettings contact;
  PluginSelection actuator, controller, cpg;
  std::string actuator_source;    ///< origin of the values in the section `actuator`; empty: not stated
  double control_period = 0.015;  ///< s
  double cpg_step = 0;            ///< s, RK4 sub-step of the CPG
  double duration = 0;            ///< s
  TraceSettings trace;
  FigureSettings figure;
  Limits limits;
  std::int64_t seed = 1;
  std::vector<Note> notes;
  /// Place at which the user gave a key: `physics.step`, `trace.columns` ...; for a rollout of a template first its additional
  /// settings.
  using Places = std::map<std::string, SourceLocation>;
  Places own_places;
  std::shared_ptr<const Places> places = std::make_shared<const Places>();

  /// Place of `key` for errors found later, or else the file.
  [[nodiscard]] SourceLocation place(const std::string& key) const {
    for (const Places* known : {&own_places, places.get()}) {
      if (const auto at = known->find(key); at != known->end()) return at->second;
    }
    return SourceLocation{file};
  }
  /// The same, with the key's section tried before the file.
  [[nodiscard]] SourceLocation nearest_place(const std::string& key) const {
    const SourceLocation exact = place(key);
    return exact.line > 0 || exact.file != file ? exact : place(key.substr(0, key.find('.')));
  }
};

}  // namespace gaitlab
