// Random robots, states, motors and contact laws. Robots consist of modules of the shipped type and of random types, which are
// docked and numbered at random. The C++ standard defines the bits of std::mt19937, so that a seed gives the same robot on all
// platforms. No two arguments of one call draw numbers, because the compiler chooses the order of arguments.
#pragma once
#include <algorithm>
#include <numeric>
#include <random>
#include <string>
#include <vector>

#include "actuators/dc_motor.h"
#include "core/math/functions.h"
#include "core/model/kinematics.h"
#include "core/robot_files/module_file.h"
#include "core/scenario/scenario.h"
#include "tests/folders.h"

namespace gaitlab::test {

class RandomRobots {
 public:
  explicit RandomRobots(std::uint32_t seed) : bits_(seed) {}

  double uniform(double lo, double hi) { return lo + (hi - lo) * (static_cast<double>(bits_()) / 4294967296.0); }
  /// Number between lo and hi whose logarithm is uniformly distributed.
  double scaled(double lo, double hi) { return lo * math::pow(hi / lo, uniform(0, 1)); }
  std::size_t below(std::size_t n) { return static_cast<std::size_t>(bits_()) % n; }
  Vec3 vector(double size) { return {uniform(-size, size), uniform(-size, size), uniform(-size, size)}; }
  Vec3 direction() {
    for (;;) {
      const Vec3 v = vector(1);
      if (v.norm() > 0.1 && v.norm() < 1) return v.normalized();
    }
  }
  Mat3 rotation() {
    const Vec3 axis = direction();
    return turn(axis, uniform(-3, 3)).toRotationMatrix();
  }
  template <class T>
  void shuffle(std::vector<T>& list) {
    for (std::size_t i = list.size(); i > 1; --i) std::swap(list[i - 1], list[below(i)]);
  }

  /// Robot of 1 to `largest` modules. The root has number 0, other numbers are in random order. Half of the robots have modules
  /// of random types.
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
      } catch (const InputError&) {  // two blocks occupy one cell; the next robot is tried
      }
    }
  }

  /// Module type: a tree of 2 to 5 bodies with random hinges, inertia tensors and faces. A body between two hinges may be
  /// massless.
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
      const std::size_t on = below(2) == 1 ? 0 : count - 1;  // the first and the last body are never massless
      t.faces.push_back({id, on, id < 3 ? Gender::active : Gender::passive, vector(0.1), R.col(0), R.col(1)});
    }
    for (const std::size_t on : {count - 1, std::size_t{0}, count - 1}) {
      t.all.push_back({on, vector(0.1), below(2) == 1 ? uniform(0.01, 0.05) : 0});
    }
    t.feet = {t.all.front()};
    return t;
  }

  /// Random motors, one per joint, with torques between 1 % and 100 % of the torque of the shipped motor. A third of the motors
  /// is mostly at its current limit, and half have a rotor inertia. Gears are as in the paper or directional. The damping by
  /// back-EMF is at most about equal to the damping of the shipped motor (0.9 N m s). A directional gear damps more, so that
  /// the step of an explicit method must suit the decay rate.
  actuators::DcMotorActuator::Settings motors(std::size_t joints) {
    actuators::DcMotorActuator::Settings m;
    const auto each = [&](PerJoint& value, const auto& draw) {
      value.each.clear();
      for (std::size_t j = 0; j < joints; ++j) value.each.push_back(draw());
    };
    each(m.R, [&] { return uniform(4, 20); });
    each(m.Kt, [&] { return scaled(0.002, 0.004); });
    m.Ks = m.Kt;
    each(m.gear, [&] { return scaled(60, 600); });
    each(m.efficiency, [&] { return uniform(0.4, 0.75); });
    each(m.u_max, [&] { return uniform(2, 12); });
    each(m.i_max, [&] { return below(3) == 0 ? uniform(0.02, 0.2) : uniform(0.5, 3); });
    each(m.rotor_inertia, [&] { return below(2) == 0 ? 0 : scaled(1e-10, 1e-8); });
    m.efficiency_model = below(2) == 0 ? actuators::EfficiencyModel::paper : actuators::EfficiencyModel::directional;
    m.turn_speed = scaled(0.3, 3);
    return m;
  }

  /// Random contact law: stiffness up to twice the default, linear or nonlinear, with or without damping. Friction is viscous
  /// below a speed of 10 (the default) to 100 mm/s. Damping exponents between 0 and 0.5 are excluded, because with these a
  /// depth of the size of rounding errors causes a force.
  PenaltyContact contact() {
    PenaltyContact law;
    law.k = below(3) == 0 ? uniform(1, 1.5) : 1;
    law.kn = scaled(2e3, 2e4);
    const std::size_t damping = below(5);
    law.d = damping == 0 ? 0 : damping == 1 ? uniform(0.5, 1.5) : 1;
    law.cd = damping == 0 ? scaled(1, 30) : damping == 2 ? 0 : scaled(1e3, 1e5);  // p^d is small at depths p of some mm
    law.v_lim = scaled(0.01, 0.1);
    return law;
  }
  /// Random friction coefficient of a ground; 0 in a fifth of the cases.
  double friction() { return below(5) == 0 ? 0 : scaled(0.05, 3); }

  /// Random state with angles within the stops and joint speeds up to 3 rad/s. The base has a random pose and, unless it is
  /// fixed, random velocities. The velocities of a planar base are in its plane.
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
    static const ModuleType type =
        read_module_file(std::string(gaitlab::test::source_folder()) + "/scenarios/modules/mtran.yaml").type;
    return type;
  }

  /// Body with the inertia tensor of a random box in a random orientation. Such moments obey the triangle inequality, as the
  /// moments of every physical body do.
  BodyType body(const std::string& name) {
    const Vec3 half{uniform(0.02, 0.1), uniform(0.02, 0.1), uniform(0.02, 0.1)};
    const double mass = uniform(0.1, 0.5);
    const Vec3 square = half.cwiseProduct(half);
    const Mat3 moments = (mass / 3 * (Vec3::Constant(square.sum()) - square)).asDiagonal();
    const Mat3 R = rotation();
    return {name, mass, vector(0.05), R * moments * R.transpose(), {}};
  }

  /// Random docks. Each module is docked to a random earlier module. The numbers of modules and the order of rows are random.
  std::vector<Dock> docks(const std::vector<ModuleType>& types, const std::vector<std::size_t>& type_of) {
    std::vector<std::size_t> number(type_of.size() - 1);
    std::iota(number.begin(), number.end(), 1);
    shuffle(number);
    number.insert(number.begin(), 0);
    std::vector<Dock> rows;
    std::vector<std::vector<bool>> taken(type_of.size(), std::vector<bool>(6, false));
    for (std::size_t i = 1; i < number.size(); ++i) {
      const std::size_t child = number[i];
      std::size_t parent = 0;
      std::size_t child_face = 0;
      std::size_t parent_face = 0;
      do {  // the earlier modules always have a free face, because a module has six faces and takes one
        parent = number[below(i)];
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
    shuffle(rows);
    return rows;
  }

  std::mt19937 bits_;
};

}  // namespace gaitlab::test
