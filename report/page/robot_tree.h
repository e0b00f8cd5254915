// A robot in a page: a tree of bodies with their shapes and faces, in JSON.
#pragma once
#include <nlohmann/json_fwd.hpp>
#include <vector>

#include "core/model/robot.h"

namespace gaitlab::report {

/// [x, y, z]
nlohmann::ordered_json json_of(const Vec3& v);
/// [x, y, z, qw, qx, qy, qz]
nlohmann::ordered_json json_of(const Pose& pose);

/// The bodies of a robot in an order in which each body comes after its parent. `parent` and `body` in the page are indices in
/// that order.
class RobotTree {
 public:
  explicit RobotTree(const Robot& robot);
  /// Index of a body of Robot::bodies.
  [[nodiscard]] std::size_t place(std::size_t body) const { return place_[body]; }
  /// The body of Robot::bodies that a joint moves.
  [[nodiscard]] std::size_t moved_by(std::size_t joint) const;

  /// Bodies. A body's pose is its parent's * pre * turn(axis, angle of joint) * post; for the base without a parent's.
  [[nodiscard]] nlohmann::ordered_json bodies() const;
  /// Shapes and faces by `type/body`, as in BodyType and FaceType.
  [[nodiscard]] nlohmann::ordered_json geometry() const;
  [[nodiscard]] nlohmann::ordered_json faces() const;
  /// One dock for each module except the first, in the order of their numbers.
  [[nodiscard]] nlohmann::ordered_json docks() const;

 private:
  struct Hung {
    int parent = -1;  ///< of Robot::bodies
    int joint = -1;
    Pose pre = {}, post = {};
    Vec3 axis = Vec3::Zero();
  };
  [[nodiscard]] Hung hung(std::size_t body) const;
  [[nodiscard]] std::size_t body_in(std::size_t module, std::size_t link) const;

  const Robot& robot_;
  std::vector<std::size_t> order_, place_;
};

}  // namespace gaitlab::report
