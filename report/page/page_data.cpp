#include "report/page/page_data.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <nlohmann/json.hpp>

#include "core/scenario/resolved.h"
#include "core/scenario/sensor_section.h"
#include "core/settings/settings_numbers.h"
#include "report/analysis/changes.h"
#include "report/analysis/envelope.h"
#include "report/analysis/harmonic.h"
#include "report/analysis/legs.h"
#include "report/analysis/loads.h"
#include "report/analysis/plugin_names.h"
#include "report/page/page_ground.h"
#include "report/page/robot_tree.h"
#include "report/page/signals.h"
#include "report/verdict/numbers/number_texts.h"
#include "report/verdict/numbers/numbers.h"

namespace gaitlab::report {

namespace {

using Json = nlohmann::ordered_json;

Json known(const std::optional<double>& value) { return value && std::isfinite(*value) ? Json(*value) : Json(); }

std::string plugin_name(const PluginSelection& plugin) {
  return plugin.entry == nullptr ? "none" : std::string(plugin.entry->name);
}

/// Frequency of the gait in JSON if all joints have the same one, else null.
Json frequency(const PluginSelection& cpg) {
  const SettingsNumbers settings(cpg);
  const SettingsNumbers::Found* found = settings.find("frequency");
  if (found == nullptr) return {};
  const auto same = [&](double each) { return each == found->value[0]; };
  return std::ranges::all_of(found->value.each, same) ? Json(found->value[0]) : Json();
}

/// Removes folders from every text in a JSON value.
void leave_folders_out(Json& json, const Scenario& scenario) {
  if (json.is_string()) json = without_folders(json.get<std::string>(), scenario);
  if (!json.is_structured()) return;
  for (Json& within : json) leave_folders_out(within, scenario);
}

Json joints_json(const Scenario& scenario, const RobotTree& tree, const Motors& motors) {
  Json all = Json::array();
  const std::vector<Joint>& joints = scenario.robot->joints;
  for (std::size_t j = 0; j < joints.size(); ++j) {
    all.push_back({{"name", joints[j].name},
                   {"module", joints[j].module},
                   {"body", tree.place(tree.moved_by(j))},
                   {"lo", known(joints[j].lo)},
                   {"hi", known(joints[j].hi)},
                   {"motor", motors.of_joint.empty() || !joints[j].driven() ? Json() : Json(motors.of_joint[j])}});
  }
  return all;
}

Json motors_json(const Motors& motors) {
  Json all = Json::array();
  for (const Envelope& motor : motors.kinds) {
    all.push_back({{"unit", motor.unit},
                   {"command", known(motor.command)},
                   {"current", known(motor.current)},
                   {"continuous", known(motor.continuous)},
                   {"rest", known(motor.rest)},
                   {"no_load", known(motor.no_load)},
                   {"speed", motor.speed},
                   {"most", motor.most},
                   {"least", motor.least}});
  }
  return all;
}

/// Contact elements of each body, as [x, y, z, radius] in body axes; the radius of a point is 0.
std::vector<Json> points_json(const Scenario& scenario) {
  std::vector<Json> all;
  for (const std::vector<ContactElement>& of_body : contact_elements_by_body(*scenario.robot, scenario.contact.on)) {
    Json points = Json::array();
    for (const ContactElement& element : of_body) {
      const Vec3 at = scenario.robot->bodies[element.body].in_link.inverse() * element.centre;
      points.push_back({at.x(), at.y(), at.z(), element.radius});
    }
    all.push_back(std::move(points));
  }
  return all;
}

Json feet_json(const Scenario& scenario, const std::vector<Foot>& feet, const RobotTree& tree) {
  std::vector<std::size_t> bodies;
  bodies.reserve(feet.size());
  for (const Foot& foot : feet) bodies.push_back(foot.body);
  const std::vector<std::string> titles = foot_names(scenario, bodies);
  std::vector<Json> points = points_json(scenario);
  Json all = Json::array();
  for (std::size_t i = 0; i < feet.size(); ++i) {
    all.push_back({{"name", feet[i].name},
                   {"title", titles[i]},
                   {"module", feet[i].module},
                   {"body", tree.place(feet[i].body)},
                   {"points", std::move(points[feet[i].body])}});
  }
  return all;
}

Json phases_json(const Recording& r, const MotionCycle& cycle, std::size_t joints) {
  const auto of = [&](const char* quantity) {
    std::vector<Series> all;
    for (std::size_t j = 0; j < joints; ++j) all.push_back(r.joint(j, quantity));
    return first_harmonics(cycle, r.series("t"), all);
  };
  const std::vector<Harmonic> setpoints = of("setpoint");
  const std::vector<Harmonic> angles = of("angle");
  Json all = Json::array();
  for (std::size_t j = 0; j < angles.size(); ++j) {
    all.push_back(
        {{"setpoint", {setpoints[j].amplitude, setpoints[j].phase}}, {"angle", {angles[j].amplitude, angles[j].phase}}});
  }
  return all;
}

/// Summary numbers without those measured by the clock.
Json summary_json(const RunData& run) {
  Json all = numbers_json(run);
  for (const SummaryNumber& number : summary_numbers()) {
    if (number.clock) all.erase(number.key);
  }
  return all;
}

/// The joint that is longest at a limit of its motor in the judged window; null if none reaches a limit.
Json longest_json(const Robot& robot, const Judged& judged) {
  for (const std::size_t j : judged.order) {
    const JudgedJoint& joint = judged.joints[j];
    if (!robot.joints[j].driven() || !(joint.limited() > 0)) continue;
    return {{"joint", robot.joints[j].name}, {"voltage", joint.voltage_limited}, {"current", joint.current_limited}};
  }
  return {};
}

Json verdict_json(const Verdict& verdict, const Robot& robot, const Judged& judged) {
  Json all = Json::parse(to_json(verdict));
  all.emplace("checks", Json::array());
  for (Json& check : all["checks"]) {
    for (const CheckKind& kind : check_kinds()) {
      if (check["id"] == kind.id) check["advice"] = verdict.remedy.empty() ? kind.remedy : "";  // a search is more precise
    }
  }
  all["why"] = verdict.why();
  all["longest"] = longest_json(robot, judged);
  if (!verdict.remedy.empty()) all["remedy"] = Json::parse(verdict.remedy);
  return all;
}

/// Sensors at a point of a body, such as an IMU.
Json sensors_json(const Scenario& scenario) {
  Json all = Json::array();
  const auto sensors = make_sensors(scenario);
  for (std::size_t k = 0; k < sensors.size(); ++k) {
    for (const BodyPoint& at : sensors[k]->points())
      all.push_back({{"name", scenario.sensors[k].name}, {"body", at.body}, {"position", at.position}});
  }
  return all;
}

double fastest_joint(const Recording& r) {
  double fastest = 0;
  for (const JointStatistics& joint : r.joints) fastest = std::max(fastest, joint.speed_peak);
  return fastest;
}

}  // namespace

nlohmann::ordered_json channels_json(const Packing& packing) {
  Json all = Json::array();
  for (const PageChannel& channel : packing.channels())
    all.push_back({channel.name, channel.unit, channel.quantum, channel.count});
  return all;
}

std::string json_text(const nlohmann::ordered_json& json) {
  std::string text = json.dump(-1, ' ', false, Json::error_handler_t::replace);
  for (std::size_t at = 0; (at = text.find('<', at)) != std::string::npos;) text.replace(at, 1, "\\u003c");
  return text;
}

namespace {

/// Signals of every `stride`-th row.
struct PackedRows {
  std::size_t stride = 1;
  Packing packing;
  std::string data;
};

/// Packs as many rows as fit into `most` bytes.
PackedRows packed_rows(const std::vector<Signal>& signals, std::size_t rows, std::size_t most) {
  PackedRows all{.stride = 1, .packing = packed(signals, rows, 1), .data = ""};
  all.data = all.packing.text();
  while (all.data.size() > most && thinned(rows, all.stride) > 2) {
    all.stride *= 2;
    all.packing = packed(signals, rows, all.stride);
    all.data = all.packing.text();
  }
  return all;
}

/// Adds the notes on what the page lacks to `missing`.
void add_missing(std::vector<std::string>& missing, const Scenario& scenario, const Recording& r,
                 const std::vector<Signal>& signals, std::size_t stride) {
  if (r.rows() > 1) std::ranges::move(left_out(scenario, signals), std::back_inserter(missing));
  if (stride > 1) {
    missing.push_back(fmt::format(
        "only one row in {} is shown, to keep the page small; verdict and numbers are those of the whole recording", stride));
  }
  if (const std::size_t heights = height_stride(scenario.ground); heights > 1) {
    missing.push_back(fmt::format("only one height in {} along x and y is drawn; the robot walked on all heights", heights));
  }
}

/// Adds program, engine, steps and extent of the run.
void add_run(Json& meta, const Scenario& scenario, const Recording& r, const Summary& summary, std::size_t stride) {
  meta["format"] = 1;
  meta["name"] = scenario.name;
  meta["build"] = summary.build;
  meta["engine"] = scenario.physics.engine->name;
  meta["integrator"] = scenario.physics.integrator->name;
  meta["step"] = scenario.physics.adaptive_step ? Json() : Json(scenario.physics.step);
  meta["accuracy"] = scenario.physics.adapts() ? Json(scenario.physics.accuracy) : Json();
  meta["period"] = scenario.trace.period * static_cast<double>(stride);
  meta["rows"] = thinned(r.rows(), stride);
  meta["duration"] = summary.simulated;
  meta["outcome"] = summary.outcome.text();
}

/// Adds modules, joints, bodies and contact elements.
void add_robot(Json& meta, const Scenario& scenario, const RobotTree& tree, const Motors& motors) {
  const Robot& robot = *scenario.robot;
  meta["mass"] = robot.mass;
  meta["weight"] = robot.mass * scenario.physics.gravity.norm();
  meta["modules"] = Json::array();
  for (std::size_t m = 0; m < robot.modules.size(); ++m)
    meta["modules"].push_back({{"name", fmt::format("m{}", m)}, {"type", robot.types[robot.modules[m].type].name}});
  meta["joints"] = joints_json(scenario, tree, motors);
  meta["bodies"] = tree.bodies();
  meta["geometry"] = tree.geometry();
  meta["faces"] = tree.faces();
  meta["docks"] = tree.docks();
  meta["contacts"] = Json::array();
  for (const ContactElement& element : contact_elements(robot, scenario.contact.on)) meta["contacts"].push_back(element.name);
}

}  // namespace

PageData page_data(const Scenario& scenario, const Recording& r, const Summary& summary, const Verdict& verdict,
                   std::vector<std::string> missing, std::size_t most) {
  const Robot& robot = *scenario.robot;
  const RobotTree tree(robot);
  const Motors motors = report::motors(scenario, fastest_joint(r));
  const Trace loads = loads_at_rows(r);
  const std::vector<Foot> feet = report::feet(scenario, r, loads);
  const std::vector<Signal> signals = report::signals(r, loads, feet, motors.kinds.empty() ? "" : motors.kinds[0].unit);
  PackedRows rows = packed_rows(signals, r.rows(), most);
  add_missing(missing, scenario, r, signals, rows.stride);
  Json meta;
  add_run(meta, scenario, r, summary, rows.stride);
  add_robot(meta, scenario, tree, motors);
  meta["ground"] = page_ground(scenario, r);
  meta["feet"] = feet_json(scenario, feet, tree);
  meta["motors"] = motors_json(motors);
  meta["verdict"] = verdict_json(verdict, robot, summary.judged);
  meta["summary"] = summary_json({scenario, r, summary});
  if (texts::lossless({scenario, r, summary})) meta["summary"].erase("cost_of_transport");
  const MotionCycle& cycle = summary.limit_cycle;
  meta["cycle"] = cycle.found ? Json{{"from", cycle.from}, {"period", cycle.period}} : Json();
  meta["phases"] = phases_json(r, cycle, robot.joints.size());
  meta["cpg"] = plugin_name(scenario.cpg);
  meta["frequency"] = frequency(scenario.cpg);
  meta["command"] = "gaitlab rerun FOLDER";
  meta["missing"] = missing;
  meta["scenario"] = resolved(scenario);
  meta["channels"] = channels_json(rows.packing);
  for (const ToldChange& change : told_changes(scenario, r.simulated)) {
    meta["changes"].push_back({{"t", change.t}, {"text", change.text}});
  }
  if (Json sensors = sensors_json(scenario); !sensors.empty()) meta["sensors"] = std::move(sensors);
  leave_folders_out(meta, scenario);

  return {scenario.name, json_text(meta), std::move(rows.data)};
}

}  // namespace gaitlab::report
