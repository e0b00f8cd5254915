#include "interchange/gltf.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <limits>
#include <map>
#include <numbers>

#include "core/errors.h"
#include "core/model/kinematics.h"
#include "interchange/glb.h"
#include "interchange/motion.h"

namespace gaitlab::interchange {

namespace {

using namespace interchange;
using nlohmann::json;

constexpr double kFullFile = 4e9;  // bytes in the buffer; sizes in the file are 32 bit numbers

json list(std::initializer_list<double> numbers) {
  json made = json::array();
  for (const double x : numbers) made.push_back(x + 0.0);  // adding 0 turns -0 into 0
  return made;
}

json node(const std::string& name, const Pose& pose) {
  const Quat q = Quat(pose.R).normalized();
  return {{"name", name},
          {"translation", list({pose.p.x(), pose.p.y(), pose.p.z()})},
          {"rotation", list({q.x(), q.y(), q.z(), q.w()})}};
}

const char* role_name(Role role) {
  switch (role) {
    case Role::active:
      return "active block";
    case Role::link:
      return "link";
    case Role::passive:
      return "passive block";
    case Role::other:
      break;
  }
  return "body";
}

/// Largest distance of any point of a body's shapes from the body's origin, m (upper bound).
double reach(const BodyType& type) {
  double most = 0;
  for (const Shape& shape : type.shapes) most = std::max(most, shape.in_body.p.norm() + shape.size.norm());
  return most;
}

class GltfScene {
 public:
  GltfScene(const Scenario& s, RobotMotion motion, const GltfLook& look)
      : s_(s), robot_(*s.robot), motion_(std::move(motion)), look_(look) {}

  Gltf write() {
    const Pose y_up{turn(Vec3::UnitX(), -std::numbers::pi / 2).toRotationMatrix(), Vec3::Zero()};
    const std::size_t world = file_.add("nodes", node("world", y_up));
    json inside = json::array();
    if (s_.ground.exists()) inside.push_back(write_ground());
    for (std::size_t b = 0; b < motion_.boxes.size(); ++b) inside.push_back(write_box(b));
    inside.push_back(write_links());
    file_.at("nodes", world)["children"] = inside;
    file_.add("scenes", {{"name", s_.name}, {"nodes", json::array({world})}});
    if (!channels_.empty()) file_.add("animations", {{"name", s_.name}, {"channels", channels_}, {"samplers", samplers_}});
    if (static_cast<double>(file_.size()) > kFullFile)
      throw InputError(s_.place("duration"), "the run is too long for a .glb file, which holds at most 4 GiB");
    return {file_.finish(look_.generator), motion_.frames()};
  }

 private:
  [[nodiscard]] const ModuleType& module_type(const Body& body) const { return robot_.types[robot_.modules[body.module].type]; }

  std::size_t colour(const std::string& name, std::string_view colour) {
    const auto [found, is_new] = materials_.try_emplace(name, 0);
    if (is_new) found->second = file_.add("materials", material(name, colour));
    return found->second;
  }

  std::size_t write_mesh(const std::string& name, const Mesh& mesh, std::size_t material) {
    return file_.add("meshes",
                     {{"name", name}, {"primitives", json::array({primitive(vertices(mesh), mesh.triangles, material)})}});
  }
  json vertices(const Mesh& mesh) {
    return {{"POSITION", file_.vectors(mesh.places)}, {"NORMAL", file_.vectors(mesh.normals)}};
  }
  json primitive(const json& vertices, const Triangles& triangles, std::size_t material) {
    return {{"attributes", vertices}, {"indices", file_.indices(triangles)}, {"material", material}};
  }

  /// Area under the robot's path, extended by the robot's size on each side.
  [[nodiscard]] Area walked() const {
    constexpr double kInfinity = std::numeric_limits<double>::infinity();
    Area area{kInfinity, -kInfinity, kInfinity, -kInfinity};
    const auto add = [&area](const Vec3& p, double around) {
      area = {std::min(area.x_lo, p.x() - around), std::max(area.x_hi, p.x() + around), std::min(area.y_lo, p.y() - around),
              std::max(area.y_hi, p.y() + around)};
    };
    Kinematics k(robot_);
    k.update(robot_, motion_.state(0));
    double size = 0;
    for (const Body& body : robot_.bodies) {
      const Vec3 place = k.point(body.link, body.in_link.p);
      size = std::max(size, (place - k.p[0]).norm() + reach(module_type(body).bodies[body.type]));
    }
    for (const Vec3& place : motion_.base.places) add(place, 2 * size);
    for (std::size_t b = 0; b < motion_.boxes.size(); ++b) {
      for (const Vec3& place : motion_.boxes[b].places) add(place, s_.ground.boxes()[b].size.norm());
    }
    return area;
  }

  std::size_t write_ground() {
    json drawn = node("ground", {});
    const std::size_t light = colour("ground", look_.ground);
    const Heightfield* relief = s_.ground.relief();
    const Tiles floor = relief != nullptr ? tiles(*relief, walked()) : tiles(walked());
    const std::string name = fmt::format("ground, tiles of {} m", floor.edge);
    const json shared = vertices(floor.light);
    json primitives = json::array({primitive(shared, floor.light.triangles, light)});
    if (!floor.dark.empty())
      primitives.push_back(primitive(shared, floor.dark, colour("ground, every second tile", look_.tile)));
    drawn["mesh"] = file_.add("meshes", {{"name", name}, {"primitives", primitives}});
    return file_.add("nodes", drawn);
  }

  /// Adds the node of a box. All boxes use one cube mesh, which is scaled.
  std::size_t write_box(std::size_t number) {
    const Box& box = s_.ground.boxes()[number];
    const bool moves = box.mass > 0;
    std::size_t& cube = cubes_[moves ? 1 : 0];
    if (cube == 0) {
      Mesh mesh;
      add(mesh, {Shape::Kind::box, {}, Vec3::Ones()});
      const std::string name = moves ? "box that moves" : "box";
      cube = 1 + write_mesh(name, mesh, colour(name, moves ? look_.moving_box : look_.box));
    }
    const Way& way = motion_.boxes[number];
    json drawn = node(fmt::format("ground.boxes[{}]", number), {way.turns[0].toRotationMatrix(), way.places[0]});
    drawn["scale"] = list({box.size.x(), box.size.y(), box.size.z()});
    drawn["mesh"] = cube - 1;
    const std::size_t made = file_.add("nodes", drawn);
    move(made, way.places);
    turn_by(made, way.turns);
    return made;
  }

  /// Adds the nodes of the links. Returns the node of the base.
  std::size_t write_links() {
    std::vector<std::size_t> nodes;
    for (std::size_t l = 0; l < robot_.links.size(); ++l) nodes.push_back(l == 0 ? write_base() : write_joint(robot_.links[l]));
    std::vector<json> children(nodes.size(), json::array());
    for (std::size_t l = 1; l < nodes.size(); ++l)
      children[static_cast<std::size_t>(robot_.links[l].parent)].push_back(nodes[l]);
    for (const Body& body : robot_.bodies) children[body.link].push_back(write_body(body));
    for (std::size_t l = 0; l < nodes.size(); ++l) file_.at("nodes", nodes[l])["children"] = children[l];
    return nodes[0];
  }

  std::size_t write_base() {
    const Way& way = motion_.base;
    const std::size_t made = file_.add("nodes", node("base", {way.turns[0].toRotationMatrix(), way.places[0]}));
    move(made, way.places);
    turn_by(made, way.turns);
    return made;
  }

  std::size_t write_joint(const Link& link) {
    const auto joint = static_cast<std::size_t>(link.joint);
    const Quat still = Quat(link.in_parent.R).normalized();
    std::vector<Quat> turns;
    for (const double angle : motion_.angles[joint]) turns.push_back((still * turn(link.axis, angle)).normalized());
    const std::string name = "joint " + robot_.joints[joint].name;
    const std::size_t made = file_.add("nodes", node(name, {turns[0].toRotationMatrix(), link.in_parent.p}));
    turn_by(made, turns);
    return made;
  }

  std::size_t write_body(const Body& body) {
    json drawn = node(body.name, body.in_link);
    const ModuleType& type = module_type(body);
    const BodyType& kind = type.bodies[body.type];
    if (!kind.shapes.empty()) {
      const std::string name = type.name + "/" + kind.name;
      const auto [mesh, is_new] = meshes_.try_emplace({robot_.modules[body.module].type, body.type}, 0);
      if (is_new) {
        Mesh whole;
        for (const Shape& shape : kind.shapes) add(whole, shape);
        const Role role = role_of(type, body.type);
        mesh->second = write_mesh(name, whole, colour(role_name(role), look_.body(role)));
      }
      drawn["mesh"] = mesh->second;
    }
    return file_.add("nodes", drawn);
  }

  void move(std::size_t node, const std::vector<Vec3>& places) {
    std::vector<float> numbers;
    for (const Vec3& p : places) {
      for (const double x : p) numbers.push_back(static_cast<float>(x));
    }
    animate(node, "translation", numbers, 3);
  }
  /// Animates the rotation of a node. Eigen and glTF store quaternions in the same order, x y z w.
  void turn_by(std::size_t node, const std::vector<Quat>& turns) {
    std::vector<float> numbers;
    for (const Quat& q : turns) {
      for (const double x : q.coeffs()) numbers.push_back(static_cast<float>(x));
    }
    animate(node, "rotation", numbers, 4);
  }

  /// Adds an animation channel. A value that never changes does not have a channel, because the node already contains it.
  void animate(std::size_t node, const char* path, const std::vector<float>& numbers, std::size_t width) {
    const auto moved = [&](std::size_t i) { return numbers[i] != numbers[i % width]; };
    bool any = false;
    for (std::size_t i = width; i < numbers.size() && !any; ++i) any = moved(i);
    if (!any) return;
    if (samplers_.empty()) times_ = file_.floats(motion_.times, 1);
    channels_.push_back({{"sampler", samplers_.size()}, {"target", {{"node", node}, {"path", path}}}});
    samplers_.push_back({{"input", times_}, {"output", file_.floats(numbers, width)}});
  }

  const Scenario& s_;
  const Robot& robot_;
  RobotMotion motion_;
  const GltfLook& look_;
  Glb file_;
  std::map<std::string, std::size_t> materials_;                       ///< index of each material, by its name
  std::map<std::pair<std::size_t, std::size_t>, std::size_t> meshes_;  ///< index of each mesh, by module type and body type
  std::array<std::size_t, 2> cubes_{};                                 ///< mesh index + 1 of fixed and moving boxes; 0 if none
  std::size_t times_ = 0;                                              ///< accessor of the times of the keyframes
  json channels_ = json::array(), samplers_ = json::array();
};

}  // namespace

Gltf to_gltf(const Scenario& scenario, const Recording* recording, const GltfLook& look) {
  RobotMotion moves = recording != nullptr ? motion(scenario, *recording, kGltfRate) : standing(scenario);
  return GltfScene(scenario, std::move(moves), look).write();
}

std::vector<std::string> bodies_without_shape(const Robot& robot) {
  std::vector<std::string> names;
  for (const Body& body : robot.bodies) {
    if (robot.types[robot.modules[body.module].type].bodies[body.type].shapes.empty()) names.push_back(body.name);
  }
  return names;
}

std::vector<std::size_t> boxes_without_way(const Scenario& scenario, const Recording& recording) {
  std::vector<std::size_t> numbers;
  for (std::size_t b = 0; b < scenario.ground.boxes().size(); ++b) {
    if (scenario.ground.boxes()[b].mass > 0 && !has_way(recording, b)) numbers.push_back(b);
  }
  return numbers;
}

}  // namespace gaitlab::interchange
