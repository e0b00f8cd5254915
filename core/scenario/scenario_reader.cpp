#include "core/scenario/scenario_reader.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>
#include <iterator>
#include <optional>
#include <utility>

#include "core/plugin/plugin_instance.h"
#include "core/robot_files/body_pair_list.h"
#include "core/robot_files/leg_list.h"
#include "core/robot_files/servo_file.h"
#include "core/scenario/built_robot.h"
#include "core/scenario/change_section.h"
#include "core/scenario/cpg_file.h"
#include "core/scenario/ground_section.h"
#include "core/scenario/group_section.h"
#include "core/scenario/key_lookup.h"
#include "core/scenario/plugin_files.h"
#include "core/scenario/replaced_motors.h"
#include "core/scenario/robot_section.h"
#include "core/scenario/scenario_checks.h"
#include "core/scenario/scenario_periods.h"
#include "core/scenario/section_places.h"
#include "core/scenario/sensor_section.h"
#include "core/settings/joint_patterns.h"
#include "core/settings/overlay.h"
#include "core/settings/text_file.h"
#include "core/settings/wording.h"

namespace gaitlab {

ScenarioReader::ScenarioReader(const std::string& path, Catalog& catalog, ReadAs as) : path_(path), catalog_(catalog), as_(as) {
  scenario_.file = path;
  folder_ = std::filesystem::path(path).parent_path().string();
  if (folder_.empty()) folder_ = ".";
}

const Scenario& ScenarioReader::read(std::string text, const std::vector<std::string>& sets) {
  text_ = std::move(text);
  std::optional<Node> root = parse_yaml(text_, path_, problems_);
  if (!root) raise();
  root_ = std::move(*root);
  const std::vector<Retyped> retyped = apply_sets(root_, sets, problems_);
  Reader head(root_, "the scenario", problems_, nullptr);
  if (!head.version("gaitlab")) raise();  // in another version, the keys have other meanings
  if (const Node* plugins = root_.find("plugins")) {
    scenario_.plugins = read_plugins(*plugins, folder_, catalog_, problems_);
    raise();  // without their libraries, plugins would be reported as unknown
  }
  attempt([&] {
    for (std::string& note : drop_old_keys(root_, retyped, catalog_)) add_note(std::move(note));
  });
  tell_dropped_keys(sets);
  const std::size_t before = problems_.size();
  take_files();
  if (problems_.size() > before) raise();  // keys of a servo that is missing or wrong would be reported as missing
  read_name(head);
  read_body();
  scenario_.initial.stated = given(root_, "initial", "angles").has_value();
  read_sections();
  raise();
  insert_torque_off(root_, scenario_);
  read_changes();
  choose_step();
  Scenario::Places places;
  note_places(root_, "", places);
  scenario_.places = std::make_shared<const Scenario::Places>(std::move(places));
  return scenario_;
}

Scenario ScenarioReader::with(const std::vector<std::string>& sets) const {
  if (sets.empty()) return scenario_;
  ScenarioReader own = *this;
  for (const auto& [key, section] : with_models_) {
    own.root_.items[static_cast<std::size_t>(root_.find(key) - root_.items.data())] = section;
  }
  apply_sets(own.root_, sets, own.problems_);
  own.raise();
  own.tell_dropped_keys(sets);
  own.take_files();
  own.raise();
  own.touched_ = TouchedSections(sections_of(sets));
  own.touched_.restart(own.scenario_);
  own.scenario_.initial.stated = given(own.root_, "initial", "angles").has_value();
  own.read_sections();
  own.raise();
  own.read_changes();
  own.choose_step();
  note_own_places(
      own.root_, [&](const std::string& section) { return own.reads(section); }, *scenario_.places, own.scenario_.own_places);
  return std::move(own.scenario_);
}

void ScenarioReader::raise() const {
  if (!problems_.empty()) throw InputError(in_order(problems_.list(), path_));
}

void ScenarioReader::take_files() {
  with_models_.clear();
  for (const char* const section : {"actuator", "controller"}) {
    const Node* const node = root_.find(section);
    if (node != nullptr && node->find(kServoModel) != nullptr) with_models_.emplace_back(section, *node);
  }
  if (std::optional<Node> before = insert_cpg_file(root_, folder_, catalog_, problems_))
    with_models_.emplace_back("cpg", std::move(*before));
  std::vector<Problem> hiding;
  insert_servos(root_, folder_, problems_, hiding);
  for (const Note& note : servo_notes_) std::erase(scenario_.notes, note);  // removes those of the template's servos
  servo_notes_.clear();
  for (Problem& note : hiding) servo_notes_.push_back({note.place, std::move(note.text)});
  scenario_.notes.insert(scenario_.notes.end(), servo_notes_.begin(), servo_notes_.end());
}

void ScenarioReader::add_note(std::string text) {
  if (!text.empty()) scenario_.notes.push_back({{path_}, std::move(text)});
}

void ScenarioReader::tell_dropped_keys(const std::vector<std::string>& sets) {
  const auto another = [](const std::string& set) { return set.starts_with("actuator.source="); };
  if (std::ranges::any_of(sets, another)) std::erase(scenario_.notes, source_note_);  // removes the note of the template
  source_note_ = {{path_}, drop_source(root_, sets)};
  add_note(source_note_.text);
  add_note(drop_engine_keys(root_, sets, catalog_));
}

void ScenarioReader::read_name(Reader& reader) {
  scenario_.name = std::filesystem::path(path_).stem().string();
  reader.text("name", scenario_.name, "");
  ScenarioChecks(root_, scenario_, catalog_, problems_).name();
}

void ScenarioReader::read_body() {
  const Node* node = root_.find("robot");
  if (node == nullptr) return;  // read_sections() reports it
  Reader reader(*node, "robot", problems_, nullptr);
  const Elsewhere elsewhere = key_search(catalog_, root_, scenario_);
  reader.elsewhere(&elsewhere, "robot");
  if (node->kind != Node::Kind::map) return;
  RobotParts parts = read_robot(reader, node->place, folder_, problems_);
  const Node* const pairs = reader.take(kMayOverlap);
  if (pairs != nullptr && parts.robot)
    scenario_.may_overlap = read_body_pairs(*pairs, body_names(*parts.robot), "the robot", problems_);
  if (const Node* const legs = reader.take(kLegs); legs != nullptr && parts.robot) {
    auto named = std::make_shared<Robot>(*parts.robot);
    named->stated_legs = read_legs(*legs, *named, problems_);
    parts.robot = std::move(named);
  }
  for (const Problem& note : parts.notes) scenario_.notes.push_back({note.place, note.text});
  BaseFields base{scenario_};
  base.fields(reader);
  reader.finish();
  const bool counted = base.numbers == 2 || base.numbers == 3;
  const Node* position = node->find("position");
  if (position != nullptr && counted) {
    const bool height = base.numbers == 3;  // if the height is given, on_ground need not be false
    ScenarioChecks(root_, scenario_, catalog_, problems_).height(*position, height, node->find("on_ground"));
    scenario_.on_ground = !height;
  }
  scenario_.robot = std::move(parts.robot);
  const auto battery = [&](const Module& module) { return scenario_.robot->types[module.type].battery; };
  if (scenario_.robot && std::ranges::any_of(scenario_.robot->types, [](const ModuleType& type) { return type.battery.any(); }))
    std::ranges::transform(scenario_.robot->modules, std::back_inserter(scenario_.batteries), battery);
  scenario_.module_documents = std::make_shared<const std::vector<Node>>(std::move(parts.documents));
  if (!scenario_.robot) return;
  joints_ = std::make_shared<const std::vector<std::string>>(joint_names(*scenario_.robot));
  modules_ = std::make_shared<const std::vector<std::string>>(module_names(*scenario_.robot));
  read_groups_and_legs();
}

void ScenarioReader::read_groups_and_legs() {
  const Node* const section = root_.find(kGroupsSection);
  Problems reported_later;
  const JointGroups named = section == nullptr ? JointGroups() : read_groups(*section, *joints_, *modules_, {}, reported_later);
  Initial start;
  if (const Node* node = root_.find("initial"); node != nullptr && node->kind == Node::Kind::map) {
    Reader reader(*node, "initial", reported_later, joints_.get());
    reader.groups(named);
    start.fields(reader);
  }
  std::vector<double> angles;
  for (std::size_t j = 0; j < joints_->size(); ++j) angles.push_back(start.angles[j]);
  const JointGroups legs = leg_groups(*scenario_.robot, angles, scenario_.orientation);
  if (section != nullptr) scenario_.groups = read_groups(*section, *joints_, *modules_, legs, problems_);
  scenario_.groups.insert(scenario_.groups.end(), legs.begin(), legs.end());
}

void ScenarioReader::prepare(Reader& reader) const {
  if (!touched_.all()) reader.only(touched_.names());
  reader.modules(modules_.get());
  reader.groups(scenario_.groups);
}

void ScenarioReader::read_sections() {
  const JointNames joints = joints_.get();
  Reader reader(root_, "the scenario", problems_, joints, folder_);
  const Elsewhere elsewhere = key_search(catalog_, root_, scenario_);
  reader.elsewhere(&elsewhere);
  prepare(reader);
  for (const char* known : {"gaitlab", "name", "plugins", "robot", kGroupsSection, "controller", "cpg", "sensors", "at"})
    reader.take(known);
  reader.require({"robot", "duration"});
  const TypePresets motors(Kind::actuator, scenario_.robot.get(), *scenario_.module_documents);
  const TypePresets gains(Kind::controller, scenario_.robot.get(), *scenario_.module_documents);
  if (!known_types(*scenario_.module_documents, root_, catalog_, problems_)) raise();
  if (!motors.agreed() && !given(root_, "actuator")) {
    motors.refuse(given(root_, "robot").value_or(root_.place), problems_);
    raise();  // a key of such a section would be reported as missing
  }
  SectionFields sections(scenario_, &catalog_, &problems_, without_motors() ? "none" : motors.type());
  sections.controller.type = gains.type();
  sections.has_cpg = root_.find("cpg") != nullptr;
  sections.physics.law = wanted_law(root_);
  sections.actuator.presets = [&](const Entry& entry, void* settings) { motors.fill(entry, settings, joints, problems_); };
  sections.controller.presets = [&](const Entry& entry, void* settings) { gains.fill(entry, settings, joints, problems_); };
  sections.actuator.none = !reads("actuator") && scenario_.actuator.entry == nullptr;
  if (touched_.all()) scenario_.as_built = AsBuilt::unknown();
  sections.fields(reader);
  reader.finish();
  if (touched_.all() && scenario_.robot) add_note(build_robot(scenario_, given(root_, kAsBuiltSection).has_value()));
  if (reads("actuator") && sections.actuator.sound) attempt([&] { tell_replaced_motors(motors); });
  if (const Node* const motor = root_.find("actuator"); motor != nullptr && reads("actuator")) {
    if (const Node* const logs = motor->find(kIdentified)) check_identified(*logs, scenario_.identified, problems_);
  }
  if (const Node* ground = root_.find("ground"); ground != nullptr && reads("ground"))
    finish_ground(*ground, folder_, scenario_, problems_);
  if (const Node* log = root_.find(kMeasuredSection); log != nullptr && reads(kMeasuredSection))
    finish_measured(*log, scenario_, problems_);
  if (!gains.agreed() && !given(root_, "controller") && !sections.actuator.none)
    gains.refuse(given(root_, "robot").value_or(root_.place), problems_);
  check_sections(sections, joints);
  const std::size_t before = problems_.size();
  if (reads("sensors")) scenario_.sensors = read_sensors(root_.find("sensors"), scenario_, catalog_, joints, problems_);
  if (!given(root_, "trace", "columns")) scenario_.trace.columns = default_columns(scenario_);
  const auto concerns = [&](const char* section) { return reads(section); };
  constexpr std::array kOfPlugins{"physics", "contact", "supply", "actuator", "controller", "cpg", "sensors"};
  if (std::ranges::any_of(kOfPlugins, concerns)) make_plugins(sections);
  const bool made = problems_.size() == before && (!sections.has_cpg || sections.cpg.sound);
  if (!scenario_.initial.stated && !made) return;  // the start follows from a CPG that was not made
  if (as_ != ReadAs::module_type) ScenarioChecks(root_, scenario_, catalog_, problems_).initial_angles();
}

void ScenarioReader::read_changes() {
  ScenarioReader before = *this;  // without large members, because each entry copies it
  before.root_ = {};
  before.text_.clear();
  before.problems_ = {};
  const auto read = [&before](const Node& root, const std::vector<std::string>& sections, Problems& problems) {
    ScenarioReader own = before;
    own.root_ = root;
    own.touched_ = TouchedSections(sections);
    try {
      own.touched_.restart(own.scenario_);
      own.read_sections();
      own.raise();
    } catch (const InputError& error) {
      add_all(error, problems);
    }
    return std::move(own.scenario_);
  };
  scenario_.changes = gaitlab::read_changes(root_, scenario_, joints_.get(), read, problems_);
  raise();
  if (!given(root_, "trace", "columns")) scenario_.trace.columns = default_columns(scenario_);
}

void ScenarioReader::check_sections(const SectionFields& sections, JointNames joints) {
  ScenarioChecks checks(root_, scenario_, catalog_, problems_);
  checks.law();
  if (sections.actuator.none) {
    checks.no_controller();
  } else if (without_motors()) {
    problems_.add(place_of(root_, "actuator", "type"),
                  "an actuator is given, but every hinge of the robot has drive: none; remove this section");
  }
  checks.figure_joints();
  if (joints != nullptr) scenario_.figure.joints = joints_meant(scenario_.figure.joints, *joints, scenario_.groups);
  checks.base_velocity();
  if (as_ != ReadAs::record) checks.limits();
  finish_periods(root_, scenario_, catalog_, problems_);
}

void ScenarioReader::choose_step() {
  Physics& physics = scenario_.physics;
  if (!physics.chosen_step) return;
  physics.step = physics.engine->longest_step;
  try {
    const double chosen = physics.engine->choose_step(scenario_);
    if (chosen > 0) physics.step = chosen;
  } catch (const RunError&) {
  } catch (const InputError&) {
  }
  check_step(root_, scenario_, problems_);
  raise();
}

void ScenarioReader::tell_replaced_motors(const TypePresets& motors) {
  for (const Note& note : motor_notes_) std::erase(scenario_.notes, note);  // removes the notes on the template's motors
  motor_notes_.clear();
  if (!driven() || !scenario_.robot) return;
  const auto of_motors = [](const auto& section) { return section.first == "actuator"; };
  const ReplacedMotors replaced(root_, scenario_, motors, std::ranges::any_of(with_models_, of_motors));
  motor_notes_ = replaced.notes();
  scenario_.notes.insert(scenario_.notes.end(), motor_notes_.begin(), motor_notes_.end());
  scenario_.actuator_source = replaced.source();
}

bool ScenarioReader::without_motors() const {
  return scenario_.robot && !scenario_.robot->joints.empty() &&
         std::ranges::none_of(scenario_.robot->joints, [](const Joint& joint) { return joint.driven(); });
}

template <class Use>
void ScenarioReader::attempt(Use use) {
  try {
    use();
  } catch (const PluginError& error) {
    const std::string section = word(error.kind);
    const Node* node = root_.find(section);
    const std::string other = node != nullptr ? hidden_file(*node, folder_) : "";
    problems_.add(
        place_of_fault(root_, section, error.key),
        other.empty() ? error.what() : fmt::format("{} does not take the file {}; {}", section, in_quotes(other), kNotShown));
  }
}

PerJoint ScenarioReader::start_of(const Cpg* cpg) const {
  constexpr double kRounding = 1e-12;  // rad
  if (cpg == nullptr) return {};
  const SetPointTimes times = cpg->times();
  if (cpg->states() > 0 && !times.grows_from_start) return {};
  if (!(times.full_size > 0) || !std::isfinite(times.full_size)) return {};
  std::vector<double> state(cpg->states());
  cpg->start(state);
  const std::vector<Joint>& joints = scenario_.robot->joints;
  PerJoint angles{0, std::vector<double>(joints.size())};
  cpg->output(0, state, angles.each);
  for (std::size_t j = 0; j < joints.size(); ++j) {
    double& angle = angles.each[j];
    angle = joints[j].driven() && std::abs(angle) > kRounding ? std::clamp(angle, joints[j].lo, joints[j].hi) : 0;
  }
  return angles.each == std::vector<double>(joints.size()) ? PerJoint{} : angles;
}

void ScenarioReader::make_plugins(const SectionFields& sections) {
  if (!scenario_.robot) return;
  for (const Note* const old : {&cpg_note_, &controller_note_}) {  // of the template's plugins
    if (!old->text.empty()) std::erase(scenario_.notes, *old);
  }
  if (!scenario_.initial.stated) scenario_.initial.angles = {};  // removes the start of the template's gait
  const RobotInfo robot = plugin_info(scenario_);
  std::unique_ptr<Actuator> actuator;
  std::unique_ptr<Controller> controller;
  attempt([&] {
    if (sections.actuator.sound) actuator = make_motors(scenario_);
  });
  attempt([&] {
    if (sections.controller.sound && !sections.actuator.none) controller = make_controller(scenario_.controller, robot);
    if (!controller || controller->note().empty()) return;
    controller_note_ = {{path_}, "controller: " + controller->note()};
    scenario_.notes.push_back(controller_note_);
  });
  const Node* const sensors = root_.find("sensors");
  const bool sensed = sensors == nullptr || sensors->items.empty() || !scenario_.sensors.empty();  // else with a fault
  attempt([&] {
    if (!sections.has_cpg || !sections.cpg.sound || !sensed) return;
    const auto cpg = make_cpg(scenario_.cpg, robot);
    if (!scenario_.initial.stated) scenario_.initial.angles = start_of(cpg.get());
    if (!cpg || cpg->note().empty()) return;
    cpg_note_ = {{path_}, "cpg: " + cpg->note()};
    scenario_.notes.push_back(cpg_note_);
  });
  attempt([&] {
    ScenarioChecks checks(root_, scenario_, catalog_, problems_);
    if (actuator && controller) checks.units(*actuator, *controller);
    const bool turns = !sections.actuator.sound || as_ == ReadAs::module_type || checks.play(actuator.get());
    if (actuator && turns) checks.rotors(*actuator);
    if (sections.actuator.sound) {
      checks.built_numbers(actuator.get());
      checks.supply(actuator.get());
    }
  });
}

}  // namespace gaitlab
