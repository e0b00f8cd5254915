// Battery or power supply of motors: the keys of the section `supply` and of the `battery` of a module type.
#pragma once
#include "core/plugin/fields.h"

namespace gaitlab {

struct Supply {
  double voltage = 0;        ///< open-circuit voltage, V
  double resistance = 0;     ///< of battery and wires, ohm
  double current = 0;        ///< largest current, A; 0: not stated
  double capacity = 0;       ///< A h; 0: not stated
  double least = 0;          ///< voltage below which the electronics stop, V; 0: not stated
  bool regenerates = false;  ///< true if the battery takes up the current of motors that brake
  [[nodiscard]] bool any() const { return voltage > 0; }
  bool operator==(const Supply&) const = default;
  /// Keys of the scenario's section `supply`.
  void fields(Fields& f);

 protected:
  /// `of`: name of the keys' map in messages.
  void fields(Fields& f, const char* of);
};

/// Supply of the motors of one module.
struct Battery : Supply {
  void fields(Fields& f) { Supply::fields(f, "battery"); }
};

}  // namespace gaitlab
