#include "core/simulation/supply.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/scenario/buses.h"

namespace gaitlab {

namespace {

constexpr double kSame = 1e-13;  // of V0; two voltages that are equal
constexpr double kShort = 1e-6;  // of V0; 0 V always satisfies the balance, which is multiplied by V
constexpr int kMostSteps = 200;  // far above what bisection needs
constexpr int kParts = 64;       // of V0, in the search for a solution below a fold

/// V^2 - V0 V + r P(V), which has the sign of V - (V0 - r I), and its slope.
struct Balance {
  double value = 0, slope = 0;
};

class Bus {
 public:
  Bus(const Supply& supply, const std::vector<BusMotor>& motors) : supply_(supply), motors_(motors) {}

  [[nodiscard]] double power(double bus) const { return sum(bus).value; }

  [[nodiscard]] Balance balance(double bus) const {
    const Balance drawn = sum(bus);
    return {bus * bus - supply_.voltage * bus + supply_.resistance * drawn.value,
            2 * bus - supply_.voltage + supply_.resistance * drawn.slope};
  }

 private:
  /// Power drawn, W, and its slope, W/V.
  [[nodiscard]] Balance sum(double bus) const {
    Balance all;
    for (const BusMotor& one : motors_) {
      const DcMotor& motor = *one.motor;
      const double wanted = one.volts(bus);
      const double most = std::min(one.bound(bus), motor.u_max);
      const double u = std::clamp(wanted, -most, most);
      const DcMotor::Effort effort = motor(u, one.speed);
      all.value += effort.drawn;
      const bool follows = one.duty || std::abs(wanted) > bus;
      if (effort.limited || !follows || std::abs(u) >= motor.u_max || bus <= 0) continue;
      const bool back = motor.returns > 0 && effort.current * one.speed < 0;
      const double of_volt = back ? 2 * effort.current + motor.efficiency * motor.Kt * motor.gear * one.speed / motor.R
                                  : effort.current + u / motor.R;
      all.slope += of_volt * u / bus;
    }
    if (all.value < 0 && !supply_.regenerates) return {};
    return all;
  }

  const Supply& supply_;
  const std::vector<BusMotor>& motors_;
};

/// Root between `low` with a balance of at most 0 and `high` with a positive one: by Newton's steps, or by halves if such a
/// step leaves the bounds.
double root(const Bus& bus, double low, double high, double same) {
  double at = high;
  for (int i = 0; i < kMostSteps && high - low > same; ++i) {
    const Balance here = bus.balance(at);
    (here.value > 0 ? high : low) = at;
    const double step = here.value / here.slope;
    const double next = at - step;
    const bool inside = next > low && next < high;
    if (inside && std::abs(step) <= same / 2) return next;
    at = inside ? next : low + (high - low) / 2;
  }
  return low + (high - low) / 2;
}

}  // namespace

double BusMotor::volts(double bus) const { return duty ? command * bus : command; }

double BusMotor::bound(double bus) const { return duty ? most * bus : bus; }

BusState solve(const Supply& supply, const std::vector<BusMotor>& motors) {
  const Bus bus(supply, motors);
  const double V0 = supply.voltage;
  const double same = kSame * V0;
  const auto found = [&](double voltage, bool held) {
    const double power = bus.power(voltage);
    return BusState{voltage, power / voltage, held};
  };
  if (!(supply.resistance > 0) || bus.power(V0) == 0) return found(V0, true);
  double high = V0;
  while (!(bus.balance(high).value > 0) && high < 1e6 * V0) high *= 2;  // motors that brake raise the voltage
  if (high > V0) return found(root(bus, V0, high, same), true);
  // Newton's steps from above lead to the largest solution while the balance is convex.
  for (int i = 0; i < kMostSteps; ++i) {
    const Balance here = bus.balance(high);
    if (!(here.slope > 0)) break;
    const double next = high - here.value / here.slope;
    if (!(next > kShort * V0)) break;
    if (high - next <= same) return found(next, true);
    if (!(bus.balance(next).value > 0)) return found(root(bus, next, high, same), true);
    high = next;
  }
  for (int part = kParts - 1; part > 0; --part) {
    const double low = V0 * part / kParts;
    if (low < high && !(bus.balance(low).value > 0)) return found(root(bus, low, high, same), true);
    high = std::min(high, low);
  }
  return found(V0 / 2, false);
}

BusState held(const Supply& supply, const std::vector<BusMotor>& motors) {
  double power = 0;
  for (const BusMotor& one : motors) power += (*one.motor)(one.volts(supply.voltage), one.speed).drawn;
  return {supply.voltage, (supply.regenerates ? power : std::max(0.0, power)) / supply.voltage, true};
}

LaneSupply::LaneSupply(const Scenario& scenario, const LaneChanges& changes, const DcMotor* motors, std::size_t lane,
                       std::size_t lanes)
    : lane_(lane),
      lanes_(lanes),
      duty_(changes.controller(0)->command_unit() == "duty"),
      unlimited_(!scenario.duty_volts.empty()),
      volts_(scenario.duty_volts) {
  const std::vector<MotorBus> all = gaitlab::buses(scenario);
  if (motors == nullptr || !(duty_ || !all.empty())) return;
  motors_ = motors;
  const double share = motor_build(scenario.as_built, 0).supply;
  for (const MotorBus& bus : all) {
    buses_.push_back({bus.supply, bus.joints, std::vector<BusMotor>(bus.joints.size())});
    buses_.back().supply.voltage *= share;
  }
  states_.resize(all.size());
  buses_.emplace_back();
  const std::size_t joints = scenario.robot->joints.size();
  for (std::size_t j = 0; j < joints; ++j) {
    if (scenario.robot->joints[j].driven() && !supply_of(scenario, j).any()) buses_.back().joints.push_back(j);
    if (scenario.duty_volts.empty()) volts_.push_back(motors[j * lanes + lane].u_max);
  }
  buses_.back().motors.resize(buses_.back().joints.size());
  for (std::size_t segment = 0; segment < changes.segments(); ++segment) {
    std::vector<double>& most = most_.emplace_back(joints, 1.0);
    const std::vector<PositionGains> gains = duty_ ? changes.controller(segment)->gains() : std::vector<PositionGains>();
    for (std::size_t j = 0; j < gains.size(); ++j) most[j] = gains[j].most;
  }
}

void LaneSupply::apply(std::size_t segment, In speed, Out command, Out bound) {
  for (std::size_t b = 0; b < buses_.size(); ++b) {
    Bus& bus = buses_[b];
    for (std::size_t k = 0; k < bus.joints.size(); ++k) {
      const std::size_t j = bus.joints[k];
      bus.motors[k] = {&motors_[j * lanes_ + lane_], speed[j], command[j], duty_, most_[segment][j]};
    }
    const bool supplied = bus.supply.any();
    if (supplied) states_[b] = unlimited_ ? held(bus.supply, bus.motors) : solve(bus.supply, bus.motors);
    const bool bounds = supplied && !unlimited_;
    for (std::size_t k = 0; k < bus.joints.size(); ++k) {
      const std::size_t j = bus.joints[k];
      const double volts = bounds ? states_[b].voltage : volts_[j];
      command[j] = bus.motors[k].volts(volts);
      if (bounds || bus.motors[k].most < 1) bound[j] = bus.motors[k].bound(volts);
    }
  }
}

}  // namespace gaitlab
