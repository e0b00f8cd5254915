// Logs to which the numbers of a servo were fitted: their count, errors and extent.
#pragma once
#include <cstdint>
#include <string>

#include "core/plugin/fields.h"

namespace gaitlab {

inline constexpr const char* kIdentified = "identified";  ///< section of servo files, and of actuators with their numbers

/// Keys of section `identified`. Errors are mean magnitudes of simulated minus logged `quantity`, in its unit; 0: not
/// known.
struct Identification {
  enum class Quantity : std::size_t { angle, speed, voltage, current, torque, duty };  // as Logged

  std::int64_t logs = 0;           ///< fitted; 0 without an identification
  std::int64_t held_out_logs = 0;  ///< not fitted
  Quantity quantity = Quantity::angle;
  double error = 0;            ///< of the fitted logs
  double held_out = 0;         ///< of the logs that are held out
  double held_out_before = 0;  ///< of the same logs before the fit
  double speed = 0;            ///< largest speed of the joint in the fitted logs, rad/s; 0: not known
  double torque = 0;           ///< largest torque on the joint in the runs of the fitted logs, N m; 0: not known
  std::string by = {};         ///< origin of the logs
  std::string hash = {};       ///< hash of the fitted logs

  [[nodiscard]] bool any() const { return logs > 0; }
  bool operator==(const Identification&) const = default;
  void fields(Fields& f);
};

/// `identified from 8 logs (held-out MAE 43.6 mrad)`, or, without held-out logs, `identified from 8 logs (none held out)`.
std::string short_text(const Identification& identified);

/// The same with all numbers that are known: `identified from 8 logs of Rhoban/bam, fitted to 24.5 mrad, held-out error 43.6
/// mrad on 8 logs (45.2 mrad before the fit), speeds up to 13.2 rad/s, torques up to 0.5 N m`.
std::string long_text(const Identification& identified);

/// A mean error with its unit, that of an angle in mrad: `43.6 mrad`.
std::string error_text(double error, Identification::Quantity quantity);

}  // namespace gaitlab
