// Figure of a log behind its runs, with the differences under it.
#pragma once
#include <span>
#include <string>
#include <vector>

namespace gaitlab::report {

/// A quantity in a log, and in two runs at the times of its rows.
struct LogCurves {
  std::string title;          ///< of the axis: quantity with unit
  std::string of_difference;  ///< of the axis of the differences: a unit
  double scale = 1;           ///< that unit in the unit of the quantity
  std::span<const double> log, run, other;
};

/// Stretch of time, s.
struct LogStretch {
  double from = 0, to = 0;
};

/// Colours of the curves and of stretches without torque.
namespace log_colour {
inline constexpr std::string_view kLog = "#009E73", kRun = "#0072B2", kOther = "#D55E00", kOff = "#E4E4E4";
}

/// SVG text with a panel for each of `curves`: the log as a wide line behind the run, which is a line, and the other run, which
/// is a fine one; below it run - log and other - log. `t` are the times of the rows, s; each curve has as many values. The
/// stretches `off` are shaded. Runs and differences are cut where they are far beyond the log or the other differences. `title`
/// is the name of the picture for programs that read it aloud.
std::string log_figure(const std::string& title, std::span<const double> t, std::span<const LogStretch> off,
                       std::span<const LogCurves> curves);

}  // namespace gaitlab::report
