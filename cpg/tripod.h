// Gait `tripod`, in which groups of legs alternate between stance and swing, for any even number of legs.
#pragma once
#include <vector>

#include "core/plugin/registry.h"

namespace gaitlab::cpg {

class Tripod final : public Cpg {
 public:
  enum class Order { alternate, wave };
  struct Model {
    double tilt = 0.4, duty_factor = 0.5, ramp = 1;
    Order order = Order::alternate;
    bool reverse = false;
    void fields(Fields& f);
  };
  struct Settings {
    double frequency = 0.5, amplitude = 0.4;
    Model model;
    void fields(Fields& f);
  };
  static const char* const kManual;

  /// A leg whose first and last joint turn about y, with feet below the last.
  struct Chain {
    std::size_t hip = 0, ankle = 0;       ///< numbers of these joints
    double hip_sign = 1, ankle_sign = 1;  ///< 1 if a positive angle is a right-hand turn about +y, else -1
    bool left = false;                    ///< true on the +y side
    double length = 0;                    ///< distance from hip to ankle along -z at zero angles, m
    double sole_depth = 0;                ///< distance from the ankle down to the lowest foot point, m
    double sole_reach = 0;                ///< largest distance along x from the ankle to a lowest foot point, m
  };
  /// These legs of a robot, from front to rear, left before right.
  static std::vector<Chain> chains(const RobotInfo& robot);

  /// Throws std::invalid_argument for fewer than four legs, or if the numbers of left and right legs differ.
  Tripod(const RobotInfo& robot, const Settings& settings);
  void output(double t, In, Out setpoint) const override;
  [[nodiscard]] std::string note() const override;
  [[nodiscard]] SetPointTimes times() const override { return {0, s_.model.ramp}; }

 private:
  /// A leg with its phase in the cycle.
  struct Step {
    Chain leg;
    double phase = 0;  ///< phase lead as a share of the period
  };
  struct Motion {
    bool stands = true;
    double progress = 0;  ///< share of the stance or of the swing that has passed, 0 to 1
    double forward = 0;   ///< angle of the leg towards +x, rad
  };
  [[nodiscard]] Motion motion(const Step& step, double cycles, double amplitude) const;
  struct Depth {
    double reach = 0;  ///< largest depth of the ankle below the hip among the standing legs, m
    double lift = 0;   ///< d' of the manual, rad
  };
  [[nodiscard]] Depth depth(double cycles, double grown) const;
  [[nodiscard]] static double tilt(const Chain& leg, const Depth& depth, double forward);
  [[nodiscard]] static double tilt_to_reach(const Chain& leg, double height);

  std::size_t joints_;
  Settings s_;
  std::vector<Step> steps_;
};

}  // namespace gaitlab::cpg
