#include "core/model/supply.h"

#include <fmt/format.h>

namespace gaitlab {

void Supply::fields(Fields& f) { fields(f, "supply"); }

void Supply::fields(Fields& f, const char* of) {
  f.number("voltage", voltage, {"V", kPositive, 1e6, "Open-circuit voltage; required."});
  f.number("resistance", resistance, {"ohm", 0, 1e6, "Resistance of battery and wires."});
  f.number("current", current, {"A", 0, 1e6, "Largest continuous current, which check battery compares; 0: not stated."});
  f.number("capacity", capacity, {"A h", 0, 1e6, "Charge of the full battery; 0: not stated."});
  f.number("least", least, {"V", 0, 1e6, "Voltage below which the electronics stop; 0: not stated."});
  f.flag("regenerates", regenerates, "True if the battery takes up the current of motors that brake.");
  if (!any() && *this != Supply()) {
    f.problem("voltage", fmt::format("{0} has no voltage; expected {0}.voltage, the open-circuit voltage in V", of));
  } else if (least > 0 && least >= voltage) {
    f.problem("least", fmt::format("{0}.least {1:.4g} V is not below {0}.voltage {2:.4g} V", of, least, voltage));
  }
}

}  // namespace gaitlab
