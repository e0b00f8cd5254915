// Gait `legs`: feet on straight or curved ways, for every robot whose legs are found.
#pragma once
#include <vector>

#include "core/plugin/registry.h"
#include "cpg/leg_gaits.h"
#include "cpg/leg_kinematics.h"

namespace gaitlab::cpg {

class Legs final : public Cpg {
 public:
  struct Model {
    Gait gait = Gait::trot;
    double stride = 0, speed = 0, side = 0, turn = 0, lift = 0, duty = 0, lean = 0.25, stance = 0, ramp = 1;
    void fields(Fields& f);
  };
  struct Settings {
    double frequency = 1;
    Model model;
    void fields(Fields& f);
  };
  static const char* const kManual;

  /// Throws std::invalid_argument for a robot without legs, and the errors of phases_of. Throws SettingError if stride and
  /// speed, or stance and initial.angles, are both given, and for a way that is longer than twice the shortest leg.
  Legs(const RobotInfo& robot, const Settings& settings);
  void output(double t, In, Out setpoint) const override;
  [[nodiscard]] std::string note() const override { return note_; }
  [[nodiscard]] SetPointTimes times() const override { return {1 / s_.frequency, s_.model.ramp}; }

 private:
  static constexpr std::size_t kSamples = 128;  ///< of a cycle
  /// Motion of the body that the feet shall cause, in the base frame: m/s and rad/s.
  struct Way {
    Vec3 up, left, middle, velocity;
    double turn, lean;
    [[nodiscard]] Vec3 foot(const Vec3& from, double time) const;
    [[nodiscard]] Vec3 speed(const Vec3& from, double time) const;
  };
  /// A leg and its angles over a cycle.
  struct Step {
    std::vector<std::size_t> joints;
    double phase = 0;
    std::vector<double> angles;  ///< sample * joints + joint, rad
    double error = 0;            ///< largest distance of a foot from its way, m
  };
  [[nodiscard]] Vec3 target(const Way& way, const Vec3& from, double share, double lead) const;
  void plan(const LegKinematics& leg, const Way& way, Step& step) const;
  void describe(const RobotInfo& robot, const Way& way, double height);

  Settings s_;
  double duty_ = 0.5, lift_ = 0;
  std::vector<double> stance_;
  std::vector<Step> steps_;
  std::string note_;
};

}  // namespace gaitlab::cpg
