// The figures of a run: summary.json and what the terminal shows.
#pragma once
#include <string>
#include <vector>

#include "core/recording/judged.h"
#include "core/scenario/scenario.h"
#include "core/simulation/simulation.h"
#include "report/posture.h"

namespace gaitlab::report {

/// Definitions of every figure: docs/conventions.md. SI.
struct Summary {
  double wall_time = 0;                             ///< s; the only figure that two equal runs do not share
  std::string build, outcome = "done";              ///< or why it ended early
  double simulated = 0;                             ///< s, less than the duration where the run stopped early
  double displacement_x = 0, displacement_y = 0;    ///< of the centre of mass, m
  double distance = 0, speed = 0, path_length = 0;  ///< m, m/s, m
  double heading_change = 0;                        ///< rad, of the base's x axis about world z
  double cost_electrical = 0, cost_mechanical = 0;  ///< J / (N m); 0 where the robot has not moved or weighs nothing
  MotionCycle limit_cycle;
  double stability_max = 0, stability_share = 0;  ///< h lambda; share of control ticks above 1
  std::string stability_source;
  Judged judged;
  Posture posture;  ///< over the judged window
  /// The joint to look at first; 0 where there is none.
  [[nodiscard]] std::size_t most_loaded() const { return judged.order.empty() ? 0 : judged.order.front(); }
};

/// Of a recording of which little is known yet: time, ways and speeds alone.
Summary travelled(const Recording& record);

Summary summarise(const Scenario& scenario, const Recording& record, double wall_time);

/// The text of summary.json.
std::string to_json(const Summary& summary, const Scenario& scenario, const Recording& record);

/// What `gaitlab run` prints; verbose: the ledger and the step's limit, too.
std::string to_text(const Summary& summary, const Scenario& scenario, const Recording& record, bool verbose = false);

/// A row per joint, the most loaded first: what each did in the judged window.
std::string joint_table(const Summary& summary, const Scenario& scenario);

/// The warning about a part of the robot that starts below the ground, or "": its height was given, or only contact elements
/// touch the ground.
std::string start_warning(const Scenario& scenario);

/// The warning about a robot that fell (the centre of mass came below Limits::height), or "".
std::string fall_warning(const Scenario& scenario, const Recording& record);

/// The warning about a step that was too long for more than 1 % of the control ticks, or "".
std::string stability_warning(const Summary& summary, const Scenario& scenario, const Recording& record);

}  // namespace gaitlab::report
