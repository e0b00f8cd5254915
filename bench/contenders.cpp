#include "bench/contenders.h"

#include <fmt/format.h>

#include <algorithm>

namespace gaitlab::versus {

namespace {

/// Settings of an engine and an integrator. The estimate is off, because its additional rollouts are measured as a separate
/// contender.
std::vector<std::string> sets(const std::string& engine, const std::string& integrator) {
  return {"physics.engine=" + engine, "physics.integrator=" + integrator, "physics.estimate=off"};
}

bool has(const Engine* engine, const std::string& integrator) {
  return engine != nullptr && engine->integrator(integrator) != nullptr;
}

// All steps divide the trace period of 5 ms and the control period of 15 ms.
const std::vector<double> kShort{2.5e-5, 5e-5};
const std::vector<double> kUser{2.5e-5, 5e-5, 1e-4, 1e-3};
const std::vector<double> kImplicit{1e-4, 1e-3};  // the method costs 2.5 times as much without a smaller error
const std::vector<double> kLong{2.5e-4, 5e-4, 6.25e-4, 1e-3, 1.25e-3, 5e-3 / 3, 2.5e-3, 5e-3};
const std::vector<double> kLonger{5e-4, 1e-3, 1.25e-3, 5e-3 / 3, 2.5e-3, 5e-3};

// Accuracies for steps of 5 ms, which the integrator divides.
const std::vector<double> kAccuracies{0.05, 0.02, 0.01, 0.003, 0.001};

void add_bullet(ContenderField& field) {
  const auto penalty = sets("bullet", "semi_implicit");
  field.references.push_back({"bullet", penalty, {2.5e-5, 1.25e-5}});
  field.contenders.push_back({"bullet", ContenderGroup::bullet, "bullet", penalty, kShort});
  const std::vector<std::string> solver{"physics.engine=bullet", "contact.law=bullet", "physics.estimate=off"};
  field.references.push_back({"bullet solver", solver, {1e-4, 5e-5}});
  field.contenders.push_back({"bullet solver", ContenderGroup::bullet_solver, "bullet solver", solver, {2.5e-4, 5e-4, 1e-3}});
}

void add_mujoco(ContenderField& field, const Engine* engine) {
  // The settings that a user would choose have one common reference, because they differ only in the integration method.
  field.references.push_back({"mujoco user", sets("mujoco", "euler"), {1e-5, 5e-6}});
  for (const char* integrator : {"euler", "implicit", "implicitfast"}) {
    if (!has(engine, integrator)) continue;
    field.contenders.push_back({fmt::format("mujoco {}", integrator), ContenderGroup::mujoco_user, "mujoco user",
                                sets("mujoco", integrator), std::string(integrator) == "implicit" ? kImplicit : kUser});
  }
  // Set-up dcmotor limits the current instead of the torque at rest, and therefore converges to another limit.
  if (has(engine, "dcmotor")) {
    const auto motors = sets("mujoco", "dcmotor");
    field.references.push_back({"mujoco dcmotor", motors, {1e-5, 5e-6}});
    field.contenders.push_back({"mujoco dcmotor", ContenderGroup::mujoco_user, "mujoco dcmotor", motors, kUser});
  }
  const auto best = sets("mujoco", "armature");
  field.references.push_back({"mujoco armature", best, {5e-5, 2.5e-5}});
  field.contenders.push_back({"mujoco armature", ContenderGroup::mujoco_best, "mujoco armature", best, kLong});
}

void add_articulated(ContenderField& field, const Engine& engine, std::vector<std::string>& left_out) {
  field.references.push_back({"articulated", sets("articulated", "extrapolated"), {1e-4, 5e-5}});
  for (const std::size_t lanes : {1U, 4U, 8U}) {
    if (lanes > engine.lanes.back()) {
      left_out.push_back(fmt::format("articulated in {} lanes: the engine has {} here", lanes, engine.lanes.back()));
      continue;
    }
    for (const char* integrator : {"implicit", "extrapolated"}) {
      const std::string name =
          lanes == 1 ? fmt::format("articulated {}", integrator) : fmt::format("articulated {} x{}", integrator, lanes);
      field.contenders.push_back({name, ContenderGroup::ours, "articulated", sets("articulated", integrator),
                                  std::string(integrator) == "implicit" ? kLong : kLonger, lanes});
    }
    for (const double accuracy : kAccuracies) {
      auto adaptive = sets("articulated", "adaptive");
      adaptive.push_back(fmt::format("physics.accuracy={}", accuracy));
      const std::string name = fmt::format("articulated adaptive {}", accuracy);
      field.contenders.push_back({lanes == 1 ? name : fmt::format("{} x{}", name, lanes),
                                  ContenderGroup::ours,
                                  "articulated",
                                  std::move(adaptive),
                                  {kLonger.back()},
                                  lanes});
    }
  }
  auto estimated = sets("articulated", "adaptive");
  estimated.back() = "physics.estimate=full";
  field.contenders.push_back(
      {"articulated adaptive, estimated", ContenderGroup::ours, "articulated", std::move(estimated), {kLonger.back()}});
}

}  // namespace

ContenderField field(const Catalog& catalog, std::vector<std::string>& left_out) {
  ContenderField all;
  if (catalog.engine("bullet") != nullptr) add_bullet(all);
  if (catalog.engine("mujoco") != nullptr) add_mujoco(all, catalog.engine("mujoco"));
  if (const Engine* ours = catalog.engine("articulated")) add_articulated(all, *ours, left_out);
  return all;
}

}  // namespace gaitlab::versus
