// Play of the gear of a hinge. Kernels include this file. It may therefore include the standard library only.
#pragma once

namespace gaitlab {

/// Stiffness and damping of a stop, N m/rad and N m s/rad (core/laws/hinge_stop.h).
inline constexpr double kStopStiffness = 50, kStopDamping = 0.5;

/// Lost motion between the geared motor and the link of a hinge: the motor turns the link only after it has passed through the
/// play (core/laws/gear_play.h).
struct Play {
  double width = 0;                   ///< rad, from one flank to the other; 0 for a gear without play
  double stiffness = kStopStiffness;  ///< of a flank, N m/rad
  bool encoder_at_motor = false;      ///< true if encoder and controller measure the motor instead of the link
  [[nodiscard]] bool any() const { return width > 0; }
  bool operator==(const Play&) const = default;
};

}  // namespace gaitlab
