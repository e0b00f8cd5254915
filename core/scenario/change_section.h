// The section `at` of a scenario, with changes of settings and faults of joints at given times of the run.
#pragma once
#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "core/scenario/scenario.h"
#include "core/settings/reader.h"

namespace gaitlab {

/// Keys of a fault. Reader and writer visit only the keys of the fault's kind.
struct FaultKeys {
  JointFault& fault;
  bool all = false;  ///< true to visit the keys of every kind
  void fields(Fields& f);
};

/// Keys of a change, except `set` and `fault`.
struct ChangeKeys {
  Change& change;
  void fields(Fields& f) {
    f.number("t", change.t, {"s", 0, 1e6, "Time of the change; it takes effect at the first control tick from then on."});
  }
};
/// Sentences for the manual on the other keys.
inline constexpr const char* kAboutChanges =
    "Changes during the run, in order of time; each has `set`, `fault` or both (docs/real-robot.md).";
inline constexpr const char* kAboutSet =
    "New values of keys of cpg and controller, such as {cpg.frequency: 0.5}; not `type`, `period`, `step` or a key that "
    "changes the number of states.";
inline constexpr const char* kAboutFault = "A fault of joints, or a list of faults.";

/// Function that reads a scenario after a change. It reads from the whole scenario `root` the sections whose settings may
/// change during a run. If it adds problems, the result must not be used.
using ReadSegment = std::function<Scenario(const Node& root, const std::vector<std::string>& sections, Problems& problems)>;

/// Reads and checks the section. Each change is applied on top of all earlier changes. All other sections of `scenario` must be
/// known and free of problems. Returns an empty list if the section is absent.
std::vector<Change> read_changes(const Node& root, const Scenario& scenario, JointNames joints, const ReadSegment& read,
                                 Problems& problems);

/// The section for the resolved scenario. `set` contains, in full, the settings of its change and all settings that differ from
/// the previous segment.
Node changes_node(const Scenario& scenario, const std::vector<std::string>& joints);

/// Number of the first control tick at a time or later.
std::int64_t first_tick(double t, double control_period);

/// Joints with a motor that a fault names, ascending.
std::vector<std::size_t> joints_of(const JointFault& fault, const Robot& robot);

/// Fault of a joint from the control tick of one change to the tick of another. `to` is infinity for a fault until the end of
/// the run.
struct FaultSpan {
  std::size_t joint = 0;
  FaultKind kind = FaultKind::none;
  double from = 0, to = 0;  ///< s
};
/// The faults of a run, sorted by their start, then by joint. Faults without an effect (`weak` with share 1, `lost` with share
/// 0, `late` with delay 0) are not included.
std::vector<FaultSpan> fault_spans(const Scenario& scenario);

/// Time of the control tick of the last change before `end`, s; 0 without changes.
double last_change(const Scenario& scenario, double end);

/// True if a joint gets a fault in the run.
bool has_faults(const Scenario& scenario);

}  // namespace gaitlab
