#include "interchange/urdf.h"

#include <fmt/format.h>

#include <algorithm>

#include "core/model/solid.h"
#include "core/simulation/start.h"
#include "interchange/robot_xml.h"

namespace gaitlab::interchange {

namespace {

using namespace interchange;

void add_origin(Xml& element, const Pose& pose) {
  Xml& e = add(element, "origin");
  set(e, "xyz", text(pose.p));
  set(e, "rpy", text(to_rpy(pose.R)));
}

class Urdf {
 public:
  explicit Urdf(const Scenario& s) : s_(s), robot_(*s.robot), tree_(robot_), limits_(motor_limits(s)) {}

  std::string write() {
    const RobotState start = start_state(s_);
    Xml root;
    root.name = "robot";
    set(root, "name", s_.name);
    comment(root,
            fmt::format(
                "Written by gaitlab. Not in this file, because URDF does not hold it: Gravity {}.{}{} Start: base at {}, "
                "quaternion w x y z {}, velocity {}, angular velocity {} (world axes), angles {}, speeds {}. Collision: the "
                "contact elements; points are spheres of {} m. An effort or velocity of {} stands for no limit, an effort "
                "of 0 for no motor.{}",
                text(s_.physics.gravity), left_out(s_), rotors(), text(start.position),
                text({start.orientation.w(), start.orientation.x(), start.orientation.y(), start.orientation.z()}),
                text(start.velocity), text(start.angular_velocity), text(start.q), text(start.qd), text({kPointRadius}),
                text({kUnlimited}), springs()));
    if (s_.base != Base::floating) write_world(root, {start.orientation.toRotationMatrix(), start.position});
    const std::vector<std::vector<ContactElement>> contacts = contact_elements_by_body(robot_, s_.contact.on);
    for (const std::size_t b : tree_.order) {
      write_link(root, b, contacts[b]);
      if (tree_.attachments[b].kind != Attachment::Kind::base) write_joint(root, b);
    }
    return print(root);
  }

 private:
  [[nodiscard]] const BodyType& type(const Body& body) const {
    return robot_.types[robot_.modules[body.module].type].bodies[body.type];
  }

  /// Pose of a body's URDF frame in its link: the frame of the hinge for a body with a hinge, else that of the body.
  [[nodiscard]] Pose frame(std::size_t b) const {
    return tree_.attachments[b].kind == Attachment::Kind::hinge ? Pose{} : robot_.bodies[b].in_link;
  }

  [[nodiscard]] std::string springs() const {
    std::string names;
    for (const Joint& joint : robot_.joints) {
      if (joint.driven() || !(joint.passive->stiffness > 0)) continue;
      names += fmt::format("{}{} N m/rad on {} (at rest at {} rad)", names.empty() ? "" : ", ",
                           text({joint.passive->stiffness}), joint.name, text({joint.passive->rest}));
    }
    return names.empty() ? "" : fmt::format(" Springs of hinges: {}.", names);
  }

  [[nodiscard]] std::string rotors() const {
    std::string names;
    for (std::size_t j = 0; j < limits_.size(); ++j) {
      if (!(limits_[j].armature > 0)) continue;
      names += fmt::format("{}{} on {}", names.empty() ? "" : ", ", text({limits_[j].armature}), robot_.joints[j].name);
    }
    return names.empty() ? "" : fmt::format(" Rotors behind their gears, kg m^2: {}.", names);
  }

  Xml& write_connection(Xml& root, const std::string& name, const char* type, const std::string& parent,
                        const std::string& child, const Pose& origin) {
    Xml& e = add(root, "joint");
    set(e, "name", name);
    set(e, "type", type);
    set(add(e, "parent"), "link", parent);
    set(add(e, "child"), "link", child);
    add_origin(e, origin);
    return e;
  }

  /// Writes the link `world` and the joint of a fixed or planar base with its initial pose. The axis of a planar joint is the
  /// normal of the plane (world y) in the base frame.
  void write_world(Xml& root, const Pose& pose) {
    set(add(root, "link"), "name", "world");
    const bool planar = s_.base == Base::planar;
    const std::string& child = robot_.bodies[tree_.order[0]].name;
    Xml& e = write_connection(root, "base", planar ? "planar" : "fixed", "world", child, pose);
    if (planar) set(add(e, "axis"), "xyz", text(Vec3(pose.R.transpose() * Vec3::UnitY())));
  }

  void write_joint(Xml& root, std::size_t b) {
    const Attachment& at = tree_.attachments[b];
    const Body& body = robot_.bodies[b];
    const bool hinge = at.kind == Attachment::Kind::hinge;
    const Pose step = hinge ? robot_.links[body.link].in_parent : Pose{};
    const std::string name = hinge ? robot_.joints[at.index].name : dock_name(at.index);
    const bool free = hinge && robot_.joints[at.index].turns_freely();
    Xml& e = write_connection(root, name,
                              free    ? "continuous"
                              : hinge ? "revolute"
                                      : "fixed",
                              robot_.bodies[at.parent].name, body.name, frame(at.parent).inverse() * step * frame(b));
    if (!hinge) return;
    const Joint& joint = robot_.joints[at.index];
    set(add(e, "axis"), "xyz", text(robot_.links[body.link].axis));
    Xml& limit = add(e, "limit");
    const MotorLimits motor = limits_.empty() ? MotorLimits{} : limits_[at.index];
    if (!free) {
      set(limit, "lower", text({joint.lo}));
      set(limit, "upper", text({joint.hi}));
    }
    set(limit, "effort", text({std::min(motor.effort, kUnlimited)}));
    set(limit, "velocity", text({motor.speed > 0 ? motor.speed : kUnlimited}));
    if (joint.driven() && motor.friction == JointFriction()) return;
    Xml& dynamics = add(e, "dynamics");
    set(dynamics, "damping", text({joint.driven() ? motor.friction.viscous : joint.passive->damping}));
    set(dynamics, "friction", text({joint.driven() ? motor.friction.dry : joint.passive->friction}));
  }

  void write_link(Xml& root, std::size_t b, const std::vector<ContactElement>& contacts) {
    const Body& body = robot_.bodies[b];
    const BodyType& t = type(body);
    const Pose body_in_frame = frame(b).inverse() * body.in_link;
    Xml& e = add(root, "link");
    set(e, "name", body.name);
    if (body.mass > 0) write_inertia(add(e, "inertial"), body, body_in_frame);
    for (const Shape& shape : t.shapes) {
      Xml& visual = add(e, "visual");
      add_origin(visual, body_in_frame * drawn_pose(shape));
      draw(add(visual, "geometry"), shape);
    }
    for (const ContactElement& contact : contacts) {
      Xml& collision = add(e, "collision");
      set(collision, "name", contact.name);
      add_origin(collision, {Mat3::Identity(), frame(b).inverse() * contact.centre});
      set(add(add(collision, "geometry"), "sphere"), "radius", text({contact.radius > 0 ? contact.radius : kPointRadius}));
    }
  }

  static void write_inertia(Xml& inertial, const Body& body, const Pose& body_in_frame) {
    add_origin(inertial, {body_in_frame.R, body_in_frame * body.com});
    set(add(inertial, "mass"), "value", text({body.mass}));
    Xml& e = add(inertial, "inertia");
    const char* kNames[3][3] = {{"ixx", "ixy", "ixz"}, {"", "iyy", "iyz"}, {"", "", "izz"}};
    for (Eigen::Index i = 0; i < 3; ++i) {
      for (Eigen::Index j = i; j < 3; ++j) set(e, kNames[i][j], text({body.inertia(i, j)}));
    }
  }

  /// Pose in the body of the geometry that draw() writes.
  static Pose drawn_pose(const Shape& shape) {
    const Pose& pose = shape.in_body;
    if (shape.kind == Shape::Kind::cylinder || shape.kind == Shape::Kind::half_cylinder) return {pose.R * y_from_z(), pose.p};
    if (shape.kind != Shape::Kind::hull) return pose;
    Shape upright = shape;
    upright.in_body = {};
    const auto [low, high] = bounds({&upright, 1});
    return {pose.R, pose * Vec3((low + high) / 2)};
  }

  /// Writes a shape. URDF has no half cylinder: a whole one is written, whose other half is inside the body. A hull becomes the
  /// box around it, because URDF has meshes in separate files only.
  static void draw(Xml& geometry, const Shape& shape) {
    if (shape.kind == Shape::Kind::box || shape.kind == Shape::Kind::hull) {
      set(add(geometry, "box"), "size", text(shape.size));
    } else if (shape.kind == Shape::Kind::sphere) {
      set(add(geometry, "sphere"), "radius", text({shape.size.x()}));
    } else {
      Xml& cylinder = add(geometry, "cylinder");
      set(cylinder, "radius", text({shape.size.x()}));
      set(cylinder, "length", text({shape.size.y()}));
    }
  }

  const Scenario& s_;
  const Robot& robot_;
  BodyTree tree_;
  std::vector<MotorLimits> limits_;
};

}  // namespace

std::string to_urdf(const Scenario& scenario) { return Urdf(scenario).write(); }

}  // namespace gaitlab::interchange
