#include "controllers/pid.h"

#include <algorithm>
#include <cmath>

namespace gaitlab::controllers {

const char* const Pid::kManual =
    R"(A PID controller with a filtered derivative, sampled once per control period Ts; the command is held in between.

    P_k = Kp e_k
    I_k = I_{k-1} + Ki Ts e_{k-1}
    D_k = (Kd D_{k-1} + Kd N (e_k - e_{k-1})) / (Kd + N Ts)      (D = 0 if Kd = 0)
    u_k = P_k + I_k + D_k

e = set point - measured angle, rad. Start: I = D = 0, e_{-1} = e_0. Anti-windup: I is held while the last command exceeded
the actuator's limit and the error had its sign. Source: Chariot, Filippi, Verlinden 2012, eq. 3-6; gains chosen.

At rest a DC motor resists a deflection with k = Kp eta Kt n / R, N m/rad. With any load the joint settles for
Kp < 2 Ks n / Ts - 2 Kd N / (2 Kd + N Ts); `gaitlab check SCENARIO` prints both limits (docs/paper.md).

    controller: {type: pid, period: 0.015, Kp: 100, Kd: 0.6})";

void Pid::Settings::fields(Fields& f) {
  static constexpr const char* kUnits[] = {"V", "N m"};
  f.per_joint("Kp", Kp, {"V/rad", -1e9, 1e9, "Proportional gain."});
  f.per_joint("Ki", Ki, {"V/(rad s)", -1e9, 1e9, "Integral gain."});
  f.per_joint("Kd", Kd, {"V s/rad", 0, 1e9, "Derivative gain."});
  f.per_joint("N", N, {"V/rad", 1e-9, 1e9, "Filter of the derivative: its time constant is Kd / N."});
  f.flag("anti_windup", anti_windup, "Hold I while the last command exceeded the actuator's limit and the error had its sign.");
  f.choice("unit", unit, kUnits, "Unit of the command; gains are in this unit per rad.");
}

void Pid::start(Out x) const { std::fill(x.begin(), x.end(), 0.0); }

std::vector<PositionGains> Pid::gains() const {
  std::vector<PositionGains> all;
  for (std::size_t j = 0; j < joints_; ++j) {
    const bool volts = s_.unit == Unit::volt;
    all.push_back({.P = s_.Kp[j],
                   .I = s_.Ki[j],
                   .D = s_.Kd[j],
                   .N = s_.N[j],
                   .unit = volts ? "V/rad" : "N m/rad",
                   .unit_of_D = volts ? "V s/rad" : "N m s/rad"});
  }
  return all;
}

void Pid::update(const Measured& m, In setpoint, In limit, Out x, Out command) const {
  const bool first = x[0] == 0;
  x[0] = 1;
  for (std::size_t j = 0; j < joints_; ++j) {
    double& integral = x[1 + 4 * j];
    double& derivative = x[2 + 4 * j];
    double& last_error = x[3 + 4 * j];
    double& last_command = x[4 + 4 * j];
    const double error = setpoint[j] - m.angle[j];
    if (first) last_error = error;
    const bool wound_up = s_.anti_windup && std::abs(last_command) > limit[j] && last_error * last_command > 0;
    if (!first && !wound_up) integral += s_.Ki[j] * m.period * last_error;
    const double kd = s_.Kd[j];
    const double n = s_.N[j];
    derivative = kd == 0 ? 0 : (kd * derivative + kd * n * (error - last_error)) / (kd + n * m.period);
    command[j] = s_.Kp[j] * error + integral + derivative;
    last_error = error;
    last_command = command[j];
  }
}

}  // namespace gaitlab::controllers
