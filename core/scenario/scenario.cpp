// read_scenario: the file, --set, plugins, robot and sections in this order; then what only the whole can show.
#include "core/scenario/scenario.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <map>

#include "core/scenario/ground_section.h"
#include "core/scenario/overlay.h"
#include "core/scenario/periods.h"
#include "core/scenario/plugin_files.h"
#include "core/scenario/plugin_instance.h"
#include "core/scenario/reader.h"
#include "core/scenario/robot_section.h"
#include "core/scenario/section_places.h"
#include "core/scenario/sections.h"
#include "core/scenario/text_file.h"
#include "core/scenario/value.h"

namespace gaitlab {
namespace {

/// The default motor that the module types name.
struct TypeMotor {
  std::string type = default_type("actuator");
  const Node* map = nullptr;  ///< its keys, where all types that have a motor agree
  bool agreed = true;
};

TypeMotor motor_of(const std::vector<Node>& documents) {
  TypeMotor motor;
  for (const Node& document : documents) {
    const Node* map = document.find("actuator");
    if (map == nullptr || map->kind != Node::Kind::map) continue;
    const Node* type = map->find("type");
    if (motor.map == nullptr) {
      motor.map = map;
      if (type != nullptr) motor.type = type->text;
    } else if (print_yaml(*map) != print_yaml(*motor.map)) {
      motor.agreed = false;
    }
  }
  return motor;
}

class ScenarioReader {
 public:
  ScenarioReader(const std::string& path, Catalog& catalog) : path_(path), catalog_(catalog) {
    scenario_.file = path;
    folder_ = std::filesystem::path(path).parent_path().string();
    if (folder_.empty()) folder_ = ".";
  }

  Scenario read(const std::vector<std::string>& sets) {
    const std::string text = read_text(path_);
    std::optional<Node> root = parse_yaml(text, path_, problems_);
    if (!root) raise();
    root_ = std::move(*root);
    const std::vector<Retyped> retyped = apply_sets(root_, sets, problems_);
    Reader head(root_, "the scenario", problems_, nullptr);
    if (!head.version("gaitlab")) raise();  // another version's keys mean something else
    if (const Node* plugins = root_.find("plugins")) {
      scenario_.plugins = read_plugins(*plugins, folder_, catalog_, problems_);
      raise();  // what a library would have registered would be reported as unknown
    }
    attempt([&] { scenario_.notes = drop_old_keys(root_, retyped, catalog_); });
    read_name(head);
    read_body();
    read_sections();
    raise();
    note_places(root_, "", scenario_.places);
    return std::move(scenario_);
  }

 private:
  void raise() const {
    if (!problems_.empty()) throw InputError(in_order(problems_.list(), path_));
  }

  void read_name(Reader& reader) {
    scenario_.name = std::filesystem::path(path_).stem().string();
    reader.text("name", scenario_.name, "");
    const Node* node = root_.find("name");
    if (is_name(scenario_.name, "_.-") && scenario_.name[0] != '.') return;
    if (node != nullptr && node->kind != Node::Kind::scalar) return;
    problems_.add(node != nullptr ? node->place : Place{path_},
                  "name " + in_quotes(scenario_.name) + " is not allowed; expected letters, digits, _ . and -, not a . first" +
                      (node != nullptr ? "" : " (it is the file's name; give another with name:)"));
  }

  void read_body() {
    const Node* node = root_.find("robot");
    if (node == nullptr) {
      problems_.add(root_.place, "missing key 'robot'");
      return;
    }
    Reader reader(*node, "robot", problems_, nullptr);
    if (node->kind != Node::Kind::map) return;
    RobotParts parts = read_robot(reader, node->place, folder_, problems_);
    BaseFields base{scenario_};
    base.fields(reader);
    reader.finish();
    const bool counted = base.numbers == 2 || base.numbers == 3;
    const Node* position = node->find("position");
    if (position != nullptr && counted) check_height(*position, base.numbers == 3, node->find("on_ground"));
    scenario_.robot = std::move(parts.robot);
    scenario_.module_documents = std::move(parts.documents);
    if (scenario_.robot) joints_ = joint_names(*scenario_.robot);
  }

  /// A height and on_ground exclude one another; whoever gives a height need not turn on_ground off.
  void check_height(const Node& position, bool given, const Node* on_ground) {
    if (on_ground != nullptr && scenario_.on_ground == given) {
      problems_
          .add(position.place, given ? "position has a height and on_ground is true; expected [x, y], or no on_ground"
                                     : "position has no height and on_ground is false; expected [x, y, z], or no on_ground")
          .notes.emplace_back(on_ground->place, "on_ground is here");
    }
    scenario_.on_ground = !given;
  }

  void read_sections() {
    const JointNames joints = scenario_.robot ? &joints_ : nullptr;
    Reader reader(root_, "the scenario", problems_, joints, folder_);
    for (const char* known : {"gaitlab", "name", "plugins", "robot", "controller", "cpg"}) reader.take(known);
    reader.require({"duration"});
    if (const Node* sensors = reader.take("sensors")) check_sensors(*sensors);
    const TypeMotor motor = motor_of(scenario_.module_documents);
    SectionFields sections(scenario_, &catalog_, &problems_, motor.type);
    sections.has_cpg = root_.find("cpg") != nullptr;
    sections.physics.solver = asks_for_solver();
    sections.actuator.presets = [&](const Entry& entry, void* settings) {
      if (motor.map == nullptr || !motor.agreed || entry.name != motor.type) return;
      Reader preset(*motor.map, "actuator", problems_, joints);
      preset.take("type");
      preset.take("source");
      visit_settings(entry, settings, preset);
      preset.finish();
    };
    sections.fields(reader);
    reader.finish();
    if (const Node* ground = root_.find("ground")) finish_ground(*ground, folder_, scenario_, problems_);
    check_motors(motor);
    check_law();
    if (sections.actuator.none) refuse_controller();
    check_initial();
    check_base_velocity();
    check_all_periods();
    make_plugins(sections);
  }

  void check_sensors(const Node& node) {
    if (node.kind == Node::Kind::list && node.items.empty()) return;
    const std::string what = node.kind == Node::Kind::list ? fmt::format("a list of {}", node.items.size()) : found(node);
    problems_.add(node.place, fmt::format("sensors is {}; expected [], there are no sensor types yet", what));
  }

  /// Before its section is read: the step's default is above it.
  [[nodiscard]] bool asks_for_solver() const {
    const Node* contact = root_.find("contact");
    const Node* law = contact == nullptr ? nullptr : contact->find("law");
    return law != nullptr && law->text == "bullet";
  }

  /// What Bullet's own solver cannot do.
  void check_law() {
    const Engine* engine = scenario_.physics.engine;
    if (!scenario_.contact.solver() || engine == nullptr) return;
    if (!(engine->solver_step > 0)) {
      std::vector<std::string> able;
      for (const std::string& name : catalog_.engines()) {
        if (catalog_.engine(name)->solver_step > 0) able.push_back(name);
      }
      problems_.add(place_of(root_, "contact", "law"),
                    fmt::format("engine '{}' has no contact law 'bullet'; expected penalty{}", engine->name,
                                able.empty() ? "" : fmt::format(", or engine: {}", fmt::join(able, " or "))));
    }
    if (scenario_.physics.integrator != &engine->integrators.front()) {
      problems_.add(place_of(root_, "physics", "integrator"),
                    fmt::format("contact law 'bullet' takes steps of its own; expected {}", engine->integrators.front().name));
    }
    if (scenario_.ground.kind == Ground::Kind::heightfield) {
      problems_.add(place_of(root_, "ground", "type"),
                    "contact law 'bullet' knows no heightfield; expected none, plane or boxes");
    }
  }

  void check_motors(const TypeMotor& motor) {
    if (motor.agreed || given(root_, "actuator")) return;
    Problem& problem =
        problems_.add(given(root_, "robot").value_or(root_.place),
                      "the module types have different actuators; say which one holds: add actuator: {type: ...}");
    for (const Node& document : scenario_.module_documents) {
      if (const Node* map = document.find("actuator")) problem.notes.emplace_back(map->place, "one is here");
    }
  }

  void refuse_controller() {
    if (const std::optional<Place> place = given(root_, "controller")) {
      problems_.add(*place, "a controller is given, but there is no actuator to command; remove this section")
          .notes.emplace_back(place_of(root_, "actuator", "type"), "the actuator is none");
    }
  }

  /// Place of a joint's initial angle.
  [[nodiscard]] Place angle_place(std::size_t joint) const {
    const Node* initial = root_.find("initial");
    const Node* angles = initial == nullptr ? nullptr : initial->find("angles");
    if (angles == nullptr) return place_of(root_, "initial", "angles");
    if (angles->kind == Node::Kind::list && joint < angles->items.size()) return angles->items[joint].place;
    if (const Node* own = angles->find(joints_[joint])) return own->place;
    if (const Node* common = angles->find("default")) return common->place;
    return angles->place;
  }

  void check_initial() {
    if (!scenario_.robot) return;
    const std::vector<Joint>& joints = scenario_.robot->joints;
    const PerJoint& angles = scenario_.initial.angles;
    if (!angles.each.empty() && angles.each.size() != joints.size()) return;
    struct Outside {
      Place place;
      std::string text;
      int more = 0;
    };
    std::map<std::string, Outside> findings;  // one a place: a number may stand for all joints
    for (std::size_t j = 0; j < joints.size(); ++j) {
      const double angle = angles[j];
      if (angle >= joints[j].lo - 1e-9 && angle <= joints[j].hi + 1e-9) continue;
      const Place place = angle_place(j);
      const auto [it, fresh] = findings.emplace(to_string(place), Outside{place, {}});
      if (fresh) {
        it->second.text = fmt::format("the initial angle of joint '{}' is {} rad; allowed are {} to {} rad", joints[j].name,
                                      number_text(angle), number_text(joints[j].lo), number_text(joints[j].hi));
      } else {
        ++it->second.more;
      }
    }
    for (const auto& [key, outside] : findings) {
      const std::string others =
          outside.more == 1 ? "; so has 1 more joint" : fmt::format("; so have {} more joints", outside.more);
      problems_.add(outside.place, outside.text + (outside.more > 0 ? others : ""));
    }
  }

  /// A base cannot start with a velocity that it cannot have.
  void check_base_velocity() {
    const Vec3& v = scenario_.initial.base_velocity;
    const Vec3& w = scenario_.initial.base_angular_velocity;
    const bool planar = scenario_.base == Base::planar;
    if (scenario_.base == Base::floating) return;
    const std::string allowed = planar ? "a planar base moves along x and z and turns about y" : "a fixed base does not move";
    if (planar ? v.y() != 0 : v != Vec3::Zero()) problems_.add(place_of(root_, "initial", "base_velocity"), allowed);
    if (planar ? w.x() != 0 || w.z() != 0 : w != Vec3::Zero()) {
      problems_.add(place_of(root_, "initial", "base_angular_velocity"), allowed);
    }
  }

  void check_all_periods() {
    // Nothing is commanded: the control tick only watches the step.
    if (scenario_.actuator.entry == nullptr && root_.find("cpg") == nullptr) {
      scenario_.control_period = scenario_.physics.adaptive_step ? kLongestStep : scenario_.trace.period;
      scenario_.cpg_step = scenario_.control_period;
    }
    Physics& physics_ = scenario_.physics;
    if (physics_.engine != nullptr && !physics_.adapts()) refuse_auto();
    if (physics_.adaptive_step) {
      physics_.step = longest_step(scenario_.control_period);
      return check_cpg_period();
    }
    const Period step{"step", scenario_.physics.step, given(root_, "physics", "step")};
    const Period control{"control period", scenario_.control_period, given(root_, "controller", "period")};
    const Place physics = place_of(root_, "physics", "step");
    std::vector<Period> periods{control, {"trace period", scenario_.trace.period, given(root_, "trace", "period")}};
    if (const Node* duration = root_.find("duration"); duration != nullptr && scenario_.duration > 0) {
      periods.push_back({"duration", scenario_.duration, duration->place});
    }
    if (step.value > 0) check_periods(periods, step, physics, problems_);
    check_cpg_period();
  }
  void check_cpg_period() {
    if (!(scenario_.cpg_step > 0)) return;
    const Period control{"control period", scenario_.control_period, given(root_, "controller", "period")};
    const Period cpg{"CPG step", scenario_.cpg_step, given(root_, "cpg", "step")};
    check_periods({control}, cpg, place_of(root_, "cpg", "step"), problems_);
  }
  /// What only integrators that choose their steps have.
  void refuse_auto() {
    const Node* physics = root_.find("physics");
    const Node* step = physics == nullptr ? nullptr : physics->find("step");
    const Node* accuracy = physics == nullptr ? nullptr : physics->find("accuracy");
    std::vector<std::string> able;
    for (const std::string& name : catalog_.engines()) {
      const Engine& engine = *catalog_.engine(name);
      if (engine.adaptive() != nullptr) {
        able.push_back(fmt::format("engine: {}, integrator: {}", name, engine.adaptive()->name));
      }
    }
    const std::string chosen =
        fmt::format("integrator '{}' of engine '{}'", scenario_.physics.integrator->name, scenario_.physics.engine->name);
    if (step != nullptr && step->text == "auto") {
      problems_.add(step->place,
                    fmt::format("{} chooses no steps; expected a number of seconds, or {}", chosen, fmt::join(able, " or ")));
    }
    if (accuracy != nullptr) {
      problems_.add(accuracy->place,
                    fmt::format("{} takes steps as given, so accuracy means nothing to it; remove it, or use {}", chosen,
                                fmt::join(able, " or ")));
    }
  }

  /// Uses a plugin; what it throws is bad input like any other.
  template <class Use>
  void attempt(Use use) {
    try {
      use();
    } catch (const PluginError& error) {
      problems_.add(place_of(root_, word(error.kind), "type"), error.what());
    }
  }

  void make_plugins(const SectionFields& sections) {
    if (!scenario_.robot) return;
    const RobotInfo robot = info(*scenario_.robot);
    std::unique_ptr<Actuator> actuator;
    std::unique_ptr<Controller> controller;
    attempt([&] {
      if (sections.actuator.sound) actuator = make_actuator(scenario_.actuator, robot);
    });
    attempt([&] {
      if (sections.controller.sound && !sections.actuator.none) controller = make_controller(scenario_.controller, robot);
    });
    attempt([&] {
      if (!sections.has_cpg || !sections.cpg.sound) return;
      const auto cpg = make_cpg(scenario_.cpg, robot);
      if (cpg && !cpg->note().empty()) scenario_.notes.push_back("cpg: " + cpg->note());
    });
    attempt([&] {
      if (actuator && controller) check_units(*actuator, *controller);
    });
    attempt([&] {
      if (actuator) check_rotors(*actuator);
    });
  }

  void check_units(const Actuator& actuator, const Controller& controller) {
    const std::string_view command = controller.command_unit();
    if (command.empty() || command == actuator.command_unit()) return;
    const std::string_view taker = scenario_.actuator.entry->name;
    const std::string_view giver = scenario_.controller.entry->name;
    const bool chosen = given(root_, "controller").has_value();
    const std::string_view by_default = chosen ? "" : "the default ";
    Problem& problem = problems_.add(place_of(root_, chosen ? "controller" : "actuator", "type"),
                                     fmt::format("{}controller '{}' commands {}, but actuator '{}' takes {}", by_default, giver,
                                                 command, taker, actuator.command_unit()));
    if (!chosen) return;
    problem.notes.emplace_back(place_of(root_, "actuator", "type"),
                               fmt::format("actuator '{}' takes {}", taker, actuator.command_unit()));
  }

  /// An engine that cannot add rotor inertia refuses it and names the ones that can.
  void check_rotors(const Actuator& actuator) {
    const In inertia = actuator.reflected_inertia();
    const Engine* engine = scenario_.physics.engine;
    const bool some = std::any_of(inertia.begin(), inertia.end(), [](double value) { return value > 0; });
    if (some && scenario_.contact.solver()) {
      problems_.add(place_of(root_, "actuator", "rotor_inertia"),
                    "contact law 'bullet' cannot add rotor inertia; expected 0, or contact.law: penalty");
      return;
    }
    if (!some || engine == nullptr || engine->rotor_inertia) return;
    std::vector<std::string> able;
    for (const std::string& name : catalog_.engines()) {
      if (catalog_.engine(name)->rotor_inertia) able.push_back(name);
    }
    problems_.add(place_of(root_, "actuator", "rotor_inertia"),
                  fmt::format("engine '{}' cannot add rotor inertia; {}", engine->name,
                              able.empty() ? "no engine of this build can: set it to 0"
                                           : fmt::format("expected 0, or engine: {}", fmt::join(able, " or "))));
  }

  std::string path_, folder_;
  Catalog& catalog_;
  Problems problems_;
  Node root_;
  Scenario scenario_;
  std::vector<std::string> joints_;
};

}  // namespace

Scenario read_scenario(const std::string& path, const std::vector<std::string>& sets, Catalog& catalog) {
  return ScenarioReader(path, catalog).read(sets);
}

}  // namespace gaitlab
