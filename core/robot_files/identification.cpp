#include "core/robot_files/identification.h"

#include <fmt/format.h>

#include <array>

#include "core/settings/wording.h"

namespace gaitlab {

namespace {

constexpr std::array kQuantities{"angle", "speed", "voltage", "current", "torque", "duty"};
constexpr std::array kUnits{"rad", "rad/s", "V", "A", "N m", ""};
constexpr double kMost = 1e6;

}  // namespace

void Identification::fields(Fields& f) {
  f.integer("logs", logs, {"", 0, kMost, "Number of logs that were fitted."});
  f.integer("held_out_logs", held_out_logs, {"", 0, kMost, "Number of logs that were held out."});
  f.choice("quantity", quantity, kQuantities, "Quantity of the errors.");
  f.number("error", error,
           {"", 0, kMost, "Mean magnitude of simulated - logged, of the fitted logs, in SI units; 0: not known."});
  f.number("held_out", held_out, {"", 0, kMost, "The same, of the logs that were held out."});
  f.number("held_out_before", held_out_before, {"", 0, kMost, "The same, of the logs that were held out, before the fit."});
  f.number("speed", speed, {"rad/s", 0, kMost, "Largest speed in the fitted logs; 0: not known."});
  f.number("torque", torque, {"N m", 0, kMost, "Largest torque on the joint in the fitted logs; 0: not known."});
  f.text("by", by, "Origin of the logs.");
  f.text("hash", hash, "Hash of the fitted logs.");
}

std::string error_text(double error, Identification::Quantity quantity) {
  constexpr double kMilli = 1e-3;
  if (quantity == Identification::Quantity::angle) return fmt::format("{:.3g} mrad", error / kMilli);
  const std::string unit = kUnits[static_cast<std::size_t>(quantity)];
  return fmt::format("{:.3g}{}{}", error, unit.empty() ? "" : " ", unit);
}

std::string short_text(const Identification& of) {
  std::string error = of.held_out_logs > 0 ? "held-out MAE " + error_text(of.held_out, of.quantity) : "none held out";
  if (of.held_out_before > 0 && of.held_out > of.held_out_before)
    error += ", worse than " + error_text(of.held_out_before, of.quantity) + " before the fit";
  return fmt::format("identified from {} ({})", counted(static_cast<std::size_t>(of.logs), "log"), error);
}

std::string long_text(const Identification& of) {
  std::string text = fmt::format("identified from {}", counted(static_cast<std::size_t>(of.logs), "log"));
  if (!of.by.empty()) text += " of " + of.by;
  if (of.error > 0) text += ", fitted to " + error_text(of.error, of.quantity);
  if (of.held_out_logs > 0) {
    text += fmt::format(", held-out error {} on {}", error_text(of.held_out, of.quantity),
                        counted(static_cast<std::size_t>(of.held_out_logs), "log"));
    if (of.held_out_before > 0) text += fmt::format(" ({} before the fit)", error_text(of.held_out_before, of.quantity));
  } else {
    text += ", none held out";
  }
  if (of.speed > 0) text += fmt::format(", speeds up to {:.3g} rad/s", of.speed);
  if (of.torque > 0) text += fmt::format(", torques up to {:.3g} N m", of.torque);
  return text;
}

}  // namespace gaitlab
