#include "interchange/mjcf_bodies.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>
#include <utility>

#include "core/settings/shell_word.h"
#include "core/settings/wording.h"
#include "interchange/mjcf_compiled.h"
#include "interchange/mjcf_pairs.h"
#include "interchange/robot_mass.h"
#include "interchange/robot_shapes.h"

namespace gaitlab::interchange {

namespace {

using Type = MjcfJoint::Type;

constexpr double kHeaviest = 1e9;   // kg
constexpr double kLongest = 1e6;    // m
constexpr double kParallel = 1e-6;  // between the axes of a planar base and those of the world

class MjcfWalk {
 public:
  MjcfWalk(MjcfText& text, const ImportOptions& options, Problems& problems)
      : text_(text),
        options_(options),
        problems_(problems),
        made_{{"MJCF", "body", "torque is the largest force in "}},
        model_(compiled(text, made_.notes)),
        of_(model_.bodies.size()) {}

  RobotBodies read() {
    made_.notes.insert(made_.notes.end(), text_.notes().begin(), text_.notes().end());
    const std::set<std::string> locked = locked_joints(moving(), options_.locked, problems_);
    choose_root(locked);
    if (root_ == 0) return std::move(made_);
    for (std::size_t b = root_; b < model_.bodies.size(); ++b) {
      if (b == root_ || (of_[model_.bodies[b].parent] && model_.bodies[b].parent != 0)) add_body(b, locked);
    }
    finish();
    return std::move(made_);
  }

 private:
  using JointAt = std::pair<std::size_t, std::size_t>;  ///< body, and number in it
  /// The module's body of a body, and its pose there.
  struct Placed {
    std::size_t body;
    Pose pose;
  };

  [[nodiscard]] std::vector<std::string> moving() const {
    std::vector<std::string> names;
    for (std::size_t b = 0; b < model_.bodies.size(); ++b) {
      for (std::size_t k = 0; k < model_.bodies[b].joints.size(); ++k) {
        if (model_.bodies[b].joints[k].type != Type::free) names.push_back(name_of_joint(b, k));
      }
    }
    return names;
  }

  void changed(const SourceLocation& place, const std::string& text) { made_.notes.push_back({place, text, true}); }
  void left_out(const SourceLocation& place, const std::string& text) { made_.notes.push_back({place, text, false}); }
  [[nodiscard]] std::string name_of_body(std::size_t b) const {
    const std::string& name = model_.bodies[b].name;
    return name.empty() ? fmt::format("body_{}", b) : name;
  }
  [[nodiscard]] std::string name_of_joint(std::size_t b, std::size_t k) const {
    const std::string& name = model_.bodies[b].joints[k].name;
    return name.empty() ? name_of_body(b) + (k == 0 ? "_joint" : fmt::format("_joint_{}", k + 1)) : name;
  }

  /// Chooses the tree of the world with the most hinges, the first of equal ones.
  void choose_root(const std::set<std::string>& locked) {
    std::vector<std::size_t> top(model_.bodies.size(), 0);
    std::map<std::size_t, std::size_t> hinges;
    for (std::size_t b = 1; b < model_.bodies.size(); ++b) {
      const MjcfBody& body = model_.bodies[b];
      top[b] = body.parent == 0 ? b : top[body.parent];
      std::size_t& count = hinges[top[b]];
      for (std::size_t k = 0; k < body.joints.size(); ++k)
        count += body.joints[k].type == Type::hinge && !locked.contains(name_of_joint(b, k)) ? 1 : 0;
    }
    for (const auto& [b, count] : hinges) root_ = root_ == 0 || count > hinges[root_] ? b : root_;
    if (root_ == 0) problems_.add({text_.file()}, "has no body; expected a robot in <worldbody>");
    for (const auto& [b, count] : hinges) {
      if (b == root_) continue;
      const bool moves = count > 0 || !model_.bodies[b].joints.empty();
      made_.notes.push_back({text_.body(b),
                             fmt::format("body {}{}", in_quotes(name_of_body(b)),
                                         moves ? " and its children are left out; the robot is the tree with the most hinges"
                                               : ", which does not move"),
                             moves});
    }
  }

  std::size_t new_body(const std::string& name, const SourceLocation& place) {
    made_.bodies.push_back({name});
    made_.body_of.push_back({name, place});
    masses_.emplace_back();
    return made_.bodies.size() - 1;
  }

  void add_body(std::size_t b, const std::set<std::string>& locked) {
    const MjcfBody& body = model_.bodies[b];
    std::vector<std::size_t> hinges = b == root_ ? root_hinges(locked) : moving_hinges(b, locked);
    if (b == root_) {
      const bool ground = made_.base == Base::fixed && !hinges.empty();  // the hinges turn the root against the world
      const std::string name = ground ? "ground" : name_of_body(b);
      const std::size_t first = new_body(name, text_.body(b));
      of_[b] = {first, {body.in_parent.R, Vec3::Zero()}};
      if (ground) {
        masses_[first].push_back({1, Vec3::Zero(), Mat3::Identity() * 0.01});
        changed(text_.body(b), fmt::format("joint {} is on the world, a fixed body 'ground' of 1 kg here",
                                           in_quotes(name_of_joint(b, hinges.front()))));
      }
    } else {
      const Placed& parent = *of_[body.parent];
      of_[b] = {parent.body, parent.pose * body.in_parent};
    }
    for (std::size_t i = 0; i < hinges.size(); ++i) add_hinge(b, hinges[i], i + 1 == hinges.size());
    const Placed& at = *of_[b];
    if (body.mass > 0) {
      const Mat3 inertia = at.pose.R * body.inertia * at.pose.R.transpose();
      masses_[at.body].push_back({body.mass, at.pose * body.com, inertia, name_of_body(b)});
    }
    if (!(body.mass <= kHeaviest) || !(body.in_parent.p.norm() <= kLongest) || !(body.com.norm() <= kLongest)) {
      problems_.add(text_.body(b), fmt::format("body {} is heavier than 1e9 kg or farther than 1e6 m from its parent",
                                               in_quotes(name_of_body(b))));
    }
    for (const MjcfGeom& geom : body.geoms) add_geom(b, geom, at);
  }

  /// Joints of the root that are hinges of the module; chooses the base.
  std::vector<std::size_t> root_hinges(const std::set<std::string>& locked) {
    const MjcfBody& root = model_.bodies[root_];
    const auto is = [](Type type) { return [type](const MjcfJoint& joint) { return joint.type == type; }; };
    if (std::ranges::any_of(root.joints, is(Type::free))) {
      note_free_root();
      return {};
    }
    const auto along = [&](Type type, const Vec3& axis) {
      return std::ranges::count_if(root.joints, [&](const MjcfJoint& joint) {
               return joint.type == type && std::abs((root.in_parent.R * joint.axis).dot(axis)) > 1 - kParallel;
             }) == 1;
    };
    bool unlocked = true;
    for (std::size_t k = 0; k < root.joints.size(); ++k) unlocked = unlocked && !locked.contains(name_of_joint(root_, k));
    if (unlocked && root.joints.size() == 3 && along(Type::slide, Vec3::UnitX()) && along(Type::slide, Vec3::UnitZ()) &&
        along(Type::hinge, Vec3::UnitY())) {
      made_.base = Base::planar;
      note_free_root();
      return {};
    }
    made_.base = Base::fixed;
    return moving_hinges(root_, locked);
  }

  /// Adds a note on properties of the root's joints that a floating or planar base lacks.
  void note_free_root() {
    const MjcfBody& root = model_.bodies[root_];
    std::string lost;
    const auto add = [&](bool any, const char* what) {
      if (any) lost += (lost.empty() ? "" : ", ") + std::string(what);
    };
    const auto some = [&](auto has) { return std::ranges::any_of(root.joints, has); };
    add(some([](const MjcfJoint& one) { return one.damping > 0; }), "damping");
    add(some([](const MjcfJoint& one) { return one.friction > 0; }), "friction");
    add(some([](const MjcfJoint& one) { return one.armature > 0; }), "armature");
    add(some([](const MjcfJoint& one) { return one.stiffness > 0; }), "springs");
    add(some([](const MjcfJoint& one) { return one.limited; }), "range");
    add(std::ranges::any_of(model_.actuators, [&](const MjcfActuator& one) { return one.body == root_; }), "actuators");
    if (!lost.empty()) {
      changed(text_.joint(root_, 0),
              fmt::format("{} of the joints of the root {}, which moves freely", lost, in_quotes(name_of_body(root_))));
    }
  }

  /// Numbers of a body's hinges that are not locked. Adds a problem for joints of another type.
  std::vector<std::size_t> moving_hinges(std::size_t b, const std::set<std::string>& locked) {
    std::vector<std::size_t> hinges;
    const std::vector<MjcfJoint>& joints = model_.bodies[b].joints;
    for (std::size_t k = 0; k < joints.size(); ++k) {
      if (locked.contains(name_of_joint(b, k))) {
        changed(text_.joint(b, k), fmt::format("joint {} is fixed, as --lock asks", in_quotes(name_of_joint(b, k))));
      } else if (joints[k].type == Type::hinge) {
        hinges.push_back(k);
      } else if (joints[k].type != Type::free) {
        refused_.push_back({b, k});
      }
    }
    return hinges;
  }

  /// Reports the joints that cannot be hinges. The first message has the option that fixes all of them.
  void refuse_joints() {
    std::string lock;
    for (const std::string& one : options_.locked) lock += " --lock " + shell_word(one);
    for (const auto& [b, k] : refused_) lock += " --lock " + shell_word(name_of_joint(b, k));
    for (const auto& [b, k] : refused_) {
      const bool ball = model_.bodies[b].joints[k].type == Type::ball;
      problems_.add(text_.joint(b, k), fmt::format("joint {} is a {}; a module has hinges{}", in_quotes(name_of_joint(b, k)),
                                                   ball ? "ball" : "slide",
                                                   JointAt(b, k) != refused_.front() ? ""
                                                   : refused_.size() == 1            ? "; it is fixed by" + lock
                                                                                     : "; they are fixed by" + lock));
    }
  }

  /// Adds hinge `k` of body `b` and the body that it moves, the last of which is `b` itself.
  void add_hinge(std::size_t b, std::size_t k, bool last) {
    const MjcfJoint& joint = model_.bodies[b].joints[k];
    const Placed parent = *of_[b];
    const std::string name = name_of_joint(b, k);
    const Pose at{parent.pose.R, parent.pose * joint.pos};
    const std::size_t child = new_body(last ? name_of_body(b) : name_of_body(b) + "/" + name, text_.body(b));
    RobotHinge made;
    made.hinge = {name, parent.body, child, at, joint.axis};
    made.hinge.lo = joint.limited ? joint.lo - joint.at_start : -kNoStop;
    made.hinge.hi = joint.limited ? joint.hi - joint.at_start : kNoStop;
    if (joint.at_start != 0) {
      changed(text_.joint(b, k),
              fmt::format("joint {} has ref {}, which is angle 0 here", in_quotes(name), number_text(joint.at_start)));
    }
    read_motor(b, k, made);
    made_.hinges.push_back(made);
    made_.hinge_of.push_back({name, text_.joint(b, k)});
    of_[b] = {child, {Mat3::Identity(), -joint.pos}};
  }

  void read_motor(std::size_t b, std::size_t k, RobotHinge& made) {
    const MjcfJoint& joint = model_.bodies[b].joints[k];
    double most = 0;
    bool driven = false, limited = true;
    for (const MjcfActuator& one : model_.actuators) {
      if (one.body != b || one.joint != k) continue;
      driven = true;
      positions_ += one.position ? 1 : 0;
      limited = limited && one.force.has_value();
      most += one.force.value_or(0) * std::abs(one.gear);
    }
    if (joint.torque_limit > 0) {
      most = limited ? std::min(joint.torque_limit, most) : joint.torque_limit;
      limited = true;
    }
    if (!driven) {
      made.hinge.passive = Passive{.stiffness = joint.stiffness,
                                   .rest = joint.rest - joint.at_start,
                                   .damping = joint.damping,
                                   .friction = joint.friction};
      if (joint.armature > 0) passive_armature_.push_back({b, k});
      return;
    }
    if (joint.stiffness > 0) driven_springs_.push_back({b, k});
    made.dry = joint.friction;
    made.viscous = joint.damping;
    made.rotor_inertia = joint.armature;
    made.no_effort = !limited || !(most > 0) || !(most <= kMostTorque);
    made.effort = most;
    made.speed = kChosenSpeed;
    made.no_speed = true;
  }

  void add_geom(std::size_t b, const MjcfGeom& geom, const Placed& at) {
    if (geom.contype == 0 && geom.conaffinity == 0 && !text_.paired().contains(geom.name)) {
      drawn_.push_back(b);
      return;
    }
    std::vector<Shape>& shapes = made_.bodies[at.body].shapes;
    const Pose pose = at.pose * geom.in_body;
    const RobotElement of{name_of_body(b), text_.body(b)};
    pairs_.add(at.body, GeomMask{geom.contype, geom.conaffinity});
    switch (geom.type) {
      case MjcfGeom::Type::sphere:
        shapes.push_back({Shape::Kind::sphere, pose, {geom.size.x(), 0, 0}});
        break;
      case MjcfGeom::Type::capsule:
      case MjcfGeom::Type::cylinder:
        add_cylinder_along_z(pose, geom.size.x(), 2 * geom.size.y(), geom.type == MjcfGeom::Type::capsule, shapes);
        break;
      case MjcfGeom::Type::box:
        shapes.push_back({Shape::Kind::box, pose, 2 * geom.size});
        break;
      case MjcfGeom::Type::ellipsoid:
        ellipsoids_.add(of, fmt::format("body {} has an ellipsoid", in_quotes(of.name)), pose,
                        hull_of_few(ellipsoid_points(geom.size)), shapes, made_.notes);
        break;
      case MjcfGeom::Type::mesh:
        meshes_.add(of, fmt::format("body {} has a mesh", in_quotes(of.name)), pose, hull_of_few(geom.vertices), shapes,
                    made_.notes);
        break;
      default:
        left_out(of.place, fmt::format("a plane or field of heights of body {}", in_quotes(of.name)));
    }
  }

  void finish() {
    refuse_joints();
    std::vector<bool> inner(made_.bodies.size(), false), moved(made_.bodies.size(), false);
    for (const RobotHinge& one : made_.hinges) inner[one.hinge.parent] = moved[one.hinge.child] = true;
    for (std::size_t i = 0; i < made_.bodies.size(); ++i) {
      const RobotMass whole = united_mass(masses_[i]);
      made_.bodies[i].mass = whole.mass;
      made_.bodies[i].com = whole.com;
      made_.bodies[i].inertia = whole.inertia;
      if (whole.mass > 0 || (inner[i] && moved[i])) continue;
      problems_.add(made_.body_of[i].place,
                    fmt::format("body {} has no mass; expected inertial or geoms", in_quotes(made_.body_of[i].name)));
    }
    choose_torques();
    meshes_.add_note("body", made_.notes);
    ellipsoids_.add_note("body", made_.notes);
    note_all();
    made_.finish();
    exclude();
  }

  void choose_torques() {
    const std::vector<double> holding = holding_torques(made_.bodies, made_.hinges);
    for (std::size_t j = 0; j < made_.hinges.size(); ++j) {
      RobotHinge& one = made_.hinges[j];
      if (one.hinge.passive) continue;
      one.source = "chosen: the no-load speed, because MJCF has none";
      if (!one.no_effort) continue;
      one.effort = holding[j];
      one.source = "chosen: torque and no-load speed, because the MJCF has neither";
      changed(made_.hinge_of[j].place, fmt::format("joint {} has a motor without a limit of force; {} N m at rest is chosen",
                                                   in_quotes(made_.hinge_of[j].name), number_text(one.effort)));
    }
  }

  /// Fills may_overlap; names of bodies must be final.
  void exclude() {
    for (const auto& [a, b] : model_.excluded) {
      if (of_[a] && of_[b]) pairs_.add(of_[a]->body, of_[b]->body);
    }
    for (const auto& [a, b] : pairs_.silent()) made_.may_overlap.push_back({made_.bodies[a].name, made_.bodies[b].name});
    if (pairs_.all_silent()) made_.may_overlap = {{"*", "*"}};
  }

  /// Adds a note on a property of joints that is left out, at the first of them.
  void note_joints(const std::vector<JointAt>& joints, const char* what, const char* why) {
    if (joints.empty()) return;
    const auto& [b, k] = joints.front();
    const std::string count = joints.size() == 1 ? "joint " : fmt::format("{} joints, first ", joints.size());
    changed(text_.joint(b, k), fmt::format("{} of {}{} is left out{}", what, count, in_quotes(name_of_joint(b, k)), why));
  }

  void note_all() {
    if (std::ranges::any_of(made_.hinges, [](const RobotHinge& one) { return !one.hinge.passive; })) {
      changed({text_.file()},
              fmt::format("the largest force and a chosen {} rad/s become the ends of a motor's line", kChosenSpeed));
    }
    if (positions_ > 0) {
      left_out({text_.file()}, fmt::format("gains of {} that follow angles or speeds: the module has a gain of its own",
                                           counted(positions_, "actuator")));
    }
    note_joints(passive_armature_, "the armature", ", because it has no motor");
    note_joints(driven_springs_, "the spring", " beside its motor");
    if (drawn_.empty()) return;
    left_out(text_.body(drawn_.front()),
             counted(drawn_.size(), "geom") + (drawn_.size() == 1 ? " that does not collide" : " that do not collide"));
  }

  MjcfText& text_;
  const ImportOptions& options_;
  Problems& problems_;
  RobotBodies made_;
  MjcfRobot model_;
  std::size_t root_ = 0;
  std::vector<std::optional<Placed>> of_;  ///< by body
  std::vector<std::vector<RobotMass>> masses_;
  RobotHulls meshes_{"mesh", "meshes"}, ellipsoids_{"ellipsoid", "ellipsoids"};
  std::size_t positions_ = 0;  ///< actuators with a gain
  std::vector<JointAt> passive_armature_, driven_springs_, refused_;
  std::vector<std::size_t> drawn_;  ///< bodies of geoms that do not collide
  SilentPairs pairs_;
};

}  // namespace

RobotBodies mjcf_bodies(MjcfText& text, const ImportOptions& options, Problems& problems) {
  return MjcfWalk(text, options, problems).read();
}

}  // namespace gaitlab::interchange
