#include "core/scenario/change_section.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "core/plugin/plugin_instance.h"
#include "core/scenario/sections.h"
#include "core/scenario/sensor_checks.h"
#include "core/scenario/sensor_section.h"
#include "core/settings/explainer.h"
#include "core/settings/joint_patterns.h"
#include "core/settings/overlay.h"
#include "core/settings/wording.h"
#include "core/settings/writer.h"

namespace gaitlab {
namespace {

constexpr const char* kSection = "at";
constexpr std::array kSections{"cpg", "controller"};
constexpr double kLongestDelay = 100;  // s

/// Time of the first control tick at t or later.
double tick_time(double t, const Scenario& scenario) {
  return static_cast<double>(first_tick(t, scenario.control_period)) * scenario.control_period;
}

/// True if a fault changes anything.
bool acts(const JointFault& fault) {
  using enum FaultKind;
  return fault.kind != none && !(fault.kind == weak && fault.share == 1) && !(fault.kind == lost && fault.share == 0) &&
         !(fault.kind == late && fault.delay == 0);
}

/// Keys of a plugin's settings in full.
Node settings_node(const PluginSelection& plugin, const std::vector<std::string>& joints) {
  Writer writer(joints);
  if (plugin.entry != nullptr) visit_settings(*plugin.entry, plugin.settings.get(), writer);
  return writer.take();
}

/// Adds the keys of a section that `set` names, or that differ from the segment before, to `all`.
void add_set(const std::string& section, const PluginSelection& before, const PluginSelection& now, const Node& set,
             const std::vector<std::string>& joints, Writer& all) {
  const Node old = settings_node(before, joints);
  Node keys = settings_node(now, joints);
  for (std::size_t i = 0; i < keys.keys.size(); ++i) {
    const std::string key = section + "." + keys.keys[i].first;
    const auto names = [&](const auto& one) { return one.first == key || one.first.starts_with(key + "."); };
    const Node* const then = old.find(keys.keys[i].first);
    if (std::ranges::none_of(set.keys, names) && then != nullptr && print_yaml(*then) == print_yaml(keys.items[i])) continue;
    all.add(key, std::move(keys.items[i]));
  }
}

/// The scenario without the section `at`. Each entry copies the scenario, which would take quadratic time if it contained all
/// entries.
Node without_changes(Node root) {
  for (std::size_t i = root.keys.size(); i-- > 0;) {
    if (root.keys[i].first != kSection) continue;
    root.keys.erase(root.keys.begin() + static_cast<std::ptrdiff_t>(i));
    root.items.erase(root.items.begin() + static_cast<std::ptrdiff_t>(i));
  }
  return root;
}

/// Reads the entries of the section one after another.
class ChangeReader {
 public:
  ChangeReader(const Node& root, const Scenario& scenario, JointNames joints, const ReadSegment& read, Problems& problems)
      : root_(without_changes(root)), scenario_(scenario), joints_(joints), read_(read), problems_(problems) {
    last_.cpg = scenario.cpg;
    last_.controller = scenario.controller;
    last_.t = -1;
  }

  void read(const Node& node, const std::string& name) {
    Reader reader(node, name, problems_, joints_);
    reader.groups(scenario_.groups);
    if (node.kind != Node::Kind::map) return;
    const std::size_t before = problems_.size();
    Change change{0, {Node::Kind::map}, last_.cpg, last_.controller, {}};
    ChangeKeys{change}.fields(reader);
    reader.require({"t"});
    const Node* const set = reader.take("set");
    const Node* const fault = reader.take("fault");
    reader.finish();
    if (const Node* const t = node.find("t"); t != nullptr) check_time(*t, change.t);
    if (set == nullptr && fault == nullptr && problems_.size() == before)
      problems_.add(node.place, name + " changes nothing; expected set, fault or both");
    if (set != nullptr) read_set(*set, name, change);
    if (fault != nullptr) read_faults(*fault, name, change);
    last_ = change;
    made_.push_back(std::move(change));
  }

  std::vector<Change> take() { return std::move(made_); }

 private:
  void check_time(const Node& node, double t) {
    if (last_.t >= t) {
      problems_.add(node.place, fmt::format("t is {} s, not later than the change before it, at {} s; expected rising times",
                                            number_text(t), number_text(last_.t)));
    } else if (t >= scenario_.duration) {
      problems_.add(node.place, fmt::format("t is {} s, but the run ends at {} s; expected an earlier time", number_text(t),
                                            number_text(scenario_.duration)));
    } else if (const double tick = tick_time(t, scenario_); tick >= scenario_.duration) {
      problems_.add(
          node.place,
          fmt::format("t is {} s, and the change takes effect at the next control tick, {:.6g} s, but the run ends at {} s",
                      number_text(t), tick, number_text(scenario_.duration)));
    }
  }

  void read_set(const Node& set, const std::string& name, Change& change) {
    if (set.kind != Node::Kind::map || set.items.empty()) {
      problems_.add(set.place, fmt::format("{}.set is {}; expected settings by key, such as {{cpg.frequency: 0.5}}", name,
                                           set.kind == Node::Kind::map ? "empty" : found(set)));
      return;
    }
    const std::size_t before = problems_.size();
    for (std::size_t i = 0; i < set.keys.size(); ++i) {
      const auto& [key, place] = set.keys[i];
      const std::string wrong = refused(key);
      if (!wrong.empty()) problems_.add(place, wrong);
      const std::string section = key.substr(0, key.find('.'));
      if (std::ranges::find(sections_, section) == sections_.end()) sections_.push_back(section);
    }
    if (problems_.size() > before) return;
    for (std::size_t i = 0; i < set.keys.size(); ++i) {
      overlay(root_, set.keys[i].first, set.items[i], set.keys[i].second, problems_);
    }
    change.set = set;
    if (problems_.size() > before) return;
    const Scenario after = read_(root_, sections_, problems_);
    if (problems_.size() > before) return;
    check_states(after, set);
    change.cpg = after.cpg;
    change.controller = after.controller;
  }

  /// The message for a key that cannot change, or "".
  [[nodiscard]] static std::string refused(const std::string& key) {
    const std::string section = key.substr(0, key.find('.'));
    const bool known = std::ranges::find(kSections, section) != kSections.end();
    if (known && key == section) {
      return fmt::format("{} is a section; expected a key of it, such as {}", key,
                         section == "cpg" ? "cpg.frequency" : "controller.Kp");
    }
    if (key == "cpg.type" || key == "cpg.step" || key == "controller.type" || key == "controller.period")
      return key + " cannot change in a run, because it sets the plugins, their states or the control ticks";
    if (known) return "";
    if (section == "actuator")
      return in_quotes(key) + " cannot change in a run; a fault of kind weak, open or dead changes a motor";
    const std::string near = key == section ? "" : nearest(section, {kSections.begin(), kSections.end()});
    return fmt::format("{} cannot change in a run; expected a key of cpg or controller{}", in_quotes(key),
                       near.empty() ? "" : "; did you mean " + in_quotes(near + key.substr(section.size())) + "?");
  }

  /// Meaning of a key that `set` changes alone, ` (latency: Time from ...)`; empty for several keys.
  static std::string meaning(const Node& set, const PluginSelection& plugin) {
    if (set.keys.size() != 1) return "";
    Explainer settings;
    visit_settings(*plugin.entry, plugin.settings.get(), settings);
    const std::string& path = set.keys.front().first;
    for (const KeyRow& row : settings.rows()) {
      if (!(path + ".").starts_with(fmt::format("{}.{}.", word(plugin.entry->kind), row.key))) continue;
      return fmt::format(" ({}: {})", row.key, row.about.substr(0, row.about.size() - 1));
    }
    return "";
  }

  /// Checks that CPG and controller have the same states as at the start, because the run continues with these states.
  void check_states(const Scenario& after, const Node& set) {
    const RobotInfo robot = plugin_info(scenario_);
    const auto check = [&](const char* what, const PluginSelection& plugin, std::size_t first, std::size_t now) {
      if (first == now) return;
      problems_.add(set.place, fmt::format("set changes the {}'s {} to {}{}; expected settings that keep the number of states",
                                           what, counted(first, "state"), now, meaning(set, plugin)));
    };
    const auto states = [](const auto& plugin) { return plugin == nullptr ? 0 : plugin->states(); };
    try {
      check("CPG", after.cpg, states(make_cpg(scenario_.cpg, robot)), states(make_cpg(after.cpg, robot)));
      check("controller", after.controller, states(make_controller(scenario_.controller, robot)),
            states(make_controller(after.controller, robot)));
    } catch (const PluginError& error) {
      problems_.add(set.place, error.what());
    }
  }

  void read_faults(const Node& node, const std::string& name, Change& change) {
    if (scenario_.actuator.entry == nullptr) {
      problems_.add(node.place, "a fault needs a motor, but the robot has none (actuator.type: none); remove the fault");
      return;
    }
    if (node.kind != Node::Kind::list) return read_fault(node, name + ".fault", change);
    if (node.items.empty()) problems_.add(node.place, name + ".fault is an empty list; expected {joint: NAME, kind: KIND}");
    for (std::size_t i = 0; i < node.items.size(); ++i) {
      read_fault(node.items[i], fmt::format("{}.fault[{}]", name, i), change);
    }
  }

  void read_fault(const Node& node, const std::string& name, Change& change) {
    Reader reader(node, name, problems_, joints_);
    reader.groups(scenario_.groups);
    if (node.kind != Node::Kind::map) return;
    const std::size_t before = problems_.size();
    JointFault fault;
    FaultKeys keys{fault};
    keys.fields(reader);
    reader.require({"joint", "kind"});
    if (fault.kind == FaultKind::weak || fault.kind == FaultKind::lost) reader.require({"share"});
    if (fault.kind == FaultKind::late) reader.require({"delay"});
    reader.finish();
    if (problems_.size() > before) return;
    if (fault.joints.empty()) problems_.add(node.find("joint")->place, "joint names no joint; expected a name or a pattern");
    check_names_and_times(
        node, [&](Fields& f) { keys.fields(f); }, scenario_, problems_);
    change.faults.push_back(std::move(fault));
  }

  Node root_;                          ///< the scenario with the settings so far, without this section
  std::vector<std::string> sections_;  ///< sections that have changed so far
  const Scenario& scenario_;
  JointNames joints_;
  const ReadSegment& read_;
  Problems& problems_;
  Change last_;
  std::vector<Change> made_;
};

}  // namespace

void FaultKeys::fields(Fields& f) {
  using enum FaultKind;
  f.names("joint", fault.joints, Among::motors, "Joints that get the fault: names or patterns.");
  f.choice("kind", fault.kind, enum_names<FaultKind>(),
           "dead: command 0, so that the motor brakes. open: no current and no torque. stuck: held at its angle. weak: its "
           "torque is multiplied by `share`. lost: a share of its set points never arrives. late: its set points are delayed "
           "by `delay`. none: the fault ends.");
  if (all || fault.kind == weak || fault.kind == lost)
    f.number("share", fault.share, {"", 0, 1, "weak: share of the torque that is left; lost: share of lost set points."});
  if (all || fault.kind == late) {
    f.periods("delay", fault.delay, {"s", 0, kLongestDelay, "late: delay, a whole number of control periods."});
  }
}

std::vector<Change> read_changes(const Node& root, const Scenario& scenario, JointNames joints, const ReadSegment& read,
                                 Problems& problems) {
  const Node* const node = root.find(kSection);
  if (node == nullptr) return {};
  if (node->kind != Node::Kind::list) {
    problems.add(
        node->place,
        fmt::format("at is {}; expected a list of changes, such as [{{t: 10, set: {{cpg.frequency: 0.5}}}}]", found(*node)));
    return {};
  }
  ChangeReader reader(root, scenario, joints, read, problems);
  for (std::size_t i = 0; i < node->items.size(); ++i) reader.read(node->items[i], fmt::format("at[{}]", i));
  return reader.take();
}

Node changes_node(const Scenario& scenario, const std::vector<std::string>& joints) {
  Node all{Node::Kind::list};
  const PluginSelection* cpg = &scenario.cpg;
  const PluginSelection* controller = &scenario.controller;
  for (const Change& entry : scenario.changes) {
    Change change = entry;
    Writer one(joints);
    ChangeKeys{change}.fields(one);
    Writer set(joints);
    add_set("cpg", *cpg, entry.cpg, entry.set, joints, set);
    add_set("controller", *controller, entry.controller, entry.set, joints, set);
    if (Node keys = set.take(); !keys.items.empty()) one.add("set", std::move(keys));
    cpg = &entry.cpg;
    controller = &entry.controller;
    Node faults{Node::Kind::list};
    for (JointFault& fault : change.faults) {
      Writer keys(joints);
      FaultKeys{fault}.fields(keys);
      faults.items.push_back(keys.take());
    }
    if (faults.items.size() == 1) faults = Node(faults.items[0]);
    if (!change.faults.empty()) one.add("fault", std::move(faults));
    all.items.push_back(one.take());
  }
  return all;
}

std::vector<std::size_t> joints_of(const JointFault& fault, const Robot& robot) {
  const std::vector<std::string> names = joint_names(robot);
  std::vector<std::size_t> all;
  for (const std::string& text : fault.joints) {
    for (const std::size_t j : joints_of(text, names)) {
      if (robot.joints[j].driven()) all.push_back(j);
    }
  }
  std::ranges::sort(all);
  all.erase(std::unique(all.begin(), all.end()), all.end());  // clang 14 does not support std::ranges::unique
  return all;
}

std::vector<FaultSpan> fault_spans(const Scenario& scenario) {
  std::vector<FaultSpan> all;
  for (const Change& change : scenario.changes) {
    const double from = tick_time(change.t, scenario);
    for (const JointFault& fault : change.faults) {
      for (const std::size_t joint : joints_of(fault, *scenario.robot)) {
        for (FaultSpan& one : all) {
          if (one.joint == joint && !std::isfinite(one.to)) one.to = from;
        }
        if (acts(fault)) all.push_back({joint, fault.kind, from, std::numeric_limits<double>::infinity()});
      }
    }
  }
  std::erase_if(all, [](const FaultSpan& one) { return one.to <= one.from; });  // replaced within its change
  return all;
}

std::int64_t first_tick(double t, double control_period) {
  constexpr double kSameTick = 1e-7;  // ticks; more than the rounding error of times
  return static_cast<std::int64_t>(std::ceil(t / control_period - kSameTick));
}

double last_change(const Scenario& scenario, double end) {
  double last = 0;
  for (const Change& change : scenario.changes) {
    const double t = tick_time(change.t, scenario);
    last = t < end ? t : last;
  }
  return last;
}

bool has_faults(const Scenario& scenario) {
  return std::ranges::any_of(scenario.changes, [](const Change& change) { return !change.faults.empty(); });
}

}  // namespace gaitlab
