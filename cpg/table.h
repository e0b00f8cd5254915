// Gait `table`, set points from a CSV text, joined like keyframes.
#pragma once
#include <string>
#include <vector>

#include "cpg/keyframes.h"

namespace gaitlab::cpg {

class Table final : public Cpg {
 public:
  struct Model {
    std::string file = "time\n0\n1\n", time;
    std::vector<JointColumn> columns;
    Keyframes::Interpolation interpolation = Keyframes::Interpolation::spline;
    bool repeat = true;
    double ramp = 0, cycle = 0;
    void fields(Fields& f);
  };
  struct Settings {
    Model model;
    void fields(Fields& f) { f.group("model", model, "Keys that only this type has."); }
  };
  static const char* const kManual;

  /// Throws std::invalid_argument with line and column of the text for a missing time column, a column that names no joint, a
  /// joint with two columns, times that do not rise, and the errors of CsvTable. Also throws the errors of the constructor of
  /// Keyframes.
  Table(const RobotInfo& robot, const Settings& settings);
  void output(double t, In state, Out setpoint) const override { frames_.output(t, state, setpoint); }
  [[nodiscard]] SetPointTimes times() const override {
    const SetPointTimes own = frames_.times();
    return {cycle_ > 0 ? cycle_ : own.period, own.full_size};
  }
  [[nodiscard]] std::string note() const override;

 private:
  Keyframes frames_;
  double cycle_;
  bool hold_;
};

}  // namespace gaitlab::cpg
