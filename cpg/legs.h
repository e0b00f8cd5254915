// Gait `legs`: feet on straight or curved ways, for every robot whose legs are found.
#pragma once
#include <array>
#include <string>
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
    std::vector<double> phases;
    std::string steering;
    void fields(Fields& f);
  };
  struct Settings {
    double frequency = 1;
    Model model;
    void fields(Fields& f);
  };
  static const char* const kManual;

  /// Throws std::invalid_argument for a robot without legs, and the errors of phases_of. Throws SettingError if stride and
  /// speed, or stance and initial.angles, are both given, for a way that is longer than twice the shortest leg, for phases of
  /// another number of legs or of a gait that leans, and for steering without values.
  Legs(const RobotInfo& robot, const Settings& settings);
  /// Without steering 0. With it: the angles of the legs (rad), held over a control period, and the speeds that are in force.
  [[nodiscard]] std::size_t states() const override { return steered() ? moved_.size() + kSteered : 0; }
  [[nodiscard]] std::string state_name(std::size_t index) const override;
  void start(Out state) const override;
  void derivative(const Measured&, In, Out rate) const override { std::fill(rate.begin(), rate.end(), 0.0); }
  void event(const Measured& measured, Out state) const override;
  void output(double t, In state, Out setpoint) const override;
  [[nodiscard]] std::string note() const override { return note_; }
  [[nodiscard]] SetPointTimes times() const override { return {steered() ? 0 : 1 / s_.frequency, s_.model.ramp, steered()}; }

 private:
  static constexpr std::size_t kSamples = 128;  ///< of a cycle
  static constexpr std::size_t kSteered = 3;    ///< speed, side, turn
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
    Vec3 from = Vec3::Zero();    ///< foot in the stance
  };
  [[nodiscard]] bool steered() const { return !s_.model.steering.empty(); }
  [[nodiscard]] std::vector<double> phases(const RobotInfo& robot) const;
  void find_steering(const RobotInfo& robot);
  [[nodiscard]] Way way_of(const std::array<double, kSteered>& speeds) const;
  [[nodiscard]] Mat3 weights_of(const Way& way, const Step& step) const;
  [[nodiscard]] double share_of(const Step& step, double t) const;
  [[nodiscard]] Vec3 target(const Way& way, const Vec3& from, double share, double lead) const;
  void plan(const LegKinematics& leg, const Way& way, Step& step) const;
  void sample(double t, std::vector<double>& angles) const;
  void describe(const RobotInfo& robot, const Way& way, double height);

  Settings s_;
  double duty_ = 0.5, lift_ = 0, reach_ = 0;
  Way still_;  ///< without velocities
  std::vector<double> stance_;
  std::vector<LegKinematics> legs_;
  std::vector<Step> steps_;
  std::vector<std::size_t> moved_;               ///< joints of all legs
  std::array<std::size_t, kSteered> channel_{};  ///< of each steered value, kNone for one that is not steered
  double longest_ = 0;                           ///< m, way of a foot in a stance to which steering is limited
  double follow_ = 0;                            ///< share of a change of speed that is taken in a control period
  mutable std::vector<double> angles_;           ///< scratch, rad
  std::string note_;
};

}  // namespace gaitlab::cpg
