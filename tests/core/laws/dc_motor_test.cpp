// Tests of the gear efficiency of a DC motor: as in eq. 2 of the paper, and directional, which conserves energy.
#include "core/laws/dc_motor.h"

#include <gtest/gtest.h>

namespace gaitlab {
namespace {

constexpr double kEta = 0.7;
constexpr double kTurn = 0.5;

DcMotor motor(double turn) { return {4.3, 0.00395, 0.00395, 594, turn > 0 ? 1 : kEta, 7.4, 1.2, turn > 0 ? kEta : 1, turn}; }

/// Power lost in the gear: the power Kt i n w of the motor's shaft minus the power T w of the joint, W.
double gear_loss(const DcMotor& m, double command, double speed) {
  const DcMotor::Effort e = m(command, speed);
  return (m.Kt * e.current * m.gear - e.torque) * speed;
}

/// Calls `visit` for commands and speeds of both signs, including both saturations.
template <class Visit>
void everywhere(Visit visit) {
  for (int i = -12; i <= 12; ++i) {
    for (int k = -96; k <= 96; ++k) visit(0.75 * i, 0.0625 * k);
  }
}

TEST(DcMotor, AsPrintedTheGearCreatesEnergyWhenDriven) {
  const DcMotor paper = motor(0);
  // At 0 V and 1 rad/s the joint drives the motor against its back-EMF. Eq. 2 multiplies the braking torque by eta.
  const DcMotor::Effort e = paper(0, 1);
  EXPECT_LT(e.current, 0);
  EXPECT_DOUBLE_EQ(e.torque, kEta * paper.Kt * e.current * paper.gear);
  EXPECT_LT(gear_loss(paper, 0, 1), -0.1);  // W
}

TEST(DcMotor, DirectionalGearNeverCreatesEnergy) {
  const DcMotor directional = motor(kTurn);
  everywhere([&](double command, double speed) {
    EXPECT_GE(gear_loss(directional, command, speed), -1e-15) << command << " V, " << speed << " rad/s";  // 0 up to rounding
  });
}

TEST(DcMotor, DirectionalTakesEtaFromWhoeverDrives) {
  const DcMotor directional = motor(kTurn);
  everywhere([&](double command, double speed) {
    const DcMotor::Effort e = directional(command, speed);
    if (std::abs(speed) < kTurn || e.current == 0) return;
    const double through = directional.Kt * e.current * directional.gear;
    // The tolerance is for errors of 1 ulp of exp and of log.
    EXPECT_NEAR(e.torque / through, e.current * speed > 0 ? kEta : 1 / kEta, 1e-14) << command << " V, " << speed << " rad/s";
  });
}

TEST(DcMotor, SlopeIsTheDerivative) {
  for (const double turn : {0.0, kTurn}) {
    const DcMotor m = motor(turn);
    everywhere([&](double command, double speed) {
      constexpr double kStep = 1e-6;
      const double middle = speed + 0.03;  // between the speeds of the grid, so that no corner of the law is near
      const DcMotor::Effort before = m(command, middle - kStep);
      const DcMotor::Effort after = m(command, middle + kStep);
      // Errors of the central difference are the rounding error 1e-16 * 2 N m / 2e-6 rad/s, and the error of order 2, below
      // 1e-8.
      EXPECT_NEAR(m(command, middle).slope, (before.torque - after.torque) / (2 * kStep), 1e-7)
          << command << " V, " << middle << " rad/s, turn " << turn;
    });
  }
}

}  // namespace
}  // namespace gaitlab
