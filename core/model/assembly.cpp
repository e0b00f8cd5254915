#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <map>
#include <queue>

#include "core/model/docking.h"
#include "core/model/kinematics.h"
#include "core/model/legs.h"
#include "core/model/robot.h"

namespace gaitlab {

namespace {

/// Axes of a face: x = outward normal, y = reference direction.
Mat3 axes(const FaceType& face) {
  Mat3 R;
  R.col(0) = face.normal;
  R.col(1) = face.reference;
  R.col(2) = face.normal.cross(face.reference);
  return R;
}

/// Pose of the child's body in the parent's body when their faces are docked. The origins coincide, the normals are opposite,
/// and the references are aligned. Then the child is turned by orientation * pi/2 about its own outward normal, and by the
/// rotation vector `angle` in the axes of the parent's face.
Pose docked(const FaceType& child, const FaceType& parent, int orientation, const Vec3& angle) {
  // Quarter turns of (reference, normal x reference) are exact, because they need no sine of pi/2.
  constexpr std::array<std::array<double, 2>, 4> kQuarter{{{1, 0}, {0, 1}, {-1, 0}, {0, -1}}};
  const Vec3 normal = -parent.normal;  // outward normal of the child, in the body of the parent
  const auto [c, s] = kQuarter[static_cast<std::size_t>(orientation)];
  const Vec3 reference = c * parent.reference + s * normal.cross(parent.reference);
  Mat3 target;
  target.col(0) = normal;
  target.col(1) = reference;
  target.col(2) = normal.cross(reference);
  Mat3 R = target * axes(child).transpose();
  if (!angle.isZero(0)) R = turn(axes(parent) * angle).toRotationMatrix() * R;
  return {R, parent.origin - R * child.origin};
}

/// Builds a robot. Parents are placed before their children, and siblings in the order of their numbers. Bodies and joints are
/// numbered module by module, independently of the docks.
class Builder {
 public:
  /// `builds` has an entry per module, or is empty.
  Builder(std::vector<ModuleType> types, const std::vector<std::size_t>& type_of, std::span<const ModuleBuild> builds) {
    robot_.types = std::move(types);
    std::size_t body = 0;
    for (const std::size_t type : type_of) {
      robot_.modules.push_back({type, -1, {}, body, {}, 0});
      body += robot_.types[type].bodies.size();
    }
    for (std::size_t m = 0; m < builds.size(); ++m) robot_.modules[m].build = builds[m];
    robot_.bodies.resize(body);
    number_joints();
  }

  Robot build(const std::vector<Dock>& docks) {
    for (const Dock& dock : docks) {
      Module& child = module(dock.child_module);
      child.parent = dock.parent_module;
      child.dock = dock;
      children_[dock.parent_module].push_back(dock.child_module);
    }
    for (auto& [parent, list] : children_) std::sort(list.begin(), list.end());
    robot_.links.push_back({});
    place_module(0, robot_.types[module(0).type].root, 0, {});
    // Modules are visited breadth-first, so that a parent link always comes before its children.
    std::queue<int> queue({0});
    while (!queue.empty()) {
      const int parent = queue.front();
      queue.pop();
      for (const int child : children_[parent]) {
        dock_child(child);
        queue.push(child);
      }
    }
    fuse();
    return std::move(robot_);
  }

 private:
  Module& module(int index) { return robot_.modules[static_cast<std::size_t>(index)]; }
  const ModuleType& type(const Module& m) const { return robot_.types[m.type]; }

  void number_joints() {
    for (const Module& m : robot_.modules) {
      first_joint_.push_back(robot_.joints.size());
      robot_.joints.resize(robot_.joints.size() + type(m).hinges.size());
    }
  }

  void dock_child(int index) {
    const Dock& dock = module(index).dock;
    const Module& parent = module(dock.parent_module);
    const FaceType& child_face = *find_face(type(module(index)), dock.child_face);
    const FaceType& parent_face = *find_face(type(parent), dock.parent_face);
    const Body& on = robot_.bodies[parent.first_body + parent_face.body];
    place_module(index, child_face.body, on.link,
                 on.in_link * docked(child_face, parent_face, dock.orientation, module(index).build.dock_angle));
  }

  /// Places the bodies of a module breadth-first over its hinges, starting at its reference body, which is part of `link`.
  void place_module(int index, std::size_t reference, std::size_t link, const Pose& in_link) {
    Module& m = module(index);
    const ModuleType& t = type(m);
    m.reference = m.first_body + reference;
    std::vector<bool> placed(t.bodies.size(), false);
    set_body(index, reference, link, in_link);
    placed[reference] = true;
    std::queue<std::size_t> queue({reference});
    while (!queue.empty()) {
      const std::size_t near = queue.front();
      queue.pop();
      bool leaf = true;
      for (const HingeType& hinge : t.hinges) {
        const std::size_t far = hinge.parent == near ? hinge.child : hinge.parent;
        if ((hinge.parent != near && hinge.child != near) || placed[far]) continue;
        add_joint(index, hinge, near, far);
        placed[far] = true;
        leaf = false;
        queue.push(far);
      }
      robot_.bodies[m.first_body + near].free = leaf && near != reference;
    }
    if (t.hinges.empty()) robot_.bodies[m.reference].free = true;
  }

  void set_body(int index, std::size_t body, std::size_t link, const Pose& in_link) {
    const Module& m = module(index);
    const BodyType& t = type(m).bodies[body];
    robot_.bodies[m.first_body + body] = {fmt::format("m{}/{}", index, t.name),
                                          static_cast<std::size_t>(index),
                                          body,
                                          link,
                                          in_link,
                                          false,
                                          m.build.mass * t.mass,
                                          t.com,
                                          m.build.mass * m.build.inertia * t.inertia};
  }

  void add_joint(int index, const HingeType& hinge, std::size_t near, std::size_t far) {
    Module& m = module(index);
    const bool reversed = far == hinge.parent;
    const Body& from = robot_.bodies[m.first_body + near];
    const std::size_t number = first_joint_[static_cast<std::size_t>(index)] + m.joints.size();
    m.joints.push_back(number);
    // The link frame is the hinge frame, whose pose is `in_parent` in the parent body and the identity in the child body.
    const Pose in_near = reversed ? Pose{} : hinge.in_parent;
    const Pose far_in_link = reversed ? hinge.in_parent.inverse() : Pose{};
    const std::size_t link = robot_.links.size();
    robot_.links.push_back({static_cast<int>(from.link), static_cast<int>(number), from.in_link * in_near, hinge.axis, 0,
                            Vec3::Zero(), Mat3::Zero()});
    robot_.joints[number] = {fmt::format("m{}/{}", index, hinge.name),
                             static_cast<std::size_t>(index),
                             link,
                             reversed ? -hinge.hi : hinge.lo,
                             reversed ? -hinge.lo : hinge.hi,
                             hinge.passive,
                             hinge.play};
    if (reversed && hinge.passive) robot_.joints[number].passive->rest = -hinge.passive->rest;
    set_body(index, far, link, far_in_link);
  }

  /// Computes mass, COM and inertia of every link from its bodies; inertia by the parallel-axis theorem.
  void fuse() {
    for (const Body& body : robot_.bodies) {
      Link& link = robot_.links[body.link];
      link.mass += body.mass;
      link.com += body.mass * (body.in_link * body.com);
      robot_.mass += body.mass;
    }
    for (Link& link : robot_.links) {
      if (link.mass > 0) link.com /= link.mass;
    }
    for (const Body& body : robot_.bodies) {
      Link& link = robot_.links[body.link];
      const Vec3 d = body.in_link * body.com - link.com;
      link.inertia += body.in_link.R * body.inertia * body.in_link.R.transpose() +
                      body.mass * (d.squaredNorm() * Mat3::Identity() - d * d.transpose());
    }
  }

  Robot robot_;
  std::vector<std::size_t> first_joint_;
  std::map<int, std::vector<int>> children_;
};

}  // namespace

std::vector<std::size_t> joints_with_play(const Robot& robot) {
  std::vector<std::size_t> joints;
  for (std::size_t j = 0; j < robot.joints.size(); ++j) {
    if (robot.joints[j].play.any()) joints.push_back(j);
  }
  return joints;
}

Robot assemble(std::vector<ModuleType> types, const std::vector<std::size_t>& type_of_module, const std::vector<Dock>& docks) {
  check_docks(types, type_of_module, docks);
  Robot robot = Builder(std::move(types), type_of_module, {}).build(docks);
  check_cells(robot);
  return robot;
}

Robot as_built(const Robot& drawn, std::span<const ModuleBuild> modules) {
  std::vector<std::size_t> type_of_module;
  std::vector<Dock> docks;
  for (const Module& module : drawn.modules) {
    type_of_module.push_back(module.type);
    if (module.parent >= 0) docks.push_back(module.dock);
  }
  Robot built = Builder(drawn.types, type_of_module, modules).build(docks);
  built.stated_legs = drawn.stated_legs;
  return built;
}

std::vector<ContactElement> contact_elements(const Robot& robot, ContactSet on) {
  std::vector<ContactElement> elements;
  if (on == ContactSet::none) return elements;
  std::vector<bool> has_children(robot.modules.size(), false);
  for (const Module& module : robot.modules) {
    if (module.parent >= 0) has_children[static_cast<std::size_t>(module.parent)] = true;
  }
  for (std::size_t b = 0; b < robot.bodies.size(); ++b) {
    const Body& body = robot.bodies[b];
    if (on == ContactSet::feet && (has_children[body.module] || !body.free)) continue;
    const ModuleType& type = robot.types[robot.modules[body.module].type];
    int points = 0;
    int spheres = 0;
    for (const ContactType& contact : on == ContactSet::feet ? type.feet : type.all) {
      if (contact.body != body.type) continue;
      const std::string name = contact.radius > 0 ? fmt::format("s{}", spheres++) : fmt::format("p{}", points++);
      elements.push_back({body.name + "/" + name, b, body.link, body.in_link * contact.centre, contact.radius,
                          robot.modules[body.module].build.friction});
    }
  }
  return elements;
}

std::vector<std::vector<ContactElement>> contact_elements_by_body(const Robot& robot, ContactSet on) {
  std::vector<std::vector<ContactElement>> all(robot.bodies.size());
  for (ContactElement& element : contact_elements(robot, on)) {
    const std::size_t body = element.body;
    all[body].push_back(std::move(element));
  }
  return all;
}

RobotInfo info(const Robot& robot) {
  const Kinematics kinematics = at_zero(robot);
  const auto array = [](const Vec3& v) { return std::array<double, 3>{v.x(), v.y(), v.z()}; };
  RobotInfo result;
  for (const Joint& joint : robot.joints) {
    const Link& link = robot.links[joint.link];
    const int parent = robot.links[static_cast<std::size_t>(link.parent)].joint;
    result.joints.push_back({joint.name, static_cast<std::int64_t>(joint.module), parent, joint.lo, joint.hi,
                             array(kinematics.p[joint.link]), array(kinematics.R[joint.link] * link.axis), joint.driven()});
  }
  for (std::size_t m = 0; m < robot.modules.size(); ++m) {
    const Module& module = robot.modules[m];
    const ModuleType& type = robot.types[module.type];
    const Body& root = robot.bodies[module.first_body + type.root];
    const Mat3 R = kinematics.R[root.link] * root.in_link.R;
    ModuleInfo one{type.name, module.parent, -1, {}, array(kinematics.point(root.link, root.in_link.p)), {}, {}, {}, {}};
    for (int i = 0; i < 9; ++i) one.rotation[static_cast<std::size_t>(i)] = R(i / 3, i % 3);
    for (const std::size_t joint : module.joints) one.joints.push_back(static_cast<std::int64_t>(joint));
    if (module.parent >= 0) {
      const Module& parent = robot.modules[static_cast<std::size_t>(module.parent)];
      const FaceType& face = *find_face(robot.types[parent.type], module.dock.parent_face);
      const Body& on = robot.bodies[parent.first_body + face.body];
      one.parent_face = face.id;
      one.normal = array(kinematics.R[on.link] * (on.in_link.R * face.normal));
    }
    result.modules.push_back(std::move(one));
  }
  for (const Body& body : robot.bodies) result.bodies.push_back({body.name, static_cast<std::int64_t>(body.module)});
  for (std::size_t m = 0; m < robot.modules.size();
       ++m) {  // in a second loop, because a parent may have a higher number than its child
    const int parent = robot.modules[m].parent;
    if (parent >= 0) result.modules[static_cast<std::size_t>(parent)].children.push_back(static_cast<std::int64_t>(m));
  }
  for (const ContactElement& foot : contact_elements(robot, ContactSet::feet)) {
    result.modules[robot.bodies[foot.body].module].feet.push_back(array(kinematics.point(foot.link, foot.centre)));
  }
  result.legs = legs_of(robot, std::vector<double>(robot.joints.size(), 0.0), Mat3::Identity());
  return result;
}

}  // namespace gaitlab
