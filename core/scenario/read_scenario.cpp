// Reader of scenarios. It reads the file, --set, plugins, robot and sections in this order, and then checks the scenario as a
// whole.
#include "core/scenario/read_scenario.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>

#include "core/files/file_kind.h"
#include "core/plugin/plugin_instance.h"
#include "core/robot_files/body_pair_list.h"
#include "core/robot_files/servo_file.h"
#include "core/robot_files/type_presets.h"
#include "core/scenario/built_robot.h"
#include "core/scenario/change_section.h"
#include "core/scenario/ground_section.h"
#include "core/scenario/group_section.h"
#include "core/scenario/key_lookup.h"
#include "core/scenario/plugin_files.h"
#include "core/scenario/replaced_motors.h"
#include "core/scenario/robot_section.h"
#include "core/scenario/scenario_checks.h"
#include "core/scenario/scenario_periods.h"
#include "core/scenario/section_places.h"
#include "core/scenario/sections.h"
#include "core/scenario/sensor_section.h"
#include "core/scenario/touched_sections.h"
#include "core/settings/joint_patterns.h"
#include "core/settings/overlay.h"
#include "core/settings/reader.h"
#include "core/settings/text_file.h"
#include "core/settings/wording.h"

namespace gaitlab {

class ScenarioReader {
 public:
  enum class ReadAs { scenario, record, module_type };

  ScenarioReader(const std::string& path, Catalog& catalog, ReadAs as = ReadAs::scenario)
      : path_(path), catalog_(catalog), as_(as) {
    scenario_.file = path;
    folder_ = std::filesystem::path(path).parent_path().string();
    if (folder_.empty()) folder_ = ".";
  }

  /// Reads the text of the file. Afterwards, with() returns scenarios of rollouts.
  const Scenario& read(std::string text, const std::vector<std::string>& sets) {
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
    take_servos();
    if (problems_.size() > before) raise();  // keys of a servo that is missing or wrong would be reported as missing
    read_name(head);
    read_body();
    read_sections();
    raise();
    read_changes();
    choose_step();
    Scenario::Places places;
    note_places(root_, "", places);
    scenario_.places = std::make_shared<const Scenario::Places>(std::move(places));
    return scenario_;
  }

  [[nodiscard]] const std::string& text() const { return text_; }
  [[nodiscard]] bool driven() const { return scenario_.actuator.entry != nullptr; }
  [[nodiscard]] bool draws_robots() const { return scenario_.tolerances.any(); }

  /// The scenario with further settings of sections other than the robot's. Only the sections that depend on these settings are
  /// read again.
  [[nodiscard]] Scenario with(const std::vector<std::string>& sets) const {
    if (sets.empty()) return scenario_;
    ScenarioReader own = *this;
    for (const auto& [key, section] : with_models_) {
      own.root_.items[static_cast<std::size_t>(root_.find(key) - root_.items.data())] = section;
    }
    apply_sets(own.root_, sets, own.problems_);
    own.raise();
    own.tell_dropped_keys(sets);
    own.take_servos();
    own.raise();
    own.touched_ = TouchedSections(sections_of(sets));
    own.touched_.restart(own.scenario_);
    own.read_sections();
    own.raise();
    own.read_changes();
    own.choose_step();
    note_own_places(
        own.root_, [&](const std::string& section) { return own.reads(section); }, *scenario_.places, own.scenario_.own_places);
    return std::move(own.scenario_);
  }

 private:
  void raise() const {
    if (!problems_.empty()) throw InputError(in_order(problems_.list(), path_));
  }

  /// Inserts the keys of servos that are given by name, and keeps the sections as they were before for with().
  void take_servos() {
    with_models_.clear();
    for (const char* const section : {"actuator", "controller"}) {
      const Node* const node = root_.find(section);
      if (node != nullptr && node->find(kServoModel) != nullptr) with_models_.emplace_back(section, *node);
    }
    insert_servos(root_, folder_, problems_);
  }

  void add_note(std::string text) {
    if (!text.empty()) scenario_.notes.push_back({{path_}, std::move(text)});
  }

  void tell_dropped_keys(const std::vector<std::string>& sets) {
    const auto another = [](const std::string& set) { return set.starts_with("actuator.source="); };
    if (std::ranges::any_of(sets, another)) std::erase(scenario_.notes, source_note_);  // removes the note of the template
    source_note_ = {{path_}, drop_source(root_, sets)};
    add_note(source_note_.text);
    add_note(drop_engine_keys(root_, sets, catalog_));
  }

  void read_name(Reader& reader) {
    scenario_.name = std::filesystem::path(path_).stem().string();
    reader.text("name", scenario_.name, "");
    ScenarioChecks(root_, scenario_, catalog_, problems_).name();
  }

  void read_body() {
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
    if (scenario_.robot &&
        std::ranges::any_of(scenario_.robot->types, [](const ModuleType& type) { return type.battery.any(); }))
      std::ranges::transform(scenario_.robot->modules, std::back_inserter(scenario_.batteries), battery);
    scenario_.module_documents = std::make_shared<const std::vector<Node>>(std::move(parts.documents));
    if (!scenario_.robot) return;
    joints_ = std::make_shared<const std::vector<std::string>>(joint_names(*scenario_.robot));
    modules_ = std::make_shared<const std::vector<std::string>>(module_names(*scenario_.robot));
    if (const Node* groups = root_.find(kGroupsSection))
      scenario_.groups = read_groups(*groups, *joints_, *modules_, problems_);
  }

  [[nodiscard]] bool reads(const std::string& section) const { return touched_.has(section); }

  void prepare(Reader& reader) const {
    if (!touched_.all()) reader.only(touched_.names());
    reader.modules(modules_.get());
    reader.groups(scenario_.groups);
  }

  void read_sections() {
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
    if (const Node* ground = root_.find("ground"); ground != nullptr && reads("ground"))
      finish_ground(*ground, folder_, scenario_, problems_);
    if (!gains.agreed() && !given(root_, "controller") && !sections.actuator.none)
      gains.refuse(given(root_, "robot").value_or(root_.place), problems_);
    check_sections(sections, joints);
    if (reads("sensors")) scenario_.sensors = read_sensors(root_.find("sensors"), scenario_, catalog_, joints, problems_);
    if (!given(root_, "trace", "columns")) scenario_.trace.columns = default_columns(scenario_);
    const auto concerns = [&](const char* section) { return reads(section); };
    constexpr std::array kOfPlugins{"physics", "contact", "supply", "actuator", "controller", "cpg", "sensors"};
    if (std::ranges::any_of(kOfPlugins, concerns)) make_plugins(sections);
  }

  void read_changes() {
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

  /// Checks rules that concern several sections.
  void check_sections(const SectionFields& sections, const JointNames joints) {
    ScenarioChecks checks(root_, scenario_, catalog_, problems_);
    checks.law();
    if (sections.actuator.none) {
      checks.no_controller();
    } else if (without_motors()) {
      problems_.add(place_of(root_, "actuator", "type"),
                    "an actuator is given, but every hinge of the robot has drive: none; remove this section");
    }
    if (as_ != ReadAs::module_type) checks.initial_angles();
    checks.figure_joints();
    if (joints != nullptr) scenario_.figure.joints = joints_meant(scenario_.figure.joints, *joints, scenario_.groups);
    checks.base_velocity();
    if (as_ != ReadAs::record) checks.limits();
    finish_periods(root_, scenario_, catalog_, problems_);
  }

  /// Sets the step if the engine chooses it. If the engine refuses the robot, the engine's default step remains, and the run
  /// reports the reason.
  void choose_step() {
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

  void tell_replaced_motors(const TypePresets& motors) {
    for (const Note& note : motor_notes_) std::erase(scenario_.notes, note);  // removes the notes on the template's motors
    motor_notes_.clear();
    if (!driven() || !scenario_.robot) return;
    const ReplacedMotors replaced(root_, scenario_, motors);
    motor_notes_ = replaced.notes();
    scenario_.notes.insert(scenario_.notes.end(), motor_notes_.begin(), motor_notes_.end());
    scenario_.actuator_source = replaced.source();
  }

  /// True if the robot has hinges, but none with a motor.
  [[nodiscard]] bool without_motors() const {
    return scenario_.robot && !scenario_.robot->joints.empty() &&
           std::ranges::none_of(scenario_.robot->joints, [](const Joint& joint) { return joint.driven(); });
  }

  /// Calls `use`. An exception of a plugin becomes a problem in the input.
  template <class Use>
  void attempt(Use use) {
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

  /// Angles at the start if the scenario states none: the set points about which the ramp of a CPG scales its motion, or 0,
  /// limited to the ranges of the hinges.
  [[nodiscard]] PerJoint start_of(const Cpg* cpg) const {
    constexpr double kRounding = 1e-12;  // rad
    if (cpg == nullptr || cpg->states() > 0) return {};
    const double ramp = cpg->times().full_size;
    if (!(ramp > 0) || !std::isfinite(ramp)) return {};
    const std::vector<Joint>& joints = scenario_.robot->joints;
    PerJoint angles{0, std::vector<double>(joints.size())};
    cpg->output(0, {}, angles.each);
    for (std::size_t j = 0; j < joints.size(); ++j) {
      double& angle = angles.each[j];
      angle = joints[j].driven() && std::abs(angle) > kRounding ? std::clamp(angle, joints[j].lo, joints[j].hi) : 0;
    }
    return angles.each == std::vector<double>(joints.size()) ? PerJoint{} : angles;
  }

  void make_plugins(const SectionFields& sections) {
    if (!scenario_.robot) return;
    if (!cpg_note_.text.empty()) std::erase(scenario_.notes, cpg_note_);  // removes the note of the template's CPG
    const RobotInfo robot = plugin_info(scenario_);
    std::unique_ptr<Actuator> actuator;
    std::unique_ptr<Controller> controller;
    attempt([&] {
      if (sections.actuator.sound) actuator = make_motors(scenario_);
    });
    attempt([&] {
      if (sections.controller.sound && !sections.actuator.none) controller = make_controller(scenario_.controller, robot);
    });
    attempt([&] {
      if (!sections.has_cpg || !sections.cpg.sound) return;
      const auto cpg = make_cpg(scenario_.cpg, robot);
      if (!given(root_, "initial", "angles")) scenario_.initial.angles = start_of(cpg.get());
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

  std::string path_, folder_, text_;
  Catalog& catalog_;
  ReadAs as_;
  Problems problems_;
  Node root_;
  Scenario scenario_;
  std::shared_ptr<const std::vector<std::string>> joints_, modules_;  ///< names; null if the robot could not be read
  Note cpg_note_, source_note_;
  std::vector<Note> motor_notes_;
  std::vector<std::pair<std::string, Node>> with_models_;  ///< sections that name a servo, as written
  TouchedSections touched_;
};

Scenario read_scenario(const std::string& path, const std::vector<std::string>& sets, Catalog& catalog) {
  expect_kind(path, FileKind::scenario);
  return ScenarioReader(path, catalog).read(read_text(path), sets);
}

Scenario read_record(const std::string& text, const std::string& file, const std::vector<std::string>& sets, Catalog& catalog) {
  return ScenarioReader(file, catalog, ScenarioReader::ReadAs::record).read(text, sets);
}

Scenario read_module(const std::string& path, Catalog& catalog) {
  return ScenarioReader("module", catalog, ScenarioReader::ReadAs::module_type).read(scenario_of_module(path), {});
}

ScenarioTemplate::ScenarioTemplate(std::string path, std::vector<std::string> sets, Catalog& catalog)
    : path_(std::move(path)),
      sets_(std::move(sets)),
      catalog_(catalog),
      reader_(std::make_unique<ScenarioReader>(path_, catalog)) {
  expect_kind(path_, FileKind::scenario);
  reader_->read(read_text(path_), sets_);
}

ScenarioTemplate::~ScenarioTemplate() = default;

Scenario ScenarioTemplate::with(const std::vector<std::string>& own) const {
  // Settings that determine which keys exist, or that require the robot to be read again.
  const auto whole = [&](const std::string& set) {
    const std::string key = set.substr(0, set.find('='));
    const std::string section = key.substr(0, key.find('.'));
    constexpr std::array kWhole{"gaitlab", "name", "plugins", "robot", kGroupsSection, kTolerancesSection, kAsBuiltSection};
    if (std::ranges::find(kWhole, std::string_view(section)) != kWhole.end() || key.ends_with(".type")) return true;
    if (section == "seed" && reader_->draws_robots()) return true;
    if (key == section && find_kind(section) != nullptr) return true;  // a whole section of a plugin
    // When the template changed the type, it dropped the model of the previous type, to which this setting may refer.
    const auto types = [&](const std::string& one) { return one.starts_with(section + ".type="); };
    return key.starts_with(section + ".model") && std::ranges::any_of(sets_, types);
  };
  // The control period of a robot without a motor depends on further sections.
  if (!reader_->driven() || std::ranges::any_of(own, whole)) {
    std::vector<std::string> all = sets_;
    all.insert(all.end(), own.begin(), own.end());
    return ScenarioReader(path_, catalog_).read(reader_->text(), all);  // the text that was read first
  }
  return reader_->with(own);
}

}  // namespace gaitlab
