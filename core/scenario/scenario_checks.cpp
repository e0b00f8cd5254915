#include "core/scenario/scenario_checks.h"

#include <fmt/format.h>

#include <algorithm>
#include <map>

#include "core/scenario/built_robot.h"
#include "core/scenario/section_places.h"
#include "core/scenario/sections.h"
#include "core/settings/joint_patterns.h"
#include "core/settings/wording.h"

namespace gaitlab {

void ScenarioChecks::name() {
  const Node* node = root_.find("name");
  if (is_name(scenario_.name, "_.-") && scenario_.name[0] != '.') return;
  if (node != nullptr && node->kind != Node::Kind::scalar) return;
  problems_.add(node != nullptr ? node->place : SourceLocation{scenario_.file},
                "name " + in_quotes(scenario_.name) +
                    " is not allowed; expected letters, digits, `_`, `.` and `-`, but no `.` "
                    "at the start" +
                    (node != nullptr ? "" : " (it is the file's name; give another with name:)"));
}

void ScenarioChecks::height(const Node& position, bool given, const Node* on_ground) {
  if (on_ground == nullptr || scenario_.on_ground != given) return;
  problems_
      .add(position.place, given ? "position has a height, but on_ground is true; expected [x, y], or no on_ground"
                                 : "position has no height, but on_ground is false; expected [x, y, z], or no on_ground")
      .notes.emplace_back(on_ground->place, "on_ground is here");
}

void ScenarioChecks::law() {
  const Engine* engine = scenario_.physics.engine;
  const ContactModel& contact = scenario_.contact.model();
  if (engine == nullptr) return;
  if (contact.has_step_of_its_own) {
    if (!(engine->solver_step > 0)) {
      refuse_law(*engine);
    } else if (scenario_.physics.integrator != &engine->fixed()) {
      problems_.add(place_of(root_, "physics", "integrator"),
                    fmt::format("contact law '{}' works only with integrator {}", contact.text, engine->fixed().name));
    }
  }
  if (const GroundType& ground = scenario_.ground.type(); !contact.any_ground && !ground.plane_and_boxes) {
    problems_.add(place_of(root_, "ground", "type"), fmt::format("contact law '{}' does not support a {}; expected {}",
                                                                 contact.text, ground.name, plane_and_box_types()));
  }
}

void ScenarioChecks::no_controller() {
  const std::optional<SourceLocation> place = given(root_, "controller");
  if (!place) return;
  problems_.add(*place, "a controller is given, but there is no actuator to command; remove this section")
      .notes.emplace_back(place_of(root_, "actuator", "type"), "the actuator is none");
}

void ScenarioChecks::refuse_law(const Engine& engine) {
  std::vector<std::string> able;
  for (const std::string& name : catalog_.engines()) {
    if (catalog_.engine(name)->solver_step > 0) able.push_back(name);
  }
  problems_.add(
      place_of(root_, "contact", "law"),
      fmt::format("engine '{}' has no contact law '{}'; expected penalty{}", engine.name, scenario_.contact.model().text,
                  able.empty() ? "" : fmt::format(", or engine: {}", fmt::join(able, " or "))));
}

SourceLocation ScenarioChecks::angle_place(std::size_t joint) const {
  const Node* initial = root_.find("initial");
  const Node* angles = initial == nullptr ? nullptr : initial->find("angles");
  if (angles == nullptr) return place_of(root_, "initial", "angles");
  if (angles->kind == Node::Kind::list && joint < angles->items.size()) return angles->items[joint].place;
  const std::string& name = scenario_.robot->joints[joint].name;
  if (const Node* own = angles->find(name)) return own->place;
  for (std::size_t i = 0; i < angles->keys.size(); ++i) {
    const std::string& key = angles->keys[i].first;
    if (means_several(key, scenario_.groups) && !joints_of(key, {name}, scenario_.groups).empty())
      return angles->items[i].place;
  }
  if (const Node* common = angles->find("default")) return common->place;
  return angles->place;
}

void ScenarioChecks::initial_angles() {
  if (!scenario_.robot) return;
  const std::vector<Joint>& joints = scenario_.robot->joints;
  const PerJoint& angles = scenario_.initial.angles;
  if (!angles.each.empty() && angles.each.size() != joints.size()) return;
  struct Outside {
    SourceLocation place;
    std::string text;
    double angle = 0;
    int more = 0;
  };
  std::map<std::string, Outside> findings;  // one finding per place, because one number may apply to all joints
  for (std::size_t j = 0; j < joints.size(); ++j) {
    const double angle = angles[j];
    if (angle >= joints[j].lo - 1e-9 && angle <= joints[j].hi + 1e-9) continue;
    const SourceLocation place = angle_place(j);
    const auto [it, fresh] = findings.emplace(to_string(place), Outside{place, {}, angle});
    if (fresh) {
      it->second.text = fmt::format("the initial angle of joint '{}' is {} rad; expected {} to {} rad", joints[j].name,
                                    number_text(angle), number_text(joints[j].lo), number_text(joints[j].hi));
    } else {
      ++it->second.more;
    }
  }
  for (const auto& [key, outside] : findings) {
    const std::string others =
        fmt::format("; {} {} also outside the range", counted(static_cast<std::size_t>(outside.more), "more joint"),
                    outside.more == 1 ? "is" : "are");
    problems_.add(outside.place, outside.text + (outside.more > 0 ? others : "") + in_degrees(outside.angle, "rad"));
  }
}

void ScenarioChecks::figure_joints() {
  if (!scenario_.robot) return;
  const std::vector<std::string>& named = scenario_.figure.joints;
  const std::vector<std::string> joints = joint_names(*scenario_.robot);
  const Node* figure = root_.find("figure");
  const Node* list = figure == nullptr ? nullptr : figure->find("joints");
  for (std::size_t i = 0; i < named.size(); ++i) {
    const std::string wrong = no_joint(named[i], joints, "joint", scenario_.groups);
    const bool placed = list != nullptr && i < list->items.size();
    if (!wrong.empty()) problems_.add(placed ? list->items[i].place : place_of(root_, "figure", "joints"), wrong);
  }
}

void ScenarioChecks::parts_as_built() {
  const Node* section = root_.find(kAsBuiltSection);
  for (std::size_t i = 0; section != nullptr && scenario_.robot && i < kBuiltNumbers.size(); ++i) {
    const Node* map = section->find(kBuiltNumbers[i].key);
    if (map == nullptr || map->kind != Node::Kind::map) continue;
    const bool of_modules = kBuiltNumbers[i].of == BuiltNumber::Of::modules;
    const std::vector<std::string> all = of_modules ? module_names(*scenario_.robot) : joint_names(*scenario_.robot);
    const std::vector<std::string> parts = parts_with(kBuiltNumbers[i], *scenario_.robot);
    for (const auto& [name, place] : map->keys) {
      // The reader has already reported names that no part has.
      if (std::ranges::find(all, name) == all.end() || std::ranges::find(parts, name) != parts.end()) continue;
      const bool of_gears = kBuiltNumbers[i].of == BuiltNumber::Of::gears;
      problems_.add(place, fmt::format("{} has no {}: {}", name, kBuiltNumbers[i].key,
                                       of_modules ? "it is docked to no parent"
                                       : of_gears ? "play is a key of hinges in module files"
                                                  : "its hinge has no motor"));
    }
  }
}

void ScenarioChecks::built_numbers(const Actuator* actuator) {
  parts_as_built();
  const AsBuilt drawn;
  for (std::size_t i = 0; i < kBuiltNumbers.size(); ++i) {
    const BuiltNumber& number = kBuiltNumbers[i];
    if (scenario_.as_built.numbers[i] == drawn.numbers[i]) continue;
    const bool stated = given(root_, kAsBuiltSection, number.key).has_value();
    const char* section = stated ? kAsBuiltSection : kTolerancesSection;
    const char* key = stated ? number.key : kTolerances[number.tolerance].key;
    std::string wrong;
    const bool of_motors = number.of == BuiltNumber::Of::motors || number.of == BuiltNumber::Of::robot;
    if (number.of == BuiltNumber::Of::gears) {
      wrong = too_much_play(scenario_, fmt::format("{}.{}", section, key));
    } else if (of_motors) {
      wrong = not_buildable(scenario_, actuator, fmt::format("{}.{}", section, key));
    } else if (number.key == std::string_view("foot_friction") && !scenario_.contact.model().penalty_settings) {
      wrong = fmt::format("{}.{} does not apply to contact law '{}', which has one coefficient; expected contact.law: penalty",
                          section, key, scenario_.contact.model().text);
    }
    if (wrong.empty()) continue;
    problems_.add(place_of(root_, section, key), wrong);
    if (of_motors) return;  // the other numbers of motors have the same problem
  }
}

void ScenarioChecks::base_velocity() {
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

void ScenarioChecks::limits() {
  const Limits& limits = scenario_.limits;
  if (limits.touch <= limits.collision) return;
  const std::optional<SourceLocation> touch = given(root_, "limits", "touch");
  const std::optional<SourceLocation> collision = given(root_, "limits", "collision");
  const auto size = [](double value, bool is_given) { return number_text(value) + (is_given ? " m" : " m by default"); };
  Problem& problem = problems_.add(
      touch ? *touch : place_of(root_, "limits", "collision"),
      fmt::format(
          "limits.touch, above which bodies that touch are a warning, is {}, and limits.collision, above which they are "
          "a failure, is {}; expected limits.touch of at most {} m, or limits.collision of at least {} m",
          size(limits.touch, touch.has_value()), size(limits.collision, collision.has_value()), number_text(limits.collision),
          number_text(limits.touch)));
  if (touch && collision) problem.notes.emplace_back(*collision, "limits.collision is here");
}

void ScenarioChecks::automatic_step() {
  const Node* physics = root_.find("physics");
  const Node* step = physics == nullptr ? nullptr : physics->find("step");
  const Node* accuracy = physics == nullptr ? nullptr : physics->find("accuracy");
  const Integrator* const adaptive = scenario_.physics.engine->adaptive();
  const bool able = adaptive != nullptr && !scenario_.contact.model().has_step_of_its_own;
  const std::string chosen =
      fmt::format("integrator '{}' of engine '{}'", scenario_.physics.integrator->name, scenario_.physics.engine->name);
  if (step != nullptr && step->text == "auto" && !scenario_.physics.chosen_step) {
    problems_.add(step->place, fmt::format("{} cannot choose the step; expected a number of seconds{}", chosen,
                                           able ? ", or integrator: " + adaptive->name : ""));
  }
  if (accuracy != nullptr) {
    problems_.add(accuracy->place, fmt::format("{} uses the given step and ignores accuracy; remove accuracy{}", chosen,
                                               able ? ", or use integrator: " + adaptive->name : ""));
  }
}

void ScenarioChecks::units(const Actuator& actuator, const Controller& controller) {
  const std::string_view command = controller.command_unit();
  if (command.empty() || command == actuator.command_unit()) return;
  if (command == "duty" && actuator.dc_motors() != nullptr) return;
  const std::string_view taker = scenario_.actuator.entry->name;
  const std::string_view giver = scenario_.controller.entry->name;
  const bool chosen = given(root_, "controller").has_value();
  const std::string_view by_default = chosen ? "" : "the default ";
  Problem& problem = problems_.add(place_of(root_, chosen ? "controller" : "actuator", "type"),
                                   fmt::format("{}controller '{}' commands {}, but actuator '{}' takes {}", by_default, giver,
                                               command, taker, actuator.command_unit()));
  if (!chosen) {
    problem.notes.emplace_back(problem.place,
                               fmt::format("add for example controller: {{unit: {}, Kp: ...}}", actuator.command_unit()));
    return;
  }
  problem.notes.emplace_back(place_of(root_, "actuator", "type"),
                             fmt::format("actuator '{}' takes {}", taker, actuator.command_unit()));
}

void ScenarioChecks::supply(const Actuator* actuator) {
  if (actuator != nullptr && actuator->dc_motors() != nullptr) return;
  const std::string instead =
      actuator == nullptr ? "the robot has no motors"
                          : fmt::format("actuator '{}' takes {}", scenario_.actuator.entry->name, actuator->command_unit());
  if (scenario_.supply.any())
    problems_.add(place_of(root_, kSupplySection, "voltage"), "supply needs motors that take V, but " + instead);
  for (const Node& document : *scenario_.module_documents) {
    const Node* const battery = document.find("battery");
    if (battery != nullptr) problems_.add(battery->place, "battery needs motors that take V, but " + instead);
  }
}

SourceLocation ScenarioChecks::play_place(std::size_t joint) const {
  const Robot& robot = *scenario_.robot;
  const Joint& own = robot.joints[joint];
  const std::string hinge = own.name.substr(own.name.find('/') + 1);
  const Node& document = (*scenario_.module_documents)[robot.modules[own.module].type];
  for (const Node& node : document.find("hinges")->items) {
    const Node* const name = node.find("name");
    const Node* const play = node.find("play");
    if (name != nullptr && play != nullptr && name->text == hinge) return play->place;
  }
  return place_of(root_, "robot", "");
}

bool ScenarioChecks::play(const Actuator* actuator) {
  const std::vector<std::size_t> joints = joints_with_play(*scenario_.robot);
  if (joints.empty()) return true;
  if (const ContactModel& contact = scenario_.contact.model(); !contact.rotor_inertia) {
    problems_
        .add(place_of(root_, "contact", "law"),
             fmt::format("contact law '{}' cannot simulate play; expected contact.law: penalty, or no play", contact.text))
        .notes.emplace_back(play_place(joints.front()), "the play is here");
    return false;
  }
  const In inertia = actuator == nullptr ? In() : actuator->reflected_inertia();
  for (const std::size_t j : joints) {
    if (!inertia.empty() && inertia[j] > 0) continue;
    const std::string what = fmt::format(
        "joint '{}' has play, within which its motor turns alone, but {}; expected actuator.rotor_inertia above 0 kg m^2, or "
        "no "
        "play",
        scenario_.robot->joints[j].name, actuator == nullptr ? "it has no motor" : "the motor has no rotor_inertia");
    const std::optional<SourceLocation> stated = given(root_, "actuator", "rotor_inertia");
    Problem& problem = problems_.add(stated ? *stated : play_place(j), what);
    if (stated) problem.notes.emplace_back(play_place(j), "the play is here");
    return false;
  }
  return true;
}

void ScenarioChecks::rotors(const Actuator& actuator) {
  const In inertia = actuator.reflected_inertia();
  const Engine* engine = scenario_.physics.engine;
  const bool some = std::any_of(inertia.begin(), inertia.end(), [](double value) { return value > 0; });
  if (const ContactModel& contact = scenario_.contact.model(); some && !contact.rotor_inertia) {
    problems_.add(
        place_of(root_, "actuator", "rotor_inertia"),
        fmt::format(
            "contact law '{}' cannot add rotor inertia; expected actuator.rotor_inertia: 0 (a servo has one by default), or "
            "contact.law: penalty",
            contact.text));
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

}  // namespace gaitlab
