// A robot in the data of a page, as a tree of bodies with shapes and faces in JSON.
#pragma once
#include <nlohmann/json_fwd.hpp>
#include <vector>

#include "core/model/robot.h"

namespace gaitlab::report {

/// Array [x, y, z].
nlohmann::ordered_json json_of(const Vec3& v);
/// Array [x, y, z, qw, qx, qy, qz].
nlohmann::ordered_json json_of(const Pose& pose);

/// The bodies of a robot, sorted so that each parent precedes its children. The members `parent` and `body` in the page are
/// indices in this order.
class RobotTree {
 public:
  explicit RobotTree(const Robot& robot);
  /// Index that the page uses for a body; `body` is its index in Robot::bodies.
  [[nodiscard]] std::size_t place(std::size_t body) const { return place_[body]; }
  /// Index in Robot::bodies of the body that a joint moves.
  [[nodiscard]] std::size_t moved_by(std::size_t joint) const;

  /// List of bodies. The pose of a body is parent's pose * pre * turn(axis, joint angle) * post. The parent's pose is left out
  /// for the base.
  [[nodiscard]] nlohmann::ordered_json bodies() const;
  /// Shapes and faces, as objects by `type/body`, with the members of BodyType and FaceType.
  [[nodiscard]] nlohmann::ordered_json geometry() const;
  [[nodiscard]] nlohmann::ordered_json faces() const;
  /// List of docks, one for each module except the first, in the order of the modules.
  [[nodiscard]] nlohmann::ordered_json docks() const;

 private:
  struct Hung {
    int parent = -1;  ///< index in Robot::bodies
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
