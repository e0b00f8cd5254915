// Plugin with the name of a built-in CPG.
#include "core/plugin/plugin.h"

namespace {
struct Again final : gaitlab::Cpg {
  struct Settings {
    void fields(gaitlab::Fields&) {}
  };
  Again(const gaitlab::RobotInfo&, const Settings&) {}
  void output(double, gaitlab::In, gaitlab::Out) const override {}
};
}  // namespace

GAITLAB_PLUGIN(registry) { gaitlab::add_cpg<Again>(registry, "sine", "not the one"); }
