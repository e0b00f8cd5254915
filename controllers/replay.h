// Controller `replay`, which gives the commands of a log.
#pragma once
#include <cstdint>
#include <string>
#include <vector>

#include "core/plugin/registry.h"

namespace gaitlab::controllers {

class Replay final : public Controller {
 public:
  enum class Unit { V, Nm, duty };
  struct Settings {
    std::string file = "t\n0\n", time = "t";
    Unit unit = Unit::duty;
    std::vector<JointColumn> columns;
    void fields(Fields& f);
  };
  static const char* const kManual;

  /// Throws std::invalid_argument for a log without rows, times that do not rise, and the errors of CsvTable.
  Replay(const RobotInfo& robot, const Settings& settings);
  [[nodiscard]] std::string_view command_unit() const override;
  [[nodiscard]] std::size_t states() const override { return 1; }  // number of the control tick
  void start(Out x) const override { x[0] = 0; }
  void update(const Measured&, In setpoint, In command_limit, Out x, Out command) const override;

 private:
  Unit unit_;
  double period_;             ///< s
  std::vector<double> time_;  ///< s, of the rows, from 0
  std::vector<std::size_t> joints_;
  std::vector<double> values_;  ///< command by row * joints_.size() + column
};

}  // namespace gaitlab::controllers
