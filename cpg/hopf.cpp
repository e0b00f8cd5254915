#include "cpg/hopf.h"

#include "core/math/functions.h"
#include "core/math/runge_kutta.h"

namespace gaitlab::cpg {
namespace {

constexpr double kFirstRadius = 0.01;      // the set points grow from nearly zero
constexpr std::size_t kTableSteps = 4096;  // several of them within the shortest transition from swing to stance, 0.01 rad

double sigmoid(double x) { return 1 / (1 + math::exp(-x)); }

}  // namespace

const char* const Hopf::kManual = R"(Hopf oscillators: a stable circle of radius 1 in the plane (x, y).

    x_i' = a (1 - r_i^2) x_i - omega_i y_i + sum_j w_ij (x_ij - x_i)      r_i^2 = x_i^2 + y_i^2
    y_i' = a (1 - r_i^2) y_i + omega_i x_i + sum_j w_ij (y_ij - y_i)
    omega_i = 2 pi f_i c (S(b y_i) / d + S(-b y_i) / (1 - d)) / 2,  S(z) = 1 / (1 + exp(-z))
    theta_i = X_i + R_i x_i

(x_ij, y_ij): the state of joint j rotated ahead by the lag L_ij. On the limit cycle the coupling is therefore 0, and frequency,
amplitude and lag are exact. d: duty_factor, the share of the period (stance) in which the set point falls; in the rest (swing)
it rises. With d = 0.5, omega = 2 pi f. Otherwise b is the sharpness of the transition between the two angular speeds, c makes
the period 1 / f, and the lag is a time: L / (2 pi) of the period. Start: the phases of the limit cycle with r = 0.01 (phase 0,
with a note, if the lags around a closed loop of couplings contradict one another). Without couplings,
r^2 = 1 / (1 + (1 / r0^2 - 1) exp(-2 a t)). Accurate for f h <= 0.05 (h: cpg.step), and with d other than 0.5 for f h b <= 0.6.
Stable for (2 a + w) h < 2.
Reference: L. Righetti, A. J. Ijspeert, Pattern generators with sensory feedback for the control of quadruped locomotion, IEEE
ICRA 2008, 819-824 (where x is the set point, and omega changes from swing to stance with the sign of y). The coupling by the
difference to the rotated state is our own choice.

    cpg: {type: hopf, frequency: 0.25, amplitude: 0.6, phase_lag: 1.2, model: {duty_factor: 0.5}})";

void HopfModel::fields(Fields& f) {
  f.number("coupling", coupling, {"1/s", 0, 100, "Weight w of the couplings made by a rule."});
  f.number("rate", rate, {"1/s", 0.01, 100, "a: rate at which the radius approaches 1."});
  f.number("duty_factor", duty_factor, {"", 0.05, 0.95, "d: share of the period in which the set point falls."});
  f.number("sharpness", sharpness, {"", 1, 100, "b: sharpness of the transition from swing to stance."});
}

Hopf::Hopf(const RobotInfo& robot, const Settings& settings) : OscillatorCpg(robot, settings, kBlocks) {
  if (s_.model.duty_factor == 0.5) return;  // the pace is constant, so that no table is necessary
  // The mean of 1 / pace is the period in units of 1 / f. Equal steps are optimal for a smooth periodic function.
  double sum = 0;
  for (std::size_t k = 0; k < kTableSteps; ++k) sum += 1 / pace(-math::cos(kTurn * static_cast<double>(k) / kTableSteps));
  scale_ = sum / kTableSteps;
  // Integrates d(angle)/d(phase) = pace by RK4.
  std::vector<double> angles(kTableSteps + 1, 0.0);
  const double h = kTurn / kTableSteps;
  math::RungeKutta method(1);
  const auto slope = [this](double, In at, Out out) { out[0] = pace(-math::cos(at[0])); };
  for (std::size_t k = 0; k < kTableSteps; ++k) {
    angles[k + 1] = angles[k];
    method.step(Out(angles).subspan(k + 1, 1), h, slope, math::RungeKutta::in_order);
  }
  angles.back() = kTurn;
  angle_ = PhaseTable(std::move(angles));
}

double Hopf::pace(double y) const {
  const double d = s_.model.duty_factor;
  if (d == 0.5) return 1;
  const double stance = sigmoid(s_.model.sharpness * y);
  return scale_ * (stance / d + (1 - stance) / (1 - d)) / 2;
}

void Hopf::start(Out state) const {
  for (std::size_t i = 0; i < joints_; ++i) {
    const double angle = s_.model.duty_factor == 0.5 ? network_.phases[i] : angle_.angle(network_.phases[i]);
    state[i] = kFirstRadius * math::sin(angle);
    state[joints_ + i] = -kFirstRadius * math::cos(angle);
  }
}

void Hopf::derivative(const Measured&, In state, Out rate) const {
  const In x = state.subspan(0, joints_);
  const In y = state.subspan(joints_, joints_);
  for (std::size_t i = 0; i < joints_; ++i) {
    const double growth = s_.model.rate * (1 - x[i] * x[i] - y[i] * y[i]);
    const double omega = kTurn * s_.frequency[i] * pace(y[i]);
    rate[i] = growth * x[i] - omega * y[i];
    rate[joints_ + i] = growth * y[i] + omega * x[i];
  }
  for (const Coupling& c : network_.couplings) {
    const auto from = static_cast<std::size_t>(c.from);
    const auto to = static_cast<std::size_t>(c.to);
    double turn = c.phase_lag;
    if (s_.model.duty_factor != 0.5) {
      const double angle = math::atan2(x[from], -y[from]);
      turn = angle_.angle(angle_.phase(angle) + c.phase_lag) - angle;
    }
    const auto [sin, cos] = math::sincos(turn);
    rate[to] += c.weight * (x[from] * cos - y[from] * sin - x[to]);
    rate[joints_ + to] += c.weight * (y[from] * cos + x[from] * sin - y[to]);
  }
}

void Hopf::output(double, In state, Out setpoint) const {
  for (std::size_t i = 0; i < joints_; ++i) setpoint[i] = s_.offset[i] + s_.amplitude[i] * state[i];
}

}  // namespace gaitlab::cpg
