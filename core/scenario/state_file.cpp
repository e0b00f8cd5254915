#include "core/scenario/state_file.h"

#include <fmt/format.h>

#include <algorithm>
#include <limits>
#include <nlohmann/json.hpp>

#include "core/files/json_place.h"
#include "core/scenario/sections.h"
#include "core/settings/reader.h"
#include "core/settings/text_file.h"
#include "core/settings/wording.h"

namespace gaitlab {

namespace {

constexpr double kLargest = std::numeric_limits<double>::max();
constexpr double kUnit = 1e-6;  // tolerance of a unit length, for numbers with six digits
constexpr Spec kMetres{"m", -kLargest, kLargest, ""};

std::span<double> entries(Vec3& v) { return {v.data(), 3}; }

struct BaseMotion {
  RobotState& state;
  Acceleration& acceleration;

  void fields(Fields& f) {
    f.vector("position", entries(state.position), kMetres);
    std::array<double, 4> q{state.orientation.w(), state.orientation.x(), state.orientation.y(), state.orientation.z()};
    f.vector("quaternion", q, {"", -kLargest, kLargest, ""});
    const Quat read(q[0], q[1], q[2], q[3]);
    if (!(std::abs(read.norm() - 1) < kUnit)) {
      f.problem("quaternion", fmt::format("quaternion has the length {}; expected 1", number_text(read.norm())));
    } else {
      state.orientation = read.normalized();
    }
    f.vector("velocity", entries(state.velocity), {"m/s", -kLargest, kLargest, ""});
    f.vector("angular_velocity", entries(state.angular_velocity), {"rad/s", -kLargest, kLargest, ""});
    f.vector("acceleration", entries(acceleration.linear), {"m/s^2", -kLargest, kLargest, ""});
    f.vector("angular_acceleration", entries(acceleration.angular), {"rad/s^2", -kLargest, kLargest, ""});
  }

  /// Checks that the base has the degrees of freedom of the motion.
  void check(Fields& f, Base base) const {
    const auto check_pair = [&](const char* linear_key, const Vec3& linear, const char* angular_key, const Vec3& angular) {
      const bool planar = base == Base::planar;
      const char* allowed = planar ? "a planar base moves along x and z and turns about y" : "a fixed base does not move";
      if (planar ? linear.y() != 0 : linear != Vec3::Zero()) f.problem(linear_key, allowed);
      if (planar ? angular.x() != 0 || angular.z() != 0 : angular != Vec3::Zero()) f.problem(angular_key, allowed);
    };
    if (base == Base::floating) return;
    check_pair("velocity", state.velocity, "angular_velocity", state.angular_velocity);
    check_pair("acceleration", acceleration.linear, "angular_acceleration", acceleration.angular);
  }
};

struct WrenchFields {
  std::string body = {};
  Vec3 point = Vec3::Constant(std::numeric_limits<double>::quiet_NaN());  ///< NaN if not given
  Vec3 force = Vec3::Zero(), torque = Vec3::Zero();

  void fields(Fields& f) {
    f.text("body", body, "");
    f.vector("point", entries(point), kMetres);
    f.vector("force", entries(force), {"N", -kLargest, kLargest, ""});
    f.vector("torque", entries(torque), {"N m", -kLargest, kLargest, ""});
  }
};

/// Parses a JSON text. nlohmann's parser checks that the text is JSON. The YAML parser, which accepts JSON, then gives the
/// places.
Node parse_json(std::string text, const std::string& file) {
  try {
    [[maybe_unused]] const auto json = nlohmann::json::parse(text);
  } catch (const nlohmann::json::parse_error& e) {
    // The message has the form: [json.exception.parse_error.101] parse error at line 1, column 2: syntax error while parsing
    // value - unexpected ...
    const std::string what = e.what();
    const std::size_t dash = what.find(" - ");
    throw InputError(json_place(file, text, e.byte),
                     "not valid JSON" + (dash == std::string::npos ? "" : ": " + clipped(what.substr(dash + 3))));
  } catch (const nlohmann::json::out_of_range&) {
    // A number exceeds the range of a double. The problem is reported with its place when the number is read.
  }
  // In JSON a tab is always between tokens, but YAML does not allow tabs everywhere.
  std::replace(text.begin(), text.end(), '\t', ' ');
  return parse_yaml(text, file);
}

void read_joints(Reader& reader, const char* key, const char* unit, std::vector<double>& values) {
  PerJoint read{0, values};
  reader.per_joint(key, read, {unit, -kLargest, kLargest, ""});
  for (std::size_t j = 0; j < values.size(); ++j) values[j] = read[j];
}

void read_wrenches(Reader& reader, const Node& root, const Robot& robot, const Kinematics& k, Problems& problems,
                   std::vector<BodyWrench>& wrenches) {
  std::vector<WrenchFields> read;
  static_cast<Fields&>(reader).list("wrenches", read, "");
  std::vector<std::string> names;
  for (const Body& body : robot.bodies) names.push_back(body.name);
  for (std::size_t i = 0; i < read.size(); ++i) {
    const Node& node = root.find("wrenches")->items[i];
    const Node* name = node.find("body");
    const auto at = std::find(names.begin(), names.end(), read[i].body);
    if (name == nullptr && node.kind == Node::Kind::map) {
      problems.add(node.place, "missing key 'body'");
    } else if (name != nullptr && at == names.end()) {
      problems.add(name->place, "no body " + in_quotes(read[i].body) + offer(read[i].body, names, "bodies"));
    }
    if (at == names.end()) continue;
    const auto index = static_cast<std::size_t>(at - names.begin());
    const Body& body = robot.bodies[index];
    const Vec3 point = read[i].point.hasNaN() ? k.point(body.link, body.in_link.p) : read[i].point;
    wrenches.push_back({index, point, read[i].force, read[i].torque});
  }
}

}  // namespace

DynamicsInput read_state_file(const std::string& path, const Robot& robot, Base base, const RobotState& start) {
  const Node root = parse_json(read_text(path), path);
  DynamicsInput input{start, {}, std::vector<double>(robot.joints.size(), 0.0), {}, {path}};
  if (const Node* q = root.find("q")) input.place = q->place;
  input.acceleration.joints = input.tau;
  Problems problems;
  const std::vector<std::string> joints = joint_names(robot);
  Reader reader(root, "the state", problems, &joints);
  read_joints(reader, "q", "rad", input.state.q);
  read_joints(reader, "qd", "rad/s", input.state.qd);
  read_joints(reader, "qdd", "rad/s^2", input.acceleration.joints);
  read_joints(reader, "tau", "N m", input.tau);
  BaseMotion motion{input.state, input.acceleration};
  if (const Node* node = reader.take("base")) {
    Reader of_base(*node, "base", problems, nullptr);
    motion.fields(of_base);
    motion.check(of_base, base);
    of_base.finish();
  }
  Kinematics kinematics(robot);
  kinematics.update(robot, input.state);
  read_wrenches(reader, root, robot, kinematics, problems, input.wrenches);
  reader.finish();
  problems.raise();
  return input;
}

}  // namespace gaitlab
