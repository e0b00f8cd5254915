// Random assemblies and states: modules of the shipped type and of types made up here, docked at random. Numbers come from the
// bits of std::mt19937, which the standard fixes, so a seed means the same robot everywhere.
#pragma once
#include <random>
#include <string>
#include <vector>

#include "core/model/kinematics.h"
#include "core/scenario/scenario.h"

namespace gaitlab::test {

class RandomRobots {
 public:
  explicit RandomRobots(std::uint32_t seed) : bits_(seed) {}

  double uniform(double lo, double hi) { return lo + (hi - lo) * (static_cast<double>(bits_()) / 4294967296.0); }
  std::size_t below(std::size_t n) { return static_cast<std::size_t>(bits_()) % n; }
  Vec3 vector(double size) { return {uniform(-size, size), uniform(-size, size), uniform(-size, size)}; }
  Vec3 direction() {
    for (;;) {
      const Vec3 v = vector(1);
      if (v.norm() > 0.1 && v.norm() < 1) return v.normalized();
    }
  }
  Mat3 rotation() { return turn(direction(), uniform(-3, 3)).toRotationMatrix(); }

  /// 1 to `largest` modules; every second robot has modules of made-up types among them.
  Robot robot(std::size_t largest = 10) { return robot_of(1 + below(largest)); }
  Robot robot_of(std::size_t count) {
    for (;;) {
      std::vector<ModuleType> types{mtran()};
      if (below(2) == 1) {
        types.push_back(type("first"));
        types.push_back(type("second"));
      }
      std::vector<std::size_t> type_of;
      for (std::size_t i = 0; i < count; ++i) type_of.push_back(below(types.size()));
      try {
        return assemble(types, type_of, docks(types, type_of));
      } catch (const InputError&) {  // two blocks in one cell: another one
      }
    }
  }

  /// A tree of 2 to 5 bodies with arbitrary hinges, tensors and faces; a body between two hinges may be massless.
  ModuleType type(const std::string& name) {
    ModuleType t;
    t.name = name;
    const std::size_t count = 2 + below(4);
    for (std::size_t b = 0; b < count; ++b) {
      t.bodies.push_back(body("b" + std::to_string(b)));
      if (b == 0) continue;
      const std::size_t parent = below(b);
      t.hinges.push_back({"h" + std::to_string(b), parent, b, {rotation(), vector(0.1)}, direction(), -3, 3});
    }
    if (count > 2 && t.hinges[1].parent == 1 && below(2) == 1) {
      t.bodies[1].mass = 0;
      t.bodies[1].inertia.setZero();
    }
    for (int id = 0; id < 6; ++id) {
      const Mat3 R = rotation();
      const std::size_t on = below(2) == 1 ? 0 : count - 1;  // bodies that have mass
      t.faces.push_back({id, on, id < 3 ? Gender::active : Gender::passive, vector(0.1), R.col(0), R.col(1)});
    }
    return t;
  }

  /// Angles within the stops, speeds up to 3 rad/s, base anywhere (planar: in its plane).
  RobotState state(const Robot& robot, Base base) {
    RobotState s;
    s.orientation = Quat(rotation());
    s.position = vector(1);
    if (base != Base::fixed) {
      s.velocity = vector(1);
      s.angular_velocity = vector(2);
    }
    if (base == Base::planar) s.velocity.y() = s.angular_velocity.x() = s.angular_velocity.z() = 0;
    for (std::size_t j = 0; j < robot.joints.size(); ++j) {
      s.q.push_back(uniform(-1.5, 1.5));
      s.qd.push_back(uniform(-3, 3));
    }
    return s;
  }

  Acceleration acceleration(const Robot& robot, Base base) {
    Acceleration a;
    if (base != Base::fixed) {
      a.linear = vector(5);
      a.angular = vector(5);
    }
    if (base == Base::planar) a.linear.y() = a.angular.x() = a.angular.z() = 0;
    for (std::size_t j = 0; j < robot.joints.size(); ++j) a.joints.push_back(uniform(-5, 5));
    return a;
  }

 private:
  static const ModuleType& mtran() {
    static const ModuleType type = read_module_file(std::string(GAITLAB_SOURCE_DIR) + "/scenarios/modules/mtran.yaml").type;
    return type;
  }

  /// A box of any shape, turned anyhow: its moments obey the triangle inequality, as those of every body do.
  BodyType body(const std::string& name) {
    const Vec3 half{uniform(0.02, 0.1), uniform(0.02, 0.1), uniform(0.02, 0.1)};
    const double mass = uniform(0.1, 0.5);
    const Vec3 square = half.cwiseProduct(half);
    const Mat3 moments = (mass / 3 * (Vec3::Constant(square.sum()) - square)).asDiagonal();
    const Mat3 R = rotation();
    return {name, mass, vector(0.05), R * moments * R.transpose(), {}};
  }

  std::vector<Dock> docks(const std::vector<ModuleType>& types, const std::vector<std::size_t>& type_of) {
    std::vector<Dock> rows;
    std::vector<std::vector<bool>> taken(type_of.size(), std::vector<bool>(6, false));
    for (std::size_t child = 1; child < type_of.size(); ++child) {
      std::size_t parent = 0;
      std::size_t child_face = 0;
      std::size_t parent_face = 0;
      do {  // a module has six faces and takes one itself: there is always a free one
        parent = below(child);
        child_face = below(6);
        parent_face = (types[type_of[child]].faces[child_face].gender == Gender::active ? 3 : 0) + below(3);
      } while (taken[parent][parent_face]);
      taken[parent][parent_face] = taken[child][child_face] = true;
      rows.push_back({static_cast<int>(child_face),
                      static_cast<int>(child),
                      static_cast<int>(parent_face),
                      static_cast<int>(parent),
                      static_cast<int>(below(4)),
                      {}});
    }
    return rows;
  }

  std::mt19937 bits_;
};

}  // namespace gaitlab::test
