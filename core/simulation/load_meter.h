// Loads of docks, gears and feet, slip distances of feet and stability margin, at control ticks, and loads of docks and gears
// between them.
#pragma once
#include <vector>

#include "core/dynamics/dock_load.h"
#include "core/recording/recording.h"
#include "core/scenario/scenario.h"
#include "core/simulation/records.h"
#include "core/simulation/sample.h"

namespace gaitlab {

/// Computes the rows of Recording::loads in the order of time. Definitions: docs/numbers.md, "Loads".
class LoadMeter {
 public:
  /// `wanted` must not be Loads::left_out. `gears` are the joints whose gears have a rated peak torque.
  LoadMeter(const Scenario& scenario, const std::vector<ContactElement>& elements, Loads wanted,
            std::vector<std::size_t> gears = {});

  [[nodiscard]] const std::vector<Column>& columns() const { return columns_; }
  /// Sample to measure. The caller fills its t, state, kinematics, sums and contacts, and the reactions if want_reactions().
  Sample& sample() { return sample_; }
  /// True if the sample needs reactions, which the columns of docks and gears require. A run with contact.law bullet does not
  /// have such columns, because not all contact forces are known.
  [[nodiscard]] bool want_reactions() const { return !docks_.empty() || !gears_.empty(); }
  /// Computes a row from the sample. Path lengths are sums since the first row. The loads of docks and gears are the largest
  /// ones in this sample and in all calls of watch() since the last row.
  void measure(Out row);
  /// Called between control ticks. Keeps the loads of docks and gears in the sample that are the largest since the last row.
  void watch();
  /// Removes the columns of feet that never carried a load.
  void drop_idle_feet(Trace& loads) const;

 private:
  /// Face of the parent to which module `module` is docked.
  struct DockFace {
    std::size_t module = 0, link = 0;
    Vec3 normal = Vec3::Zero();  ///< outward normal of the face, link frame
  };
  /// A body with contact elements, and its load and slip so far.
  struct Foot {
    std::size_t body = 0;
    std::vector<std::size_t> elements;
    double load = 0;            ///< N, at the previous tick
    double slid = 0;            ///< slip distance, m
    Vec3 point = Vec3::Zero();  ///< point of action of the load, m
    bool idle = true;
  };
  /// State of a contact element at the previous tick.
  struct Before {
    double fn = 0;
    Vec3 in_link = Vec3::Zero();  ///< material point that touched the ground, link frame
  };

  void add_columns(const Scenario& scenario);
  [[nodiscard]] DockLoad load(const DockFace& dock) const;
  /// Displacement of the contact point of an element since the previous tick, m. The material point that touched the ground at
  /// the previous tick is used, or the present one if none touched then.
  [[nodiscard]] Vec3 slide(std::size_t element) const;
  [[nodiscard]] std::size_t foot_width() const;
  void measure(Foot& foot, Out row);
  [[nodiscard]] double margin();

  const Robot& robot_;
  const std::vector<ContactElement>& elements_;
  Sample sample_;
  double weight_ = 0;       ///< N
  bool stability_ = false;  ///< true if there is a column of the stability margin
  bool forces_ = false;     ///< true if there are columns of the feet's forces and points of action
  double creep_speed_ = 0;  ///< m/s; below this speed, loaded contacts creep; 0 if the contact law has no such speed
  std::vector<DockFace> docks_;
  std::vector<std::size_t> gears_;    ///< joints
  std::vector<DockLoad> dock_loads_;  ///< largest loads since the last row, by index of docks_
  std::vector<double> gear_loads_;    ///< N m, the same for gears_
  bool watched_ = false;              ///< true if there are loads since the last row
  std::vector<Foot> feet_;
  std::vector<Column> columns_;
  std::size_t foot_columns_ = 0;  ///< index of the first column of the feet
  bool first_ = true;
  Kinematics before_;
  std::vector<Before> touched_;
  Vec3 com_before_ = Vec3::Zero();
  double time_before_ = 0;      ///< s
  double path_ = 0, slip_ = 0;  ///< m
  Vec3 creep_ = Vec3::Zero();   ///< m
  std::vector<Vec3> support_;   ///< scratch
};

}  // namespace gaitlab
