#include <fstream>
#include <nlohmann/json.hpp>
#include <thread>

#include "bench/mujoco_plant.h"
#include "bench/results.h"
#include "core/build_id.h"
#include "physics_bullet/engine.h"

namespace gaitlab::versus {

std::string processor() {
  std::ifstream file("/proc/cpuinfo");
  for (std::string line; std::getline(file, line);) {
    const std::size_t colon = line.find(": ");
    if (line.starts_with("model name") && colon != std::string::npos) return line.substr(colon + 2);
  }
  return "unknown";
}

namespace {

using Json = nlohmann::ordered_json;

const char* word(ContenderGroup group) {
  switch (group) {
    case ContenderGroup::bullet:
      return "bullet";
    case ContenderGroup::bullet_solver:
      return "bullet solver";
    case ContenderGroup::mujoco_user:
      return "mujoco as a user sets it up";
    case ContenderGroup::mujoco_best:
      return "mujoco at its best";
    case ContenderGroup::ours:
      break;
  }
  return "ours";
}

Json errors(const RaceTorqueError& error) { return {{"worst", error.worst}, {"median", error.median}}; }

void add_course(Json& out, const Course& course) {
  out["travel"] = course.travel;
  out["contact_force"] = course.force;
}

Json to_json(const RacePoint& p) {
  Json out{
      {"scenario", p.scenario}, {"contender", p.contender}, {"group", word(p.group)}, {"step", p.step}, {"lanes", p.lanes}};
  if (!p.ran()) {
    out["note"] = p.note;
    return out;
  }
  out["error"] = errors(p.error);
  out["worst_joint"] = p.worst_joint;
  if (p.other) out["error_to_bullet"] = errors(*p.other);
  add_course(out, p.course);
  out["simulated"] = p.seconds;
  out["speed"] = {{"median", p.speed()}, {"min", p.slowest()}, {"max", p.fastest()}, {"cpu", p.cpu_speed()}};
  out["wall"] = p.wall;
  out["cpu"] = p.cpu;
  return out;
}

}  // namespace

std::string json(const RaceResults& results, const RaceSettings& settings) {
  Json out;
  out["machine"] = {{"processor", processor()}, {"cores", std::thread::hardware_concurrency()}};
  out["versions"] = {{"gaitlab", build_id()}, {"bullet", bullet_version()}, {"mujoco", mujoco_version()}};
  out["settings"] = {{"seconds", settings.seconds},
                     {"errors_from", settings.seconds / 2},
                     {"rounds", settings.rounds},
                     {"least", settings.least},
                     {"sets", settings.sets}};
  for (const Converged& c : results.references) {
    Json reference{{"scenario", c.scenario}, {"name", c.name}, {"step", c.step}, {"left", errors(c.left)}};
    add_course(reference, c.course);
    out["references"].push_back(std::move(reference));
  }
  for (const RacePoint& p : results.points) out["points"].push_back(to_json(p));
  out["left_out"] = results.left_out;
  return out.dump(1) + "\n";
}

}  // namespace gaitlab::versus
