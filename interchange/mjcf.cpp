#include "interchange/mjcf.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>
#include <string_view>

#include "core/model/principal_axes.h"
#include "core/scenario/sensor_section.h"
#include "core/settings/wording.h"
#include "core/simulation/start.h"
#include "interchange/mjcf_walking.h"
#include "interchange/robot_xml.h"

namespace gaitlab::interchange {

namespace {

using namespace interchange;

// Least mass and moment of inertia, kg and kg m^2. MuJoCo requires more than 1e-15 for every body that moves.
constexpr double kMassless = 2e-15;
constexpr double kPointSize = 0.001;  // m, radius with which a point is drawn

std::string quaternion(const Quat& q) { return text({q.w(), q.x(), q.y(), q.z()}); }

void set_pose(Xml& element, const Pose& pose) {
  set(element, "pos", text(pose.p));
  set(element, "quat", quaternion(Quat(pose.R)));
}

class Mjcf {
 public:
  Mjcf(const Scenario& s, MjcfModel model)
      : s_(s), robot_(*s.robot), start_(start_state(s)), tree_(robot_), limits_(motor_limits(s)), sensors_(make_sensors(s)) {
    if (model == MjcfModel::walking) walking_.emplace(s, start_, limits_, step());
  }

  std::string write() {
    Xml root;
    root.name = "mujoco";
    set(root, "model", s_.name);
    comment(root, walking_
                      ? fmt::format("Written by gaitlab.{}{}{}", walking_->comment(), method(), massless())
                      : fmt::format("Written by gaitlab. Not in this file, because MJCF does not hold it:{}{} Geoms touch "
                                    "nothing: those of group 3 are the contact elements (points are drawn as spheres of {} "
                                    "m), each with a site.{}",
                                    left_out(s_), method(), text({kPointSize}), massless()));
    write_options(root);
    write_meshes(root);
    Xml& world = add(root, "worldbody");
    write_ground(world);
    elements_ = contact_elements_by_body(robot_, s_.contact.on);
    std::vector<Xml*> bodies(robot_.bodies.size());
    for (const std::size_t b : tree_.order) {
      const Attachment& at = tree_.attachments[b];
      bodies[b] = &write_body(at.kind == Attachment::Kind::base ? world : *bodies[at.parent], b);
    }
    write_motors(root);
    write_sensors(root);
    write_start(root, world);
    return print(root);
  }

 private:
  void write_ground(Xml& world) {
    if (const GroundType& ground = s_.ground.type(); !ground.plane_and_boxes) {
      throw InputError(s_.place("ground.type"),
                       fmt::format("MJCF holds no {} of this kind; expected type: {}", ground.name, plane_and_box_types()));
    }
    if (!s_.ground.exists()) return;
    Xml& plane = geom(world, "ground", "plane", "0 0 1");
    set(plane, "group", "2");
    if (walking_) walking_->write_ground(plane, s_.ground.friction);
    for (std::size_t i = 0; i < s_.ground.boxes().size(); ++i) {
      const Box& box = s_.ground.boxes()[i];
      Xml& e = geom(world, fmt::format("ground/{}", i), "box", text(Vec3(box.size / 2)));
      set_pose(e, {box.R, box.center});
      set(e, "group", "2");
      if (walking_) walking_->write_ground(e, box.friction);
    }
  }

  void write_options(Xml& root) {
    Xml& compiler = add(root, "compiler");
    set(compiler, "angle", "radian");
    set(compiler, "inertiafromgeom", "false");
    Xml& option = add(root, "option");
    set(option, "timestep", text({step()}));
    set(option, "gravity", text(s_.physics.gravity));
    set(option, "integrator", "RK4");
    if (walking_) walking_->write_options(option);
    Xml& drawn = add(add(root, "default"), "geom");
    set(drawn, "contype", "0");
    set(drawn, "conaffinity", "0");
    set(drawn, "group", "1");
  }

  static std::string mesh_name(const ModuleType& type, std::size_t body, std::size_t shape) {
    return fmt::format("{}/{}/{}", type.name, type.bodies[body].name, shape);
  }

  /// Writes the points of hulls, from which MuJoCo makes meshes.
  void write_meshes(Xml& root) {
    Xml assets;
    assets.name = "asset";
    for (const ModuleType& type : robot_.types) {
      for (std::size_t b = 0; b < type.bodies.size(); ++b) {
        const std::vector<Shape>& shapes = type.bodies[b].shapes;
        for (std::size_t i = 0; i < shapes.size(); ++i) {
          if (shapes[i].kind != Shape::Kind::hull) continue;
          Xml& mesh = add(assets, "mesh");
          set(mesh, "name", mesh_name(type, b, i));
          std::string points;
          for (const Vec3& corner : shapes[i].hull->corners) points += (points.empty() ? "" : " ") + text(corner);
          set(mesh, "vertex", points);
        }
      }
    }
    if (!assets.children.empty()) root.children.push_back(std::move(assets));
  }

  Xml& write_body(Xml& parent, std::size_t b) {
    const Body& body = robot_.bodies[b];
    const Attachment& at = tree_.attachments[b];
    Xml& element = add(parent, "body");
    set(element, "name", body.name);
    if (at.kind == Attachment::Kind::base) {
      set(element, "pos", text(start_.position));
      set(element, "quat", quaternion(start_.orientation));
      write_base_joints(element);
    } else {
      const Body& on = robot_.bodies[at.parent];
      const Pose step = at.kind == Attachment::Kind::hinge ? robot_.links[body.link].in_parent : Pose{};
      set_pose(element, on.in_link.inverse() * step * body.in_link);
      if (at.kind == Attachment::Kind::hinge) write_hinge(element, body, at.index);
    }
    write_inertia(element, body, at.kind);
    draw(element, body);
    for (const ContactElement& e : elements_[b]) draw(element, e, body);
    write_sites_of_sensors(element, b);
    return element;
  }

  /// Writes the joints of the base, which turn and shift the base from its initial pose. In the base's axes, the world axis e
  /// is R^T e.
  void write_base_joints(Xml& element) {
    if (s_.base == Base::floating) set(add(element, "freejoint"), "name", "base");
    if (s_.base != Base::planar) return;
    const Mat3 R = start_.orientation.toRotationMatrix();
    const auto joint = [&](const char* name, const char* type, const Vec3& axis) {
      Xml& j = add(element, "joint");
      set(j, "name", name);
      set(j, "type", type);
      set(j, "axis", text(Vec3(R.transpose() * axis)));
    };
    joint("base/x", "slide", Vec3::UnitX());
    joint("base/z", "slide", Vec3::UnitZ());
    joint("base/turn", "hinge", Vec3::UnitY());
  }

  void write_hinge(Xml& element, const Body& body, std::size_t j) {
    const Joint& joint = robot_.joints[j];
    const Pose hinge = body.in_link.inverse();  // the frame of the link is that of the hinge
    Xml& e = add(element, "joint");
    set(e, "name", joint.name);
    set(e, "type", "hinge");
    set(e, "pos", text(hinge.p));
    set(e, "axis", text(Vec3(hinge.R * robot_.links[body.link].axis)));
    set(e, "limited", joint.turns_freely() ? "false" : "true");
    if (!joint.turns_freely()) set(e, "range", text({joint.lo, joint.hi}));
    if (walking_) walking_->write_hinge(e, j);
    if (!joint.driven()) {
      set(e, "stiffness", text({joint.passive->stiffness}));
      set(e, "springref", text({joint.passive->rest}));
      set(e, "damping", text({joint.passive->damping}));
      set(e, "frictionloss", text({joint.passive->friction}));
    }
    if (joint.driven() && !limits_.empty() && !(limits_[j].friction == JointFriction())) {
      set(e, "damping", text({limits_[j].friction.viscous}));
      set(e, "frictionloss", text({limits_[j].friction.dry}));
    }
    if (!limits_.empty() && limits_[j].armature > 0) set(e, "armature", text({limits_[j].armature}));
  }

  const BodyType& type(const Body& body) const { return robot_.types[robot_.modules[body.module].type].bodies[body.type]; }
  /// True if the body's mass or a moment of inertia is below MuJoCo's minimum and raised to it, for example the moment of a rod
  /// about its axis.
  static bool raised(const Body& body) {
    Vec3 moments;
    principal_axes(body.inertia, moments);
    return body.mass < kMassless || moments.minCoeff() < kMassless;
  }
  /// Step for MuJoCo. If the scenario's integrator adapts its step, it is the default step of the engine, which is short enough
  /// for RK4.
  [[nodiscard]] double step() const { return s_.physics.adapts() ? s_.physics.engine->step : s_.physics.step; }
  /// Sentence of the comment on the integrator: MuJoCo uses RK4, whose error is small, instead of the scenario's integrator.
  std::string method() const {
    if (s_.physics.integrator == nullptr || (!walking_ && s_.physics.integrator->name == "rk4")) return "";
    const Integrator& own = *s_.physics.integrator;
    const std::string order =
        own.adapts ? fmt::format("accuracy {}", number_text(s_.physics.accuracy)) : fmt::format("of order {}", own.order);
    return fmt::format(" Integrator: {}, {}; this file uses {} at {}, of order {}.", own.name, order,
                       walking_ ? "MuJoCo's implicit" : "RK4",
                       own.adapts ? fmt::format("{} s", number_text(step())) : "the same step", walking_ ? 1 : 4);
  }
  std::string massless() const {
    std::string names;
    for (const Body& body : robot_.bodies) {
      if (raised(body)) names += (names.empty() ? "" : ", ") + body.name;
    }
    if (names.empty()) return "";
    return fmt::format(" MuJoCo moves no body without mass and moments of inertia: {} kg and kg m^2 replace 0 in {}.",
                       kMassless, names);
  }

  void write_inertia(Xml& element, const Body& body, Attachment::Kind kind) {
    if (!(body.mass > 0) && kind != Attachment::Kind::hinge) return;
    Xml& e = add(element, "inertial");
    set(e, "pos", text(body.com));
    set(e, "mass", text({std::max(body.mass, kMassless)}));
    // MuJoCo also accepts full tensors, but diagonalises them with errors of 1e-12 kg m^2. Principal axes are exact.
    Vec3 moments;
    const Mat3 axes = principal_axes(body.inertia, moments);
    set(e, "quat", quaternion(Quat(axes)));
    set(e, "diaginertia", text(Vec3(moments.cwiseMax(kMassless))));
  }

  static Xml& geom(Xml& parent, const std::string& name, const char* type, const std::string& size) {
    Xml& e = add(parent, "geom");
    if (!name.empty()) set(e, "name", name);
    set(e, "type", type);
    set(e, "size", size);
    return e;
  }

  void draw(Xml& element, const Body& body) {
    const std::vector<Shape>& shapes = type(body).shapes;
    for (std::size_t i = 0; i < shapes.size(); ++i) {
      const Shape& shape = shapes[i];
      Pose pose = shape.in_body;
      if (shape.kind == Shape::Kind::box) {
        set_pose(geom(element, "", "box", text(Vec3(shape.size / 2))), pose);
      } else if (shape.kind == Shape::Kind::sphere) {
        set_pose(geom(element, "", "sphere", text({shape.size.x()})), pose);
      } else if (shape.kind == Shape::Kind::hull) {
        Xml& e = add(element, "geom");
        set(e, "type", "mesh");
        set(e, "mesh", mesh_name(robot_.types[robot_.modules[body.module].type], body.type, i));
        set_pose(e, pose);
      } else {  // MuJoCo has no half cylinder: a whole one is drawn, whose other half is inside the body
        pose.R = pose.R * y_from_z();
        set_pose(geom(element, "", "cylinder", text({shape.size.x(), shape.size.y() / 2})), pose);
      }
    }
  }

  void draw(Xml& element, const ContactElement& contact, const Body& body) {
    const std::string pos = text(body.in_link.inverse() * contact.centre);
    const std::string size = text({contact.radius > 0 ? contact.radius : kPointSize});
    Xml& e = geom(element, contact.name, "sphere", size);
    set(e, "pos", pos);
    set(e, "group", "3");
    if (walking_) walking_->write_element(e, contact);
    Xml& site = add(element, "site");
    set(site, "name", contact.name);
    set(site, "pos", pos);
    set(site, "size", text({kPointSize}));
    set(site, "group", "3");
  }

  /// Writes the motors. Their controls are torques on the joints.
  void write_motors(Xml& root) {
    if (limits_.empty()) return;
    if (walking_) {
      walking_->write_motors(root);
      return;
    }
    Xml& actuator = add(root, "actuator");
    for (std::size_t j = 0; j < robot_.joints.size(); ++j) {
      if (!robot_.joints[j].driven()) continue;
      Xml& e = add(actuator, "motor");
      set(e, "name", robot_.joints[j].name);
      set(e, "joint", robot_.joints[j].name);
      const bool limited = std::isfinite(limits_[j].effort);
      set(e, "ctrllimited", limited ? "true" : "false");
      if (limited) set(e, "ctrlrange", text({-limits_[j].effort, limits_[j].effort}));
    }
  }

  /// Writes the places of the sensors on the body b.
  void write_sites_of_sensors(Xml& element, std::size_t b) {
    for (std::size_t i = 0; i < sensors_.size(); ++i) {
      for (const BodyPoint& point : sensors_[i]->points()) {
        if (point.body != b) continue;
        Xml& site = add(element, "site");
        set(site, "name", s_.sensors[i].name);
        set(site, "pos", text({point.position[0], point.position[1], point.position[2]}));
        set(site, "size", text({kPointSize}));
      }
    }
  }

  /// Writes the sensors of types that MuJoCo has. They measure exact values.
  void write_sensors(Xml& root) {
    Xml all;
    all.name = "sensor";
    const auto write = [&](const char* type, const std::string& name, const char* of, const std::string& what) {
      Xml& e = add(all, type);
      set(e, "name", name);
      set(e, of, what);
    };
    for (std::size_t i = 0; i < sensors_.size(); ++i) {
      const std::string& own = s_.sensors[i].name;
      for (const SensorReading& reading : sensors_[i]->readings()) {
        if (reading.replaces == Replaces::angle) write("jointpos", reading.name, "joint", robot_.joints[reading.part].name);
        if (reading.replaces == Replaces::speed) write("jointvel", reading.name, "joint", robot_.joints[reading.part].name);
        if (reading.replaces == Replaces::torque && !limits_.empty()) {
          write("actuatorfrc", reading.name, "actuator", robot_.joints[reading.part].name);
        }
        if (reading.name == own + ".gyro_x") write("gyro", own + ".gyro", "site", own);
        if (reading.name == own + ".accelerometer_x") write("accelerometer", own + ".accelerometer", "site", own);
      }
    }
    if (!all.children.empty()) root.children.push_back(std::move(all));
  }

  /// Writes the initial state as a keyframe. The angular velocity of a free joint is in the axes of the body.
  void write_start(Xml& root, const Xml& world) {
    std::vector<double> q;
    std::vector<double> v;
    const Vec3& p = start_.position;
    const Quat& turn = start_.orientation;
    const Vec3& velocity = start_.velocity;
    if (s_.base == Base::floating) {
      const Vec3 w = turn.conjugate() * start_.angular_velocity;
      q = {p.x(), p.y(), p.z(), turn.w(), turn.x(), turn.y(), turn.z()};
      v = {velocity.x(), velocity.y(), velocity.z(), w.x(), w.y(), w.z()};
    } else if (s_.base == Base::planar) {
      q = {0, 0, 0};
      v = {velocity.x(), velocity.z(), start_.angular_velocity.y()};
    }
    // MuJoCo numbers the joints in the order of the bodies, depth first.
    std::map<std::string_view, std::size_t> numbers;
    for (std::size_t j = 0; j < robot_.joints.size(); ++j) numbers.emplace(robot_.joints[j].name, j);
    append_joints(world, numbers, q, v);
    if (q.empty()) return;
    Xml& key = add(add(root, "keyframe"), "key");
    set(key, "name", "start");
    set(key, "qpos", text(q));
    set(key, "qvel", text(v));
    if (walking_) walking_->write_controls(key);
  }

  void append_joints(const Xml& element, const std::map<std::string_view, std::size_t>& numbers, std::vector<double>& q,
                     std::vector<double>& v) const {
    for (const Xml& child : element.children) {
      const std::string* name = child.name == "joint" ? child.attribute("name") : nullptr;
      if (const auto at = name == nullptr ? numbers.end() : numbers.find(*name); at != numbers.end()) {
        q.push_back(start_.q[at->second]);
        v.push_back(start_.qd[at->second]);
      }
      if (child.name == "body") append_joints(child, numbers, q, v);
    }
  }

  const Scenario& s_;
  const Robot& robot_;
  RobotState start_;
  BodyTree tree_;
  std::vector<MotorLimits> limits_;
  std::vector<std::unique_ptr<Sensor>> sensors_;
  std::optional<MjcfWalking> walking_;                 ///< absent in a strict file
  std::vector<std::vector<ContactElement>> elements_;  ///< contact elements of each body
};

}  // namespace

std::string to_mjcf(const Scenario& scenario, MjcfModel model) { return Mjcf(scenario, model).write(); }

}  // namespace gaitlab::interchange
