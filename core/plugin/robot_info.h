// Description of the robot for plugins. Standard library only.
#pragma once
#include <array>
#include <charconv>
#include <cstdint>
#include <limits>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

namespace gaitlab {

struct JointInfo {
  std::string name;                   ///< name such as `m3/passive`
  std::int64_t module = 0;            ///< number of the joint's module
  std::int64_t parent = -1;           ///< number of the next joint towards the base, or -1
  double lo = 0, hi = 0;              ///< range, rad; -infinity and infinity if the joint turns freely
  std::array<double, 3> origin = {};  ///< point on the axis, m, in the base frame at zero angles
  /// Unit vector of the joint axis in the base frame at zero angles. The body farther from the base makes a right-hand turn
  /// about this axis if the angle is positive.
  std::array<double, 3> axis = {};
  bool driven = true;  ///< false for a joint without a motor, whose set points and torques are not used
  double start = 0;    ///< angle at the start, rad, if the scenario states `initial.angles`; else 0
  [[nodiscard]] bool turns_freely() const { return hi == std::numeric_limits<double>::infinity(); }
};

/// Error in the value of one key, which does not fit the robot. If --set gave this value, the error is reported at that option.
class SettingError : public std::invalid_argument {
 public:
  SettingError(std::string key, const std::string& text) : std::invalid_argument(text), key_(std::move(key)) {}
  [[nodiscard]] const std::string& key() const { return key_; }

 private:
  std::string key_;
};

/// Throws SettingError for a set point that only a freely turning hinge can have. Such an angle is probably a mistake or in
/// degrees if the hinge has a range. `what` is the key, or words in its place.
inline void check_angle(const JointInfo& joint, const char* what, double angle) {
  constexpr double kLargest = 3.2;  // rad; slightly more than half a turn
  if (joint.turns_freely() || (angle >= -kLargest && angle <= kLargest)) return;
  const auto digits = [](double value, int count) {  // a decimal point in every locale, unlike printf
    std::array<char, 32> text = {};
    return std::string(text.data(), std::to_chars(text.begin(), text.end(), value, std::chars_format::general, count).ptr);
  };
  throw SettingError(what, std::string(what) + " of joint " + joint.name + " is " + digits(angle, 6) +
                               " rad; expected -3.2 to 3.2 rad for a hinge with a range; " + digits(angle, 6) +
                               " degrees are " + digits(angle * 3.14159265358979323846 / 180, 4) + " rad");
}

struct ModuleInfo {
  std::string type;                       ///< name of the module type
  std::int64_t parent = -1;               ///< number of the module that it is docked to, or -1 for module 0
  int parent_face = -1;                   ///< face of the parent at that dock
  std::array<double, 3> normal = {};      ///< outward normal of the parent's face, in the base frame at zero angles
  std::array<double, 3> position = {};    ///< origin of the module frame, m, in the base frame at zero angles
  std::array<double, 9> rotation = {};    ///< axes of the module in the base frame, row major
  std::vector<std::int64_t> joints = {};  ///< numbers of its joints, from the reference body outwards
  std::vector<std::int64_t> children = {};
  std::vector<std::array<double, 3>> feet =
      {};  ///< foot contact points, m, in the base frame at zero angles; only for modules without children
};

struct BodyInfo {
  std::string name;         ///< name such as `m3/link`
  std::int64_t module = 0;  ///< number of the body's module
};

/// A leg, a chain of links without branches that stands on its last link (core/model/legs.h).
struct Leg {
  std::string name;                  ///< `front_left`, `middle_right`, `2nd_left` (more than three on a side), `rear`
  std::vector<std::int64_t> joints;  ///< numbers of its driven joints, from the trunk outwards
  std::int64_t tip = -1;             ///< number of the joint that moves the last link
  std::vector<std::int64_t> bodies;  ///< numbers of its bodies, from the trunk outwards
  std::int64_t side = 0;             ///< 1 on the left, -1 on the right, 0 in the middle
  std::int64_t rank = 0, count = 1;  ///< number on its side, from the front, and legs on this side
  double angle = 0;                  ///< direction of the hip from the middle of all, rad, from forwards to the left
  std::array<double, 3> hip = {};    ///< origin of the first joint, m, in the base frame at zero angles
  /// Middle of the contact elements that are lowest at the start, m, in the base frame at zero angles.
  std::array<double, 3> foot = {};
  /// Contact elements of the last link: position, m, in the base frame at zero angles, and radius, m.
  std::vector<std::array<double, 4>> elements = {};
};

/// A robot as a tree of modules and joints, with its geometry at zero angles.
struct RobotInfo {
  std::vector<JointInfo> joints;
  std::vector<ModuleInfo> modules;
  std::vector<BodyInfo> bodies = {};
  std::vector<Leg> legs = {};              ///< from front to rear, left before right
  std::array<double, 3> up = {0, 0, 1};    ///< upward direction at the start, base frame
  bool start_stated = false;               ///< true if the scenario states `initial.angles`
  std::vector<std::string> channels = {};  ///< names of the sensors' values in Measured::channels, such as `imu.gyro_x`
  double control_period = 0;               ///< s, as Measured::period
};

}  // namespace gaitlab
