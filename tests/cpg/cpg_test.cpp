// Oscillators agree with closed forms and published periods.
#include <gtest/gtest.h>

#include <cmath>
#include <functional>

#include "cpg/hopf.h"
#include "cpg/kuramoto_amplitude.h"
#include "cpg/matsuoka.h"
#include "cpg/phase_oscillator.h"
#include "cpg/van_der_pol.h"
#include "tests/validation.h"

namespace gaitlab::test {
namespace {

using namespace cpg;

constexpr double kTurn = 2 * std::numbers::pi;

RobotInfo joints(std::size_t count) {
  RobotInfo robot;
  for (std::size_t j = 0; j < count; ++j) {
    JointInfo joint;
    joint.name = "j" + std::to_string(j);
    joint.parent = static_cast<std::int64_t>(j) - 1;
    joint.lo = -1.6;
    joint.hi = 1.6;
    robot.joints.push_back(joint);
  }
  return robot;
}

/// States of a CPG, integrated by classical RK4 as in the simulation.
class Integrated {
 public:
  Integrated(const Cpg& cpg, std::size_t joints, double h) : cpg_(cpg), h_(h), x_(cpg.states()), setpoint_(joints) {
    cpg.start(x_);
  }
  void step() {
    const std::size_t n = x_.size();
    std::vector<double> k[4], at = x_;
    for (int stage = 0; stage < 4; ++stage) {
      k[stage].resize(n);
      for (std::size_t i = 0; stage > 0 && i < n; ++i) at[i] = x_[i] + (stage == 3 ? h_ : h_ / 2) * k[stage - 1][i];
      cpg_.derivative({}, at, k[stage]);
    }
    for (std::size_t i = 0; i < n; ++i) x_[i] += h_ / 6 * (k[0][i] + 2 * k[1][i] + 2 * k[2][i] + k[3][i]);
    ++steps_;
  }
  void run(double until) {
    while (static_cast<double>(steps_) * h_ < until - h_ / 2) step();
  }
  [[nodiscard]] double t() const { return static_cast<double>(steps_) * h_; }
  std::vector<double>& x() { return x_; }
  double setpoint(std::size_t joint = 0) {
    cpg_.output(t(), x_, setpoint_);
    return setpoint_[joint];
  }

 private:
  const Cpg& cpg_;
  double h_;
  long steps_ = 0;
  std::vector<double> x_, setpoint_;
};

TEST(CpgForms, HopfRadiusAndPhase) {
  Hopf::Settings s;
  s.frequency.common = 0.7;
  const Hopf cpg(joints(1), s);
  Integrated run(cpg, 1, 1e-3);
  for (const double t : {0.5, 1.0, 2.0, 4.0}) {
    run.run(t);
    // z' = (a (1 - |z|^2) + i omega) z is Bernoulli's equation in r^2, with r^-2 = 1 + (r0^-2 - 1) exp(-2 a t), r0 = 0.01.
    const double r = 1 / std::sqrt(1 + (1e4 - 1) * std::exp(-2 * 2.0 * t));
    const Row radius{"cpg.hopf_radius", "radius of one oscillator from 0.01", "Bernoulli's equation", ""};
    validate(radius, std::hypot(run.x()[0], run.x()[1]), r, 1e-10, "RK4 at 1 ms: (omega h)^4 = 4e-10 a radian");
    const double phase = std::atan2(run.x()[0], -run.x()[1]);
    const Row row{"cpg.hopf_phase", "phase of one oscillator while its radius grows", "2 pi f t", "rad"};
    validate(row, std::remainder(phase - kTurn * 0.7 * t, kTurn), 0, 1e-9, "RK4 at 1 ms: (omega h)^4 = 4e-10 a radian");
  }
}

/// Integral of 1 / (S(b y) / d + S(-b y) / (1 - d)) with y = -cos(angle) between two angles, by Simpson's rule.
double time_between(double from, double to, double duty, double sharpness) {
  constexpr int kParts = 20000;
  double sum = 0;
  for (int k = 0; k <= kParts; ++k) {
    const double y = -std::cos(from + (to - from) * k / kParts);
    const double stance = 1 / (1 + std::exp(-sharpness * y));
    sum += (k == 0 || k == kParts ? 1 : 2 + 2 * (k % 2)) / (stance / duty + (1 - stance) / (1 - duty));
  }
  return sum * (to - from) / kParts / 3;
}

TEST(CpgForms, SwingAndStanceTakeRighettisIntegral) {
  for (const double duty : {0.25, 0.6, 0.8}) {
    Hopf::Settings s;
    s.frequency.common = 0.5;
    s.model.duty_factor = duty;
    const Hopf cpg(joints(1), s);
    Integrated run(cpg, 1, 1e-3);
    run.run(12);
    // The set point decreases from its maximum to its minimum. The times of both are zeros of y, found by linear interpolation.
    std::vector<double> turns;
    while (turns.size() < 3) {
      const double before = run.x()[1];
      run.step();
      const double after = run.x()[1];
      if ((before < 0) == (after < 0) || (turns.empty() && before > 0)) continue;
      turns.push_back(run.t() - 1e-3 * after / (after - before));
    }
    const Row period{"cpg.righetti_period", "period with separate swing and stance",
                     "Righetti, Ijspeert 2008: integral of 1/omega over a turn; 1/f", "s"};
    validate(period, turns[2] - turns[0], 2, 2e-6, "RK4 at 1 ms through a change of pace within 0.05 rad; interpolated turns");
    const double quarter = kTurn / 4;
    const double stance = time_between(quarter, 3 * quarter, duty, 20);
    const Row share{"cpg.righetti_stance", "share of the period in stance",
                    "Righetti, Ijspeert 2008: integral of 1/omega over y > 0 by Simpson's rule", ""};
    validate(share, (turns[1] - turns[0]) / 2, stance / (stance + time_between(-quarter, quarter, duty, 20)), 2e-5,
             "turns are interpolated linearly in steps of 1 ms where the pace changes: h^2 b omega / 8 = 2e-5");
    EXPECT_NEAR((turns[1] - turns[0]) / 2, duty, 0.02);  // the transitions at both ends are 1/20 rad wide
  }
}

TEST(CpgForms, MatsuokasFrequency) {
  for (const double a : {1.6, 1.8, 2.0}) {
    for (const double b : {2.0, 2.5, 5.0}) {
      const double t = 0.5;
      Matsuoka::Settings s;
      s.model.inhibition = a;
      s.model.adaptation = b;
      s.model.time_ratio = t;
      const Matsuoka cpg(joints(1), s);
      const Row row{"cpg.matsuoka_frequency", "angular frequency of a pair, t = 0.5, 1.6 <= a <= 2, 2 <= b <= 5",
                    "Matsuoka 2011: sqrt(((1 + t) b - t a) / (t a))", "rad/s"};
      const double formula = std::sqrt(((1 + t) * b - t * a) / (t * a));
      validate(row, kTurn / cpg.limit_cycle().period, formula, 0.05 * formula,
               "the formula is a describing function's: 5 % in its range");
    }
  }
}

TEST(CpgForms, VanDerPolsPeriod) {
  const VanDerPol cpg(joints(1), {});
  const Row period{"cpg.van_der_pol_period", "period of the limit cycle, mu = 1",
                   "Andersen, Geer, SIAM J. Appl. Math. 42 (1982) 678: 6.6632868593", "s"};
  validate(period, cpg.limit_cycle().period, 6.6632868593, 1e-9, "ten digits published; RK4 at 2 ms errs by 4e-11");
  VanDerPol::Settings s;
  s.model.mu = 0.1;
  const Row small{"cpg.van_der_pol_small_mu", "period of the limit cycle, mu = 0.1",
                  "Lindstedt's series: 2 pi (1 + mu^2 / 16 - 5 mu^4 / 3072)", "s"};
  validate(small, VanDerPol(joints(1), s).limit_cycle().period, kTurn * (1 + 0.01 / 16 - 5e-4 / 3072), 1e-7,
           "the next term of the series is of order mu^6 = 1e-6 times a coefficient below 0.01");
}

TEST(CpgForms, CrespisAmplitude) {
  KuramotoAmplitude::Settings s;
  s.amplitude.common = 0.8;
  s.model.amplitude_rate = 6;
  const KuramotoAmplitude cpg(joints(1), s);
  Integrated run(cpg, 1, 1e-3);
  for (const double t : {0.1, 0.5, 1.0, 3.0}) {
    run.run(t);
    const Row row{"cpg.crespi_amplitude", "amplitude of critically damped second order from rest",
                  "Crespi, Ijspeert 2008: R (1 - (1 + a t / 2) exp(-a t / 2))", "rad"};
    validate(row, run.x()[1], 0.8 * (1 - (1 + 3 * t) * std::exp(-3 * t)), 1e-11,
             "RK4 at 1 ms: (a h / 2)^4 = 8e-11 times 1/120");
  }
}

/// Validates a pair of oscillators whose follower starts psi0 ahead of its lag, with psi' = -w sin(psi).
void validate_pair(const std::string& name, Integrated run, double w, double tolerance, const std::string& reason,
                   const std::function<double(const std::vector<double>&)>& psi) {
  const double psi0 = psi(run.x());
  for (const double t : {0.5, 1.0, 2.0, 4.0}) {
    run.run(t);
    validate({"cpg.pair_" + name, "a coupled pair comes to its lag", "psi(t) = 2 atan(tan(psi0 / 2) exp(-w t))", "rad"},
             psi(run.x()), 2 * std::atan(std::tan(psi0 / 2) * std::exp(-w * t)), tolerance, reason);
  }
}

constexpr double kLag = 1.2, kPsi = 2.5;

/// Pair of oscillators that starts kPsi ahead of the lag kLag. The start comes from a CPG whose lag is the sum kLag + kPsi.
template <class T>
Integrated displaced(const T& cpg, const typename T::Settings& s, double h) {
  typename T::Settings ahead = s;
  ahead.phase_lag.common = kLag + kPsi;
  Integrated run(cpg, 2, h);
  T(joints(2), ahead).start(run.x());
  return run;
}

TEST(CpgForms, CoupledPairsComeToTheirLag) {
  PhaseOscillator::Settings p;
  const PhaseOscillator phases(joints(2), p);
  const auto phi = [](const std::vector<double>& x) { return x[1] - x[0] - kLag; };
  validate_pair("phase_oscillator", displaced(phases, p, 1e-3), 1, 1e-12, "RK4 at 1 ms: (w h)^4 = 1e-12 times 1/120", phi);

  KuramotoAmplitude::Settings k;
  const KuramotoAmplitude weighted(joints(2), k);
  Integrated grown = displaced(weighted, k, 1e-3);
  grown.x()[2] = grown.x()[3] = 0.6;
  validate_pair("kuramoto_amplitude", grown, 4 * 0.6, 1e-11, "RK4 at 1 ms: (w R h)^4 = 3e-11 times 1/120", phi);

  VanDerPol::Settings v;
  const VanDerPol network(joints(2), v);
  const auto phase = [&](double x, double y) { return network.limit_cycle().angle.phase(std::atan2(x, y)); };
  validate_pair(
      "van_der_pol", displaced(network, v, 1e-3), 1, 1e-4,
      "the phase comes from a table of 2048 entries, linear between them: (2 pi / 2048)^2 = 1e-5 each",
      [&](const std::vector<double>& x) { return std::remainder(phase(x[1], x[3]) - phase(x[0], x[2]) - kLag, kTurn); });
}

}  // namespace
}  // namespace gaitlab::test
