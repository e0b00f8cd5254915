// What docks and feet bear, how far feet slide and how safely the robot stands, at control ticks.
#pragma once
#include <vector>

#include "core/simulation/probes.h"

namespace gaitlab {

/// Fills the rows of Recording::loads, one after the other. Definitions: docs/conventions.md, "Loads".
class LoadMeter {
 public:
  LoadMeter(const Scenario& scenario, const std::vector<ContactElement>& elements);

  [[nodiscard]] const std::vector<Column>& columns() const { return columns_; }
  /// The moment to be measured. To be filled in: t, state, kinematics, sums, contacts; where want_reactions(), the reactions.
  Sample& sample() { return sample_; }
  /// Docks are loaded by what is known of the engine's contact forces: of contact.law bullet too little is.
  [[nodiscard]] bool want_reactions() const { return !docks_.empty(); }
  /// A row from the sample; ways go on from the row before.
  void measure(Out row);
  /// Takes the feet that never carried a load out of the rows.
  void drop_idle_feet(Trace& loads) const;

 private:
  /// The parent's face that module `module` is docked to.
  struct DockFace {
    std::size_t module = 0, link = 0;
    Vec3 normal = Vec3::Zero();  ///< link frame
  };
  /// A body with contact elements, and what is known of it.
  struct Foot {
    std::size_t body = 0;
    std::vector<std::size_t> elements;
    double load = 0;            ///< N, at the tick before
    double slid = 0;            ///< m
    Vec3 point = Vec3::Zero();  ///< m, where the load acts
    bool idle = true;
  };
  /// A contact element at the tick before.
  struct Before {
    double fn = 0;
    Vec3 in_link = Vec3::Zero();  ///< the material point that touched
  };

  void add_columns(const Scenario& scenario);
  /// m: how far the point of the element that touched before, or else now, has moved over the ground.
  [[nodiscard]] double slide(std::size_t element) const;
  void measure(Foot& foot, Out row);
  [[nodiscard]] double margin();

  const Robot& robot_;
  const std::vector<ContactElement>& elements_;
  Sample sample_;
  double weight_ = 0;  ///< N
  bool plane_ = false;
  std::vector<DockFace> docks_;
  std::vector<Foot> feet_;
  std::vector<Column> columns_;
  std::size_t foot_columns_ = 0;  ///< where those of the feet begin
  bool first_ = true;
  Kinematics before_;
  std::vector<Before> touched_;
  Vec3 com_before_ = Vec3::Zero();
  double path_ = 0, slip_ = 0;  ///< m
  std::vector<Vec3> support_;   ///< scratch
};

}  // namespace gaitlab
