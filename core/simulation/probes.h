// What a trace row holds: every column with its unit, its definition and how it is read from a sample.
#pragma once
#include <functional>
#include <memory>
#include <vector>

#include "core/dynamics/inverse_dynamics.h"
#include "core/recording/recording.h"
#include "core/scenario/scenario.h"
#include "core/simulation/plant.h"

namespace gaitlab {

/// One lane at a trace tick: the state at t_k and the actuator law at that state under the command in force just before t_k.
struct Sample {
  explicit Sample(const Robot& robot, std::size_t contacts, std::size_t cpg_states);
  void forward_kinematics(const Robot& robot);  ///< fills kinematics, link orientations and sums from state
  void set_boxes(const Ground& ground);         ///< as they start
  /// The ground's boxes as `plant` has them; the signs of their quaternions continuous.
  void place_boxes(const Plant& plant);
  /// Fills reactions from what is known here and the accelerations that `plant` gives for it.
  void compute_reactions(const std::vector<ContactElement>& elements, Plant& plant, std::size_t lane);

  double t = 0;
  RobotState state;
  Kinematics kinematics;
  std::vector<Quat> orientation;  ///< of every link frame; sign continuous in time
  Sums sums;
  Vec3 gravity = Vec3::Zero();
  std::vector<double> setpoint, command, voltage, current, saturation, torque, stop_torque;
  std::vector<ContactSample> contacts;
  std::vector<BoxMotion> boxes;  ///< of Ground::boxes
  std::vector<double> cpg;
  Ledger ledger;
  StepTally tally;
  InverseDynamics reactions;  ///< at hinges, docks and base: motors, stops and contacts acting; only after react

 private:
  Acceleration acceleration_;
  std::vector<double> applied_;
  std::vector<BodyWrench> ground_;
  std::vector<Quat> before_;
};

class Probes {
 public:
  /// The columns that match the scenario's patterns, in the order of docs/conventions. Throws InputError: a pattern that
  /// matches nothing; reactions under contact.law: bullet. `sample`: outlives this, and is as at the start; it fixes the signs
  /// of the bodies' quaternions (qw >= 0).
  Probes(const Scenario& scenario, const std::vector<ContactElement>& contacts, const Cpg* cpg, std::string_view command_unit,
         const Sample& sample);

  [[nodiscard]] const std::vector<Column>& columns() const { return columns_; }
  /// Every column that a trace of the scenario could have, whatever its patterns say: units and definitions by name, which a
  /// CSV file does not hold. Throws PluginError.
  static std::vector<Column> known(const Scenario& scenario);
  /// Those of report_columns() that are not among them.
  [[nodiscard]] const std::vector<Column>& rest_columns() const { return rest_columns_; }
  /// Whether a column reads Sample::reactions.
  [[nodiscard]] bool want_reactions() const { return want_reactions_; }
  /// Whether a column reads what Sample::forward_kinematics fills in, the centre of mass aside.
  [[nodiscard]] bool want_places() const { return want_places_; }
  void fill(Out row, Out rest) const;  ///< from the sample as it is now

 private:
  using Read = std::function<double(const Sample&)>;
  explicit Probes(const Sample& sample) : sample_(sample) {}
  void add_all(const Scenario& scenario, const std::vector<ContactElement>& contacts, const Cpg* cpg,
               std::string_view command_unit);
  void add(std::string name, std::string unit, std::string definition, Read read);
  void add(std::string name, std::string unit, std::string definition, const double& number);
  void add_vector(const std::string& name, const std::string& unit, const std::string& definition,
                  const std::function<Vec3(const Sample&)>& read);
  void add_joints(const Robot& robot, bool driven, std::string_view command_unit);
  void add_base();
  void add_contacts(const std::vector<ContactElement>& contacts);
  void add_loads(const Robot& robot, const std::vector<ContactElement>& contacts);
  void add_bodies(const Robot& robot, const Sample& first);
  void add_boxes(const Ground& ground);
  void add_energy();
  void add_steps(const Robot& robot);
  void add_wrench(const std::string& name, const std::string& of, const std::function<const Wrench&(const Sample&)>& read);
  void add_reactions(const Robot& robot);
  void select(const Scenario& scenario);

  /// A number of the sample, or what is made of several.
  struct Source {
    const double* number = nullptr;
    Read read = {};
  };

  const Sample& sample_;
  std::vector<Column> columns_, rest_columns_;
  std::vector<Source> sources_, rest_sources_;
  bool want_reactions_ = false, want_places_ = false;
};

}  // namespace gaitlab
