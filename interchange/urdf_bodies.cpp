#include "interchange/urdf_bodies.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <set>

#include "core/model/pattern.h"
#include "core/settings/shell_word.h"
#include "core/settings/wording.h"
#include "interchange/srdf.h"
#include "interchange/urdf_joined.h"
#include "interchange/urdf_mass.h"
#include "interchange/urdf_motor.h"
#include "interchange/urdf_shapes.h"

namespace gaitlab::interchange {

namespace {

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

class BodyWalk {
 public:
  BodyWalk(const UrdfText& urdf, const ImportOptions& options, Problems& problems)
      : urdf_(urdf), locked_(options.locked), problems_(problems), shapes_(urdf, options.meshes) {}

  /// Number of each link's body, after read().
  [[nodiscard]] const std::map<std::string, std::size_t>& body_of_link() const { return body_of_link_; }

  RobotBodies read() {
    made_.notes = urdf_.repairs();
    joined_ = joined_joints(urdf_, locked_, made_.notes, problems_);
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

  /// The root, or the link that floats above a root without mass. The base is fixed if a root without mass has the name
  /// `world` and a link joined to it, or if all its joints are locked.
  const urdf::Link* first_link() {
    const urdf::Link* const root = urdf_.model().getRoot().get();
    if (has_mass(*root) || root->child_joints.empty()) return root;
    const auto is_joined = [&](const urdf::JointSharedPtr& joint) { return joined_.contains(joint.get()); };
    const auto is_locked = [&](const urdf::JointSharedPtr& joint) {
      return joint->type != urdf::Joint::FIXED && is_joined(joint);
    };
    const urdf::Joint& joint = *root->child_joints.front();
    if (root->child_joints.size() == 1 && joint.type == urdf::Joint::FLOATING && !joined_.contains(&joint)) {
      left_out(urdf_.place("link", root->name),
               fmt::format("link {} and floating joint {}: the base of a scenario floats by default", in_quotes(root->name),
                           in_quotes(joint.name)));
      return urdf_.model().getLink(joint.child_link_name).get();
    }
    const bool fixed = root->name == "world" ? std::ranges::any_of(root->child_joints, is_joined)
                                             : std::ranges::all_of(root->child_joints, is_locked);
    if (fixed) made_.base = Base::fixed;
    return root;
  }

  std::size_t add_body(const urdf::Link& link) {
    made_.bodies.push_back({link.name});
    masses_.emplace_back();
    return made_.bodies.size() - 1;
  }

  void left_out(const SourceLocation& place, const std::string& text) { made_.notes.push_back({place, text, false}); }
  void changed(const SourceLocation& place, const std::string& text) { made_.notes.push_back({place, text, true}); }

  void read_link(const Placed& at) {
    const urdf::Link& link = *at.link;
    body_of_link_[link.name] = at.body;
    const std::vector<Shape> shapes = link_shapes(at);
    check_numbers(link, shapes, urdf_, problems_);
    if (link.inertial != nullptr) add_mass(*link.inertial, at, shapes);
    std::vector<Shape>& all = made_.bodies[at.body].shapes;
    all.insert(all.end(), shapes.begin(), shapes.end());
    std::vector<Placed> next;
    for (const urdf::JointSharedPtr& joint : link.child_joints) {
      const urdf::LinkConstSharedPtr child = urdf_.model().getLink(joint->child_link_name);
      const Pose pose = at.pose * pose_of(joint->parent_to_joint_origin_transform);
      if (joined_.contains(joint.get())) {
        next.push_back({child.get(), at.body, pose});
        continue;
      }
      const std::size_t body = add_body(*child);
      add_hinge(*joint, at.body, body, pose);
      next.push_back({child.get(), body, {}});
    }
    open_.insert(open_.end(), next.rbegin(), next.rend());  // open_ is a stack, from which the first of `next` is taken first
  }

  void add_mass(const urdf::Inertial& in, const Placed& at, const std::vector<Shape>& shapes) {
    const Pose pose = at.pose * pose_of(in.origin);
    Mat3 inertia;
    inertia << in.ixx, in.ixy, in.ixz, in.ixy, in.iyy, in.iyz, in.ixz, in.iyz, in.izz;
    if (in.mass == 0) {
      if (!inertia.isZero(0)) {
        changed(urdf_.place("link", at.link->name),
                fmt::format("link {} has mass 0; its inertia counts as 0", in_quotes(at.link->name)));
      }
      return;
    }
    if (!pose.R.isIdentity(0)) inertia = Mat3(pose.R * inertia * pose.R.transpose());
    if (masses_[at.body].empty()) made_.bodies[at.body].name = at.link->name;
    masses_[at.body].push_back({std::abs(in.mass), pose.p, inertia, at.link->name, shapes});
  }

  void add_hinge(const urdf::Joint& joint, std::size_t parent, std::size_t child, const Pose& pose) {
    RobotHinge made;
    made.hinge = {joint.name, parent, child, pose, vec(joint.axis)};
    const bool free = joint.type == urdf::Joint::CONTINUOUS;
    if (!free && joint.type != urdf::Joint::REVOLUTE) {
      refused_.push_back(&joint);
      inner_.insert(parent);
      moved_.insert(child);
      return;
    }
    if (joint.mimic != nullptr) {
      changed(urdf_.place("joint", joint.name),
              fmt::format("joint {} mimics {}; it moves independently, or is fixed by {}", in_quotes(joint.name),
                          in_quotes(joint.mimic->joint_name), lock_option({&joint})));
    }
    const bool turns = free || turns_freely(joint);
    made.hinge.lo = turns ? -kNoStop : joint.limits->lower;
    made.hinge.hi = turns ? kNoStop : joint.limits->upper;
    read_motor(joint, urdf_, made, problems_);
    made_.hinges.push_back(made);
    made_.hinge_of.push_back({joint.name, urdf_.place("joint", joint.name)});
    inner_.insert(parent);
    moved_.insert(child);
  }

  /// The options of the command that fix these joints, after those that it has.
  [[nodiscard]] std::string lock_option(const std::vector<const urdf::Joint*>& joints) const {
    std::vector<std::string> names;
    for (const std::string& one : locked_) {
      const auto fixes = [&](const auto& joint) { return joint.first == one || glob(one, joint.first); };
      if (std::ranges::any_of(urdf_.model().joints_, fixes)) names.push_back(one);
    }
    for (const urdf::Joint* const joint : joints) names.push_back(joint->name);
    std::string text;
    for (const std::string& name : names) text += (text.empty() ? "--lock " : " --lock ") + shell_word(name);
    return text;
  }

  /// Reports the joints that cannot be hinges, in the order of the file. The first message has the option that fixes all of
  /// them.
  void refuse_joints() {
    std::vector<std::pair<SourceLocation, const urdf::Joint*>> placed;
    for (const urdf::Joint* const joint : refused_) placed.emplace_back(urdf_.place("joint", joint->name), joint);
    std::ranges::stable_sort(placed, {}, [](const auto& one) { return std::pair(one.first.line, one.first.column); });
    for (std::size_t i = 0; i < placed.size(); ++i) refused_[i] = placed[i].second;
    const std::string all =
        fmt::format("; {} fixed at 0 by {}", placed.size() == 1 ? "it is" : "they are", lock_option(refused_));
    for (const auto& [place, joint] : placed) {
      problems_.add(place, fmt::format("joint {} is {}; a module has hinges{}", in_quotes(joint->name), type_name(joint->type),
                                       joint == refused_.front() ? all : ""));
    }
  }

  /// True if a joint is without a range, or has an impossible one; adds a note.
  bool turns_freely(const urdf::Joint& joint) {
    const double lo = joint.limits->lower;
    const double hi = joint.limits->upper;
    const bool none = urdf_.lacks_limit(joint.name);
    if (!none && (lo < hi || (lo == hi && lo != 0))) return false;
    const std::string what = none ? "has no limit"
                             : urdf_.lacks_range(joint.name)
                                 ? "has no range"
                                 : fmt::format("has the range {} to {}", number_text(lo), number_text(hi));
    changed(urdf_.place("joint", joint.name), fmt::format("joint {} {}; it turns freely", in_quotes(joint.name), what));
    return true;
  }

  /// Shapes that the link's collision has, which touch the ground and other bodies; those of its visual if it has no
  /// collision, if only the collision has meshes that cannot be read, or if the collision has points alone, as in our own
  /// export.
  std::vector<Shape> link_shapes(const Placed& at) {
    std::vector<UrdfPart> seen, touched;
    const auto add = [&](std::vector<UrdfPart>& parts, const auto& array, bool collision) {
      for (const auto& one : array) {
        const bool capsule = urdf_.is_capsule(at.link->name, collision, parts.size());
        parts.push_back({pose_of(one->origin), one->geometry.get(), capsule});
      }
    };
    add(seen, at.link->visual_array, false);
    add(touched, at.link->collision_array, true);
    const auto readable = [&](const UrdfPart& part) { return shapes_.readable(part); };
    const bool unread = !std::ranges::all_of(touched, readable);
    const bool drawn = !seen.empty() && std::ranges::none_of(seen, &UrdfPart::is_mesh);
    const bool points = std::ranges::all_of(touched, &UrdfPart::is_point);
    const bool visual =
        !seen.empty() && (touched.empty() || (drawn && points) || (unread && std::ranges::all_of(seen, readable)));
    if (visual && (touched.empty() || !points)) {
      changed(urdf_.place("link", at.link->name),
              fmt::format("link {} has {} collision; its visual shapes are its contact", in_quotes(at.link->name),
                          touched.empty() ? "no" : "meshes that cannot be read as"));
    }
    std::vector<Shape> shapes = shapes_of(visual ? seen : touched, at);
    if (!visual && !seen.empty() && (!drawn || differ(shapes, shapes_of(seen, at)))) hidden_.push_back(at.link);
    return shapes;
  }

  static bool differ(const std::vector<Shape>& a, const std::vector<Shape>& b) {
    return !std::ranges::equal(a, b, [](const Shape& one, const Shape& other) {
      return one.kind == other.kind && one.size == other.size && one.in_body.p == other.in_body.p &&
             one.in_body.R == other.in_body.R;
    });
  }

  /// Shapes in the frame of the link's body.
  std::vector<Shape> shapes_of(const std::vector<UrdfPart>& parts, const Placed& at) {
    std::vector<Shape> shapes;
    for (const UrdfPart& part : parts) shapes_.add(at.link->name, at.pose * part.in_link, part, shapes, made_.notes, problems_);
    return shapes;
  }

  /// Sums the masses, and reports bodies without mass.
  void finish() {
    refuse_joints();
    for (std::size_t b = 0; b < made_.bodies.size(); ++b) {
      BodyType& body = made_.bodies[b];
      repair_inertias(masses_[b], urdf_, made_.notes);
      const RobotMass whole = united_mass(masses_[b]);
      body.mass = whole.mass;
      body.com = whole.com;
      body.inertia = whole.inertia;
      const bool inner = inner_.contains(b);
      const bool moved = moved_.contains(b);
      if (body.mass == 0 && inner && !moved) {
        fix_base(body);
      } else if (!(body.mass > 0) && !(inner && moved)) {
        problems_.add(urdf_.place("link", body.name),
                      fmt::format("link {} has no mass; expected inertial (only a link between two hinges may have none)",
                                  in_quotes(body.name)));
      }
      made_.body_of.push_back({body.name, urdf_.place("link", body.name)});
    }
    if (made_.base == Base::fixed) note_base();
    choose_motors(made_, urdf_, problems_);
    shapes_.made_hulls().add_note("link", made_.notes);
    if (!hidden_.empty()) {
      const std::string first = in_quotes(hidden_.front()->name);
      left_out(urdf_.place("link", hidden_.front()->name),
               fmt::format("the visual shapes of {}; those of collision are drawn and touch",
                           hidden_.size() == 1 ? "link " + first : fmt::format("{} links, first {}", hidden_.size(), first)));
    }
  }

  /// Gives the root, which has no mass and of which a hinge moves the rest, a mass; it does not matter, because nothing moves
  /// the root.
  void fix_base(BodyType& root) {
    made_.base = Base::fixed;
    root.mass = 1;
    root.inertia = usual_inertia(root.mass, root.shapes);
    chosen_mass_ = true;
  }

  void note_base() {
    const std::string& root = urdf_.model().getRoot()->name;
    changed(urdf_.place("link", root),
            fmt::format("link {} is the ground{}: the module has no contacts, so that new scenario writes base: fixed and no "
                        "ground",
                        in_quotes(root), chosen_mass_ ? ", and has a mass of 1 kg instead of none" : ""));
  }

  const UrdfText& urdf_;
  const std::vector<std::string>& locked_;
  Problems& problems_;
  UrdfShapes shapes_;
  RobotBodies made_{{"URDF", "link", "torque and speed are the effort and velocity in "}};
  std::vector<std::vector<RobotMass>> masses_;  ///< of the links of each body
  std::vector<Placed> open_;                    ///< links to read
  std::set<const urdf::Joint*> joined_;         ///< joints whose links are one body
  std::vector<const urdf::Joint*> refused_;     ///< joints that cannot be hinges and are not joined
  std::map<std::string, std::size_t> body_of_link_;
  std::set<std::size_t> inner_, moved_;    ///< bodies that are the parent of a joint that moves; those that one moves
  bool chosen_mass_ = false;               ///< true if the mass of a fixed base is chosen
  std::vector<const urdf::Link*> hidden_;  ///< links whose visual differs from their collision
};

}  // namespace

RobotBodies urdf_bodies(const UrdfText& urdf, const ImportOptions& options, Problems& problems) {
  BodyWalk walk(urdf, options, problems);
  RobotBodies made = walk.read();
  for (const char* tag : {"transmission", "gazebo", "sensor", "safety_controller", "calibration", "contact"}) {
    if (const std::size_t number = urdf.count(tag); number > 0)
      made.notes.push_back({urdf.place(), fmt::format("{} of <{}>", counted(number, "element"), tag)});
  }
  made.finish();
  if (options.srdf.empty()) return made;
  std::map<std::string, std::string> names;
  for (const auto& [link, body] : walk.body_of_link()) names[link] = made.bodies[body].name;
  made.may_overlap = srdf_pairs(options.srdf, urdf.place().file, names, problems);
  return made;
}

}  // namespace gaitlab::interchange
