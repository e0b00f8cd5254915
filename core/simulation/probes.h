// Columns of the trace, each with unit, definition and a function that reads its value from a sample.
#pragma once
#include <functional>
#include <memory>
#include <vector>

#include "core/plugin/robot_info.h"
#include "core/plugin/sensor.h"
#include "core/recording/recording.h"
#include "core/scenario/scenario.h"
#include "core/simulation/sample.h"

namespace gaitlab {

class Probes {
 public:
  /// Selects the columns that match the patterns of the scenario, in the order of docs/numbers.md. `sample` must outlive this
  /// object. It must contain the initial state, which fixes the signs of the quaternions of bodies (qw >= 0). Throws InputError
  /// if a pattern matches no column, or if reactions are wanted with contact.law: bullet.
  Probes(const Scenario& scenario, const std::vector<ContactElement>& contacts, const Cpg* cpg, std::string_view command_unit,
         const Sample& sample);

  [[nodiscard]] const std::vector<Column>& columns() const { return columns_; }
  /// All columns that a trace of the scenario can have, with units and definitions, which a CSV file does not contain. Throws
  /// PluginError.
  static std::vector<Column> known(const Scenario& scenario);
  /// The columns of report_columns() that the patterns do not match.
  [[nodiscard]] const std::vector<Column>& rest_columns() const { return rest_columns_; }
  /// True if any column reads Sample::reactions.
  [[nodiscard]] bool want_reactions() const { return want_reactions_; }
  /// True if any column except the centre of mass reads results of Sample::forward_kinematics.
  [[nodiscard]] bool want_places() const { return want_places_; }
  void fill(Out row, Out rest) const;  ///< writes the values of columns() and rest_columns()

 private:
  using Read = std::function<double(const Sample&)>;
  explicit Probes(const Sample& sample) : sample_(sample) {}
  void add_all(const Scenario& scenario, const std::vector<ContactElement>& contacts, const Cpg* cpg,
               std::string_view command_unit);
  void add(std::string name, std::string unit, std::string definition, Read read);
  void add(std::string name, std::string unit, std::string definition, const double& number);
  void add_vector(const std::string& name, const std::string& unit, const std::string& definition,
                  const std::function<Vec3(const Sample&)>& read);
  void add_joints(const Robot& robot, bool motors, std::string_view command_unit, bool faults, bool friction);
  void add_base();
  void add_contacts(const std::vector<ContactElement>& contacts);
  void add_loads(const Robot& robot, const std::vector<ContactElement>& contacts);
  void add_legs(const Robot& robot, const std::vector<Leg>& legs, const std::vector<ContactElement>& contacts);
  void add_bodies(const Robot& robot, const Sample& first);
  void add_boxes(const Ground& ground);
  void add_energy(const Robot& robot, bool friction);
  void add_steps(const Robot& robot);
  void add_wrench(const std::string& name, const std::string& of, const std::function<const Wrench&(const Sample&)>& read);
  void add_logged(const Scenario& scenario);
  void add_reactions(const Robot& robot);
  void add_sensors(const std::vector<SensorReading>& readings);
  void select(const Scenario& scenario);

  /// Source of a column: a number of the sample or a function of several.
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
