// Voltage and current of a bus.
#pragma once

namespace gaitlab {

/// A bus at a control tick.
struct BusState {
  double voltage = 0;  ///< V
  double current = 0;  ///< A, drawn from the battery
  bool held = true;    ///< false if no voltage satisfies the law; `voltage` is then half of the open-circuit voltage
};

}  // namespace gaitlab
