#include "interchange/urdf_bodies.h"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <set>

#include "core/settings/wording.h"
#include "interchange/robot_xml.h"
#include "interchange/urdf.h"

namespace gaitlab::interchange {

namespace {

Vec3 vec(const urdf::Vector3& v) { return {v.x, v.y, v.z}; }

Pose pose_of(const urdf::Pose& pose) {
  const urdf::Rotation& r = pose.rotation;
  return {Quat(r.w, r.x, r.y, r.z).toRotationMatrix(), vec(pose.position)};
}

const char* type_name(int type) {
  switch (type) {
    case urdf::Joint::PRISMATIC:
      return "prismatic";
    case urdf::Joint::FLOATING:
      return "floating";
    case urdf::Joint::PLANAR:
      return "planar";
    default:
      return "of an unknown type";
  }
}

/// Mass of a link, in the frame of its body.
struct UrdfMass {
  double mass;
  Vec3 com;
  Mat3 inertia;
};

/// Sum of the masses. A single mass is returned unchanged, to the last digit.
UrdfMass united_mass(const std::vector<UrdfMass>& parts) {
  if (parts.size() == 1) return parts.front();
  UrdfMass whole{0, Vec3::Zero(), Mat3::Zero()};
  for (const UrdfMass& part : parts) {
    whole.mass += part.mass;
    whole.com += part.mass * part.com;
  }
  if (whole.mass > 0) whole.com /= whole.mass;
  for (const UrdfMass& part : parts) {
    const Vec3 d = part.com - whole.com;
    whole.inertia += part.inertia + part.mass * (d.squaredNorm() * Mat3::Identity() - d * d.transpose());
  }
  return whole;
}

/// Names for the module file from the names in URDF, in the same order. Prefixes such as `m0/` are removed if all names then
/// still differ, characters that are not allowed become _, and equal names are numbered.
std::vector<std::string> allowed_names(const std::vector<std::string>& names) {
  std::set<std::string> seen;
  for (const std::string& name : names) seen.insert(name.substr(name.rfind('/') + 1));
  const bool unique = seen.size() == names.size();
  seen = {"dock"};  // name reserved for docks
  std::vector<std::string> allowed;
  for (const std::string& name : names) {
    std::string text = unique ? name.substr(name.rfind('/') + 1) : name;
    std::erase_if(text, [](char c) { return (static_cast<unsigned char>(c) & 0xC0) == 0x80; });  // one _ for each UTF-8 letter
    for (char& c : text) c = is_name(std::string(1, c), "_-") ? c : '_';
    text = text.empty() ? "part" : text.substr(0, 90);
    std::string one = text;
    for (int n = 2; !seen.insert(one).second; ++n) one = fmt::format("{}_{}", text, n);
    allowed.push_back(one);
  }
  return allowed;
}

class BodyWalk {
 public:
  BodyWalk(const UrdfText& urdf, Problems& problems) : urdf_(urdf), problems_(problems) {}

  UrdfBodies read() {
    const urdf::Link* const root = first_link();
    open_.push_back({root, add_body(*root), {}});
    while (!open_.empty()) {
      const Placed at = open_.back();
      open_.pop_back();
      read_link(at);
    }
    finish();
    return std::move(made_);
  }

 private:
  /// A link, its body, and its pose in that body.
  struct Placed {
    const urdf::Link* link;
    std::size_t body;
    Pose pose;
  };

  /// The root, or the link that floats above a root without mass. Adds a note if a root `world` fixes the base.
  const urdf::Link* first_link() {
    const urdf::Link* const root = urdf_.model().getRoot().get();
    if (root->inertial != nullptr || root->child_joints.size() != 1) return root;
    const urdf::Joint& joint = *root->child_joints.front();
    if (joint.type == urdf::Joint::FLOATING) {
      made_.notes.push_back(fmt::format("link {} and floating joint {}: the base of a scenario floats by default",
                                        in_quotes(root->name), in_quotes(joint.name)));
      return urdf_.model().getLink(joint.child_link_name).get();
    }
    if (joint.type == urdf::Joint::FIXED && root->name == "world")
      made_.notes.push_back("the fixed base of link 'world'; a scenario fixes the base with robot: {base: fixed}");
    return root;
  }

  std::size_t add_body(const urdf::Link& link) {
    made_.bodies.push_back({link.name});
    masses_.emplace_back();
    return made_.bodies.size() - 1;
  }

  void wrong(const urdf::Joint& joint, const std::string& what) {
    problems_.add(urdf_.place("joint", joint.name), "joint " + in_quotes(joint.name) + " " + what);
  }

  void read_link(const Placed& at) {
    const urdf::Link& link = *at.link;
    if (link.inertial != nullptr) add_mass(*link.inertial, at);
    if (link.inertial != nullptr && masses_[at.body].size() == 1) made_.bodies[at.body].name = link.name;
    add_shapes(at);
    std::vector<Placed> next;
    for (const urdf::JointSharedPtr& joint : link.child_joints) {
      const urdf::LinkConstSharedPtr child = urdf_.model().getLink(joint->child_link_name);
      const Pose pose = at.pose * pose_of(joint->parent_to_joint_origin_transform);
      if (joint->type == urdf::Joint::FIXED) {
        next.push_back({child.get(), at.body, pose});
        continue;
      }
      const std::size_t body = add_body(*child);
      add_hinge(*joint, at.body, body, pose);
      next.push_back({child.get(), body, {}});
    }
    open_.insert(open_.end(), next.rbegin(), next.rend());  // open_ is a stack, from which the first of `next` is taken first
  }

  void add_mass(const urdf::Inertial& in, const Placed& at) {
    const Pose pose = at.pose * pose_of(in.origin);
    Mat3 inertia;
    inertia << in.ixx, in.ixy, in.ixz, in.ixy, in.iyy, in.iyz, in.ixz, in.iyz, in.izz;
    if (!pose.R.isIdentity(0)) inertia = Mat3(pose.R * inertia * pose.R.transpose());
    masses_[at.body].push_back({in.mass, pose.p, inertia});
  }

  void add_hinge(const urdf::Joint& joint, std::size_t parent, std::size_t child, const Pose& pose) {
    UrdfHinge made;
    made.hinge = {joint.name, parent, child, pose, vec(joint.axis)};
    const bool free = joint.type == urdf::Joint::CONTINUOUS;
    if (!free && joint.type != urdf::Joint::REVOLUTE) {
      return wrong(joint, fmt::format("is {}; a module has revolute, continuous and fixed joints", type_name(joint.type)));
    }
    if (joint.mimic != nullptr)
      wrong(joint, fmt::format("mimics {}; every hinge of a module moves independently", in_quotes(joint.mimic->joint_name)));
    made.hinge.lo = free ? -kNoStop : joint.limits->lower;
    made.hinge.hi = free ? kNoStop : joint.limits->upper;
    add_motor(joint, made);
    made_.hinges.push_back(made);
  }

  void add_motor(const urdf::Joint& joint, UrdfHinge& made) {
    const urdf::JointDynamics none{};
    const urdf::JointDynamics& dynamics = joint.dynamics == nullptr ? none : *joint.dynamics;
    if (joint.limits == nullptr) {
      return wrong(joint, "has no limit; expected effort and velocity of its motor, or effort 0 for a joint without a motor");
    }
    if (joint.limits->effort == 0) {
      made.hinge.passive = Passive{.damping = dynamics.damping, .friction = dynamics.friction};
      return;
    }
    made.effort = joint.limits->effort;
    made.speed = joint.limits->velocity;
    const auto check = [&](const char* key, double value, const char* what) {
      if (value > 0 && value < kUnlimited) return;
      wrong(joint, fmt::format("has {} {}; expected {} of its motor, above 0 and below {}", key, number_text(value), what,
                               number_text(kUnlimited)));
    };
    check("effort", made.effort, "the torque at rest, N m,");
    check("velocity", made.speed, "the no-load speed, rad/s,");
    made.dry = dynamics.friction;
    made.viscous = dynamics.damping;
  }

  void add_shapes(const Placed& at) {
    std::vector<std::pair<Pose, urdf::GeometrySharedPtr>> seen, touched;
    for (const urdf::VisualSharedPtr& one : at.link->visual_array) seen.emplace_back(pose_of(one->origin), one->geometry);
    for (const urdf::CollisionSharedPtr& one : at.link->collision_array)
      touched.emplace_back(pose_of(one->origin), one->geometry);
    const auto meshes = [](const auto& parts) {
      return std::ranges::any_of(parts, [](const auto& part) { return part.second->type == urdf::Geometry::MESH; });
    };
    const bool drawn = !seen.empty() && (!meshes(seen) || touched.empty());
    if (!drawn && !seen.empty() && !meshes(touched))
      made_.notes.push_back("meshes of link " + in_quotes(at.link->name) + "; its collision shapes are used");
    for (const auto& [pose, geometry] : drawn ? seen : touched) add_shape(at, at.pose * pose, *geometry);
  }

  void add_shape(const Placed& at, const Pose& pose, const urdf::Geometry& geometry) {
    Shape shape{.in_body = pose};
    if (geometry.type == urdf::Geometry::BOX) {
      shape.size = vec(static_cast<const urdf::Box&>(geometry).dim);
    } else if (geometry.type == urdf::Geometry::SPHERE) {
      shape.kind = Shape::Kind::sphere;
      shape.size.x() = static_cast<const urdf::Sphere&>(geometry).radius;
    } else if (geometry.type == urdf::Geometry::CYLINDER) {
      const auto& cylinder = static_cast<const urdf::Cylinder&>(geometry);
      shape.kind = Shape::Kind::cylinder;
      shape.in_body.R = pose.R * y_from_z().transpose();
      shape.size = {cylinder.radius, cylinder.length, 0};
    } else {
      problems_.add(urdf_.place("link", at.link->name),
                    fmt::format("link {} has the mesh {}; expected box, cylinder or sphere, at least as collision",
                                in_quotes(at.link->name), in_quotes(static_cast<const urdf::Mesh&>(geometry).filename)));
      return;
    }
    made_.bodies[at.body].shapes.push_back(shape);
  }

  /// Sums the masses, reports bodies without mass, and makes names that a module file allows.
  void finish() {
    std::vector<bool> inner(made_.bodies.size(), false), moved(made_.bodies.size(), false);
    for (const UrdfHinge& one : made_.hinges) {
      inner[one.hinge.parent] = true;
      moved[one.hinge.child] = true;
    }
    std::vector<std::string> names, joints;
    for (std::size_t b = 0; b < made_.bodies.size(); ++b) {
      BodyType& body = made_.bodies[b];
      const UrdfMass whole = united_mass(masses_[b]);
      body.mass = whole.mass;
      body.com = whole.com;
      body.inertia = whole.inertia;
      if (!(body.mass > 0) && !(inner[b] && moved[b])) {
        const std::string found =
            masses_[b].empty() ? "no mass; expected inertial" : "mass " + number_text(body.mass) + " kg; expected more than 0";
        problems_.add(
            urdf_.place("link", body.name),
            fmt::format("link {} has {} (only a link between two hinges may have none)", in_quotes(body.name), found));
      }
      names.push_back(body.name);
    }
    for (const UrdfHinge& one : made_.hinges) joints.push_back(one.hinge.name);
    made_.links = std::move(names);
    made_.joints = std::move(joints);
    const std::vector<std::string> bodies = allowed_names(made_.links);
    const std::vector<std::string> hinges = allowed_names(made_.joints);
    for (std::size_t b = 0; b < bodies.size(); ++b) made_.bodies[b].name = bodies[b];
    for (std::size_t j = 0; j < hinges.size(); ++j) made_.hinges[j].hinge.name = hinges[j];
    note_names("link", made_.links, bodies);
    note_names("joint", made_.joints, hinges);
  }

  /// Adds a note on each name that was changed, other than by removing a prefix.
  void note_names(const char* what, const std::vector<std::string>& given, const std::vector<std::string>& allowed) {
    for (std::size_t i = 0; i < given.size(); ++i) {
      if (given[i] == allowed[i] || given[i].ends_with("/" + allowed[i])) continue;
      made_.notes.push_back(fmt::format("the name of {} {}, which is {} here", what, in_quotes(given[i]), allowed[i]));
    }
  }

  const UrdfText& urdf_;
  Problems& problems_;
  UrdfBodies made_;
  std::vector<std::vector<UrdfMass>> masses_;  ///< of the links of each body
  std::vector<Placed> open_;                   ///< links to read
};

}  // namespace

UrdfBodies urdf_bodies(const UrdfText& urdf, Problems& problems) {
  UrdfBodies made = BodyWalk(urdf, problems).read();
  for (const char* tag : {"transmission", "gazebo", "sensor"}) {
    if (const std::size_t number = urdf.count(tag); number > 0)
      made.notes.push_back(fmt::format("{} of <{}>", counted(number, "element"), tag));
  }
  return made;
}

}  // namespace gaitlab::interchange
