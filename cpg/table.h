// Gait `table`, set points from a CSV text, joined like keyframes.
#pragma once
#include <string>

#include "cpg/keyframes.h"

namespace gaitlab::cpg {

class Table final : public Cpg {
 public:
  struct Model {
    std::string file = "time\n0\n1\n";
    Keyframes::Interpolation interpolation = Keyframes::Interpolation::spline;
    bool repeat = true;
    double ramp = 0;
    void fields(Fields& f);
  };
  struct Settings {
    Model model;
    void fields(Fields& f) { f.group("model", model, "Keys that only this type has."); }
  };
  static const char* const kManual;

  /// Throws std::invalid_argument with line and column of the text for a missing time column, a column that is repeated or
  /// names no joint, a row with a wrong number of cells, or a cell that is not a finite number. Also throws the errors of the
  /// constructor of Keyframes.
  Table(const RobotInfo& robot, const Settings& settings);
  void output(double t, In state, Out setpoint) const override { frames_.output(t, state, setpoint); }
  [[nodiscard]] SetPointTimes times() const override { return frames_.times(); }

 private:
  Keyframes frames_;
};

}  // namespace gaitlab::cpg
