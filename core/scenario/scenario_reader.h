// Reader of scenarios. It reads the file, --set, plugins, robot and sections in this order, and then checks the scenario as a
// whole.
#pragma once
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "core/robot_files/type_presets.h"
#include "core/scenario/scenario.h"
#include "core/scenario/sections.h"
#include "core/scenario/touched_sections.h"
#include "core/settings/reader.h"

namespace gaitlab {

/// Reader of one scenario, and of others that differ from it in a few settings (ScenarioTemplate). Throws InputError with every
/// problem found.
class ScenarioReader {
 public:
  enum class ReadAs { scenario, record, module_type };

  ScenarioReader(const std::string& path, Catalog& catalog, ReadAs as = ReadAs::scenario);

  /// Reads the text of the file. Afterwards, with() returns scenarios of rollouts.
  const Scenario& read(std::string text, const std::vector<std::string>& sets);

  [[nodiscard]] const std::string& text() const { return text_; }
  [[nodiscard]] bool driven() const { return scenario_.actuator.entry != nullptr; }
  [[nodiscard]] bool draws_robots() const { return scenario_.tolerances.any(); }

  /// The scenario with further settings of sections other than the robot's. Only the sections that depend on these settings are
  /// read again.
  [[nodiscard]] Scenario with(const std::vector<std::string>& sets) const;

 private:
  void raise() const;
  /// Inserts the keys of servos and of a CPG file that are given by name, and keeps the sections as they were before for
  /// with().
  void take_files();
  void add_note(std::string text);
  void tell_dropped_keys(const std::vector<std::string>& sets);
  void read_name(Reader& reader);
  void read_body();
  /// Reads the groups, and adds the legs that the robot has in the pose of the start.
  void read_groups_and_legs();
  [[nodiscard]] bool reads(const std::string& section) const { return touched_.has(section); }
  void prepare(Reader& reader) const;
  void read_sections();
  void read_changes();
  /// Checks rules that concern several sections.
  void check_sections(const SectionFields& sections, JointNames joints);
  /// Sets the step if the engine chooses it. If the engine refuses the robot, the engine's default step remains, and the run
  /// reports the reason.
  void choose_step();
  void tell_replaced_motors(const TypePresets& motors);
  /// True if the robot has hinges, but none with a motor.
  [[nodiscard]] bool without_motors() const;
  /// Calls `use`. An exception of a plugin becomes a problem in the input.
  template <class Use>
  void attempt(Use use);
  /// Angles at the start if the scenario states none: the set points about which the ramp of a CPG scales its motion, or 0,
  /// limited to the ranges of the hinges.
  [[nodiscard]] PerJoint start_of(const Cpg* cpg) const;
  void make_plugins(const SectionFields& sections);

  std::string path_, folder_, text_;
  Catalog& catalog_;
  ReadAs as_;
  Problems problems_;
  Node root_;
  Scenario scenario_;
  std::shared_ptr<const std::vector<std::string>> joints_, modules_;  ///< names; null if the robot could not be read
  Note cpg_note_, controller_note_, source_note_;
  std::vector<Note> motor_notes_, servo_notes_;
  std::vector<std::pair<std::string, Node>> with_models_;  ///< sections that name a servo or a CPG file, as written
  TouchedSections touched_;
};

}  // namespace gaitlab
