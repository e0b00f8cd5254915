// Everything the user said, validated, SI, defaults filled in: the value. It is read by read_scenario.h, written out by
// resolved.h.
#pragma once
#include <cstdint>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "core/laws/contact.h"
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

/// The estimate of what a run's steps cost in torque (core/simulation/step_error.h).
enum class Estimate { full, off };

template <>
struct EnumNames<Estimate> {
  using enum Estimate;
  static constexpr EnumName<Estimate> kTable[] = {{full, "full"}, {off, "off"}};
};

struct Physics {
  const Engine* engine = nullptr;
  double step = 0;             ///< s; with `adaptive_step` the longest that the control period allows
  bool adaptive_step = false;  ///< `step: auto`: the integrator divides each step as `accuracy` asks
  double accuracy = 0.01;      ///< of the torques, relative; of integrators that choose their steps
  Estimate estimate = Estimate::full;
  bool estimated_by_others = false;        ///< no setting: a run of a study, whose estimates of other points count for this one
  const Integrator* integrator = nullptr;  ///< of the engine's
  Vec3 gravity{0, 0, -9.81};               ///< m/s^2, world
  /// Whether the integrator chooses its steps by `accuracy`.
  [[nodiscard]] bool adapts() const { return integrator != nullptr && integrator->adapts; }
  /// Makes every step more accurate: the accuracy, or where it does not choose the step, is divided.
  void refine(double by) { (adapts() ? accuracy : step) /= by; }
};

enum class ContactLaw { penalty, solver };  ///< forces of penetration and velocity, or constraints of the engine's own solver

template <>
struct EnumNames<ContactLaw> {
  using enum ContactLaw;
  static constexpr EnumName<ContactLaw> kTable[] = {{penalty, "penalty"}, {solver, "bullet"}};
};

struct ContactSettings {
  ContactLaw law = ContactLaw::penalty;
  ContactSet on = ContactSet::feet;
  PenaltyContact penalty;
  [[nodiscard]] bool solver() const { return law == ContactLaw::solver; }
  [[nodiscard]] bool moves_boxes() const { return solver(); }  ///< whether the law knows boxes that have a mass
  void fields(Fields& f);
};

struct TraceSettings {
  double period = 0.005;  ///< s
  std::vector<std::string> columns{"joint.*", "base.*", "com.*"};
  void fields(Fields& f);
};

/// What figure.svg shows.
struct FigureSettings {
  std::vector<std::string> joints;  ///< names, from top to bottom; none: what the figure chooses
  void fields(Fields& f);
};

/// What the verdict on a run allows (report/verdict/verdict.h).
struct Limits {
  double warn_share = 0.8;           ///< of what a motor, gear or dock has
  double tracking_error = 0.1;       ///< rad
  double saturated_share = 0.01;     ///< of the judged window
  double saturated_periods = 3;      ///< control periods on end
  double height = 0.5;               ///< of the centre of mass, of that at the start
  double tilt = 1.0471975511965976;  ///< rad
  double beyond_range = 0.01;        ///< rad
  double beyond_range_share = 0.01;  ///< of the time
  double start_jump = 0.05;          ///< rad
  double touch = 5e-4;               ///< m: bodies that are deeper in one another collide
  double collision = 0.002;          ///< m
  double sink = 0.005;               ///< m
  double energy_residual = 0.01;     ///< of what was drawn, or stored, or the least that counts
  double energy_created = 0.05;      ///< of the same
  double slip = 0.2;                 ///< of the way of the centre of mass
  double torque_error = 0.05;        ///< of a joint's largest torque
  double progress = 0;               ///< of the robot's extent, per period; 0: nothing is asked for
  /// m: depth from which on two bodies are in one another. A record may have a `touch` above `collision`.
  [[nodiscard]] double meeting() const { return touch < collision ? touch : collision; }
  bool operator==(const Limits&) const = default;
  void fields(Fields& f);
};

/// A line for stderr that is no problem: what --set dropped, how the CPG was set up.
struct Note {
  SourceLocation place;
  std::string text;
  bool operator==(const Note&) const = default;
};

/// A plugin library named by the scenario.
struct PluginFile {
  std::string path;  ///< canonical
  std::string hash;  ///< FNV-1a of the file, 16 hex digits
};

struct Scenario {
  std::string file, name;
  std::vector<PluginFile> plugins;
  std::shared_ptr<const Robot> robot;
  /// One per entry of Robot::types, as read (for the resolved scenario).
  std::shared_ptr<const std::vector<Node>> module_documents = std::make_shared<const std::vector<Node>>();
  Base base = Base::floating;
  bool on_ground = true;            ///< lowered onto the ground at x, y; false: at `position`
  Vec3 position = Vec3::Zero();     ///< of the base frame, m; z: 0 where on_ground
  Vec3 orientation = Vec3::Zero();  ///< roll pitch yaw, rad
  Initial initial;
  Physics physics;
  Ground ground;
  ContactSettings contact;
  PluginSelection actuator, controller, cpg;
  std::string actuator_source;    ///< who says the figures that the section `actuator` gives; empty: nobody does
  double control_period = 0.015;  ///< s
  double cpg_step = 0;            ///< s, RK4 sub-step of the CPG
  double duration = 0;            ///< s
  TraceSettings trace;
  FigureSettings figure;
  Limits limits;
  std::int64_t seed = 1;
  std::vector<Note> notes;
  /// Where the user gave a key: `physics.step`, `trace.columns` ...; of a rollout of a template first its own.
  using Places = std::map<std::string, SourceLocation>;
  Places own_places;
  std::shared_ptr<const Places> places = std::make_shared<const Places>();

  /// For errors found later: where `key` was given, or else the file.
  [[nodiscard]] SourceLocation place(const std::string& key) const {
    for (const Places* known : {&own_places, places.get()}) {
      if (const auto at = known->find(key); at != known->end()) return at->second;
    }
    return SourceLocation{file};
  }
  /// The same, with the key's section before the file.
  [[nodiscard]] SourceLocation nearest_place(const std::string& key) const {
    const SourceLocation exact = place(key);
    return exact.line > 0 || exact.file != file ? exact : place(key.substr(0, key.find('.')));
  }
};

}  // namespace gaitlab
