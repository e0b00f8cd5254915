// Supply of the motors: voltage of each bus, and the commands in volts that it permits.
#pragma once
#include <cstdint>
#include <span>
#include <vector>

#include "core/laws/dc_motor.h"
#include "core/plugin/controller.h"
#include "core/scenario/scenario.h"
#include "core/simulation/bus_state.h"
#include "core/simulation/lane_changes.h"

namespace gaitlab {

/// Motor of a bus at a control tick.
struct BusMotor {
  const DcMotor* motor = nullptr;
  double speed = 0;                              ///< rad/s at the joint
  double command = 0;                            ///< V, or a duty
  bool duty = false;                             ///< true for a duty, which is a share of the bus voltage
  double most = 1;                               ///< largest |duty|
  [[nodiscard]] double volts(double bus) const;  ///< command at this bus voltage, before limits, V
  [[nodiscard]] double bound(double bus) const;  ///< limit of that command by bus and `most`, V
};

/// Solves the voltage V of a bus (docs/equations.md, 3):
///     V = V0 - r I,    I = sum of u i / V, u within +-V
/// u: voltage of a motor, i: its current; V0: open-circuit voltage, r: resistance of battery and wires. A negative sum counts
/// as 0, unless the supply regenerates. The result is the largest solution, to 1e-13 of V0.
BusState solve(const Supply& supply, const std::vector<BusMotor>& motors);

/// The bus of a supply that holds its open-circuit voltage, whatever the motors draw, and bounds no command.
BusState held(const Supply& supply, const std::vector<BusMotor>& motors);

/// Commands of a lane in volts, and their bounds.
class LaneSupply {
 public:
  LaneSupply() = default;
  /// `motors` has an entry joint * lanes + lane for each joint; it must outlive the object, and may change between ticks.
  LaneSupply(const Scenario& scenario, const LaneChanges& changes, const DcMotor* motors, std::size_t lane, std::size_t lanes);

  /// True if commands are converted or bounded.
  [[nodiscard]] bool any() const { return motors_ != nullptr; }
  /// Number of buses (buses(), core/scenario/buses.h).
  [[nodiscard]] std::size_t buses() const { return states_.size(); }
  [[nodiscard]] double open_circuit(std::size_t bus) const { return buses_[bus].supply.voltage; }
  /// Converts the commands of a tick, by joint, from the unit of the controller to volts, and writes their bounds.
  void apply(std::size_t segment, In speed, Out command, Out bound);
  [[nodiscard]] std::span<const BusState> states() const { return states_; }

 private:
  const DcMotor* motors_ = nullptr;
  std::size_t lane_ = 0, lanes_ = 1;
  bool duty_ = false;
  bool unlimited_ = false;                 ///< true in a run without motor limits: no supply bounds a command
  std::vector<double> volts_;              ///< voltage of duty 1, by joint, without a supply
  std::vector<std::vector<double>> most_;  ///< largest duty by segment and joint
  /// Motors of driven joints that share a supply, or, in the last entry, have none.
  struct Bus {
    Supply supply;  ///< as built
    std::vector<std::size_t> joints;
    std::vector<BusMotor> motors;
  };
  std::vector<Bus> buses_;
  std::vector<BusState> states_;
};

}  // namespace gaitlab
