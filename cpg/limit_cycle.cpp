#include "cpg/limit_cycle.h"

#include "core/math/functions.h"
#include "core/math/runge_kutta.h"

namespace gaitlab::cpg {
namespace {

// Number of phases in the table; linear interpolation between them has an error of 1e-6 of the amplitude.
constexpr std::size_t kPhases = 2048;

using State = std::array<double, Oscillator::kMost>;

/// Steps of an oscillator by the classical Runge-Kutta method.
class Steps {
 public:
  explicit Steps(const Oscillator& oscillator) : oscillator_(oscillator), method_(oscillator.states()) {}
  State operator()(const State& x, double h) {
    State next = x;
    const auto slope = [this](double, In at, Out out) { oscillator_.derivative(at, out); };
    method_.step(Out(next.data(), oscillator_.states()), h, slope, math::RungeKutta::in_order);
    return next;
  }

 private:
  const Oscillator& oscillator_;
  math::RungeKutta method_;
};

double sine(const Oscillator& oscillator, const State& x) { return oscillator.point({x.data(), oscillator.states()}).sine; }

/// Time from state x, within one step, at which the sine becomes 0.
double crossing(const Oscillator& oscillator, Steps& step, const State& x, double h) {
  double lo = 0;
  double hi = h;
  while (hi - lo > 1e-14) {
    const double middle = (lo + hi) / 2;
    (sine(oscillator, step(x, middle)) < 0 ? lo : hi) = middle;
  }
  return hi;
}

struct Turn {
  State start{};
  double period = 0;
};

Turn settled_turn(const Oscillator& oscillator) {
  constexpr double kSame = 1e-11;
  constexpr std::size_t kMostSteps = 3'000'000;
  const std::size_t n = oscillator.states();
  const double h = oscillator.step();
  Turn turn;
  Steps step(oscillator);
  State x{};
  oscillator.start({x.data(), n});
  double since = 0;  // time since the last crossing
  for (std::size_t k = 0; k < kMostSteps; ++k) {
    const State next = step(x, h);
    if (!(sine(oscillator, x) < 0 && sine(oscillator, next) >= 0)) {
      x = next;
      since += h;
      continue;
    }
    const double part = crossing(oscillator, step, x, h);
    x = step(x, part);
    turn.period = since + part;
    since = 0;
    double change = 0;
    double size = 0;
    for (std::size_t i = 0; i < n; ++i) {
      change = std::max(change, std::abs(x[i] - turn.start[i]));
      size = std::max(size, std::abs(x[i]));
    }
    turn.start = x;
    if (change < kSame && size > 1e-3) return turn;
  }
  throw std::invalid_argument("the oscillator does not reach a limit cycle");
}

}  // namespace

LimitCycle::LimitCycle(const Oscillator& oscillator) {
  const std::size_t n = oscillator.states();
  const Turn turn = settled_turn(oscillator);
  period = turn.period;
  const double h = period / kPhases;
  const auto parts = static_cast<std::size_t>(std::ceil(h / oscillator.step()));
  State x = turn.start;
  Steps step(oscillator);
  std::vector<double> angles;
  for (std::size_t k = 0; k <= kPhases; ++k) {
    const In now(x.data(), n);
    orbit.insert(orbit.end(), now.begin(), now.end());
    amplitude = std::max(amplitude, std::abs(oscillator.output(now)));
    const auto [sine, cosine] = oscillator.point(now);
    const double before = angles.empty() ? 0 : angles.back();
    angles.push_back(before + std::remainder(math::atan2(sine, cosine) - before, kTurn));
    for (std::size_t i = 0; i < parts; ++i) x = step(x, h / static_cast<double>(parts));
  }
  angles.front() = 0;
  angles.back() = kTurn;
  angle = PhaseTable(std::move(angles));
}

void CycleNetwork::Model::fields(Fields& f) {
  f.number("coupling", coupling, {"1/s", 0, 100, "Weight w of the couplings made by a rule."});
  f.number("amplitude_rate", amplitude_rate, {"1/s", 0, 100, "a_r: rate at which r approaches the amplitude."});
}

CycleNetwork::CycleNetwork(const RobotInfo& robot, const OscillatorKeys& keys, const Model& model,
                           std::unique_ptr<const Oscillator> oscillator)
    : joints_(robot.joints.size()),
      keys_(keys),
      model_(model),
      network_(robot, keys, model.coupling),
      oscillator_(std::move(oscillator)),
      cycle_(*oscillator_) {}

CycleNetwork::Local CycleNetwork::local(In state, std::size_t joint) const {
  Local x{};
  for (std::size_t k = 0; k < oscillator_->states(); ++k) x[k] = state[k * joints_ + joint];
  return x;
}

std::string CycleNetwork::state_name(std::size_t index) const {
  const std::size_t block = index / joints_;
  return (block < oscillator_->states() ? oscillator_->state_name(block) : std::string("r")) + "." +
         std::to_string(index % joints_);
}

void CycleNetwork::start(Out state) const {
  const std::size_t n = oscillator_->states();
  for (std::size_t i = 0; i < joints_; ++i) {
    const double turns = network_.phases[i] / kTurn;
    const double at = (turns - std::floor(turns)) * static_cast<double>(kPhases);
    const auto k = std::min(static_cast<std::size_t>(at), kPhases - 1);
    const double share = at - static_cast<double>(k);
    for (std::size_t s = 0; s < n; ++s) {
      state[s * joints_ + i] = (1 - share) * cycle_.orbit[k * n + s] + share * cycle_.orbit[(k + 1) * n + s];
    }
    state[n * joints_ + i] = 0;
  }
}

void CycleNetwork::derivative(const Measured&, In state, Out rate) const {
  const std::size_t n = oscillator_->states();
  // The first block of `rate` contains the phases, and the last block the paces, until both have been read. Then the rates
  // overwrite them.
  const Out phase = rate.subspan(0, joints_);
  const Out pace = rate.subspan(n * joints_, joints_);
  for (std::size_t i = 0; i < joints_; ++i) {
    const Local x = local(state, i);
    const auto [sine, cosine] = oscillator_->point({x.data(), n});
    phase[i] = cycle_.angle.phase(math::atan2(sine, cosine));
    pace[i] = kTurn * keys_.frequency[i];
  }
  for (const Coupling& c : network_.couplings) {
    const auto from = static_cast<std::size_t>(c.from);
    const auto to = static_cast<std::size_t>(c.to);
    pace[to] += c.weight * math::sin(phase[from] - phase[to] + c.phase_lag);
  }
  for (std::size_t i = 0; i < joints_; ++i) {
    const Local x = local(state, i);
    Local dx{};
    oscillator_->derivative({x.data(), n}, {dx.data(), n});
    // The pace must not be negative, because the limit cycle is unstable backwards in time.
    const double forward = std::max(0.0, pace[i]) * cycle_.period / kTurn;
    for (std::size_t k = 0; k < n; ++k) rate[k * joints_ + i] = forward * dx[k];
    rate[n * joints_ + i] = model_.amplitude_rate * (keys_.amplitude[i] - state[n * joints_ + i]);
  }
}

void CycleNetwork::output(double, In state, Out setpoint) const {
  const std::size_t n = oscillator_->states();
  for (std::size_t i = 0; i < joints_; ++i) {
    const Local x = local(state, i);
    setpoint[i] = keys_.offset[i] + state[n * joints_ + i] * oscillator_->output({x.data(), n}) / cycle_.amplitude;
  }
}

}  // namespace gaitlab::cpg
