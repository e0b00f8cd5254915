#include "report/figures/run/run_footfalls.h"

#include <fmt/format.h>

#include <algorithm>

#include "report/analysis/loads.h"

namespace gaitlab::report {

namespace {

/// Columns whose sum is the load of a leg, and the table that contains them.
struct LegColumns {
  std::vector<std::string> names;
  bool of_bodies = false;
};

LegColumns columns_of(const Robot& robot, const RobotInfo& info, const Leg& leg, const std::vector<ContactElement>& elements) {
  const auto has_elements = [&](const auto& part_of, std::size_t part) {
    return std::ranges::any_of(elements, [&](const ContactElement& element) { return part_of(element) == part; });
  };
  LegColumns found;
  for (const std::size_t m : own_modules(info, leg)) {
    if (has_elements([&](const ContactElement& element) { return robot.bodies[element.body].module; }, m))
      found.names.push_back(fmt::format("load.{}", m));
  }
  if (!found.names.empty()) return found;
  found.of_bodies = true;
  for (const std::int64_t body : leg.bodies) {
    const auto b = static_cast<std::size_t>(body);
    if (has_elements([](const ContactElement& element) { return element.body; }, b))
      found.names.push_back(fmt::format("foot.{}.fz", robot.bodies[b].name));
  }
  return found;
}

}  // namespace

LegLoads loads_of(const Scenario& scenario, const Recording& r, const std::vector<Leg>& legs) {
  const std::vector<ContactElement> elements = contact_elements(*scenario.robot, scenario.contact.on);
  const RobotInfo robot = info(*scenario.robot);
  const Trace at_ticks = loads_at_rows(r);
  LegLoads all;
  for (const Leg& leg : legs) {
    const LegColumns columns = columns_of(*scenario.robot, robot, leg, elements);
    std::vector<double> load(r.rows(), 0.0);
    for (const std::string& name : columns.names) {
      const std::size_t at = columns.of_bodies ? at_ticks.find(name) : 0;
      const bool missing = columns.of_bodies ? at_ticks.rows() == 0 : r.series(name).empty();
      if (missing) return {{}, name};
      if (columns.of_bodies && at == at_ticks.columns.size()) continue;  // a body that never touched the ground has no columns
      const std::vector<double> part = columns.of_bodies ? Series(at_ticks, at).values() : r.series(name).values();
      for (std::size_t k = 0; k < load.size(); ++k) load[k] += part[k];
    }
    all.loads.push_back(std::move(load));
  }
  return all;
}

std::vector<Footfall> footfalls(const Scenario& scenario, const Recording& r, const std::vector<Leg>& legs,
                                std::span<const double> time, double from) {
  const double weight = scenario.robot->mass * scenario.physics.gravity.norm();
  const LegLoads found = loads_of(scenario, r, legs);
  std::vector<Footfall> rows;
  for (std::size_t i = 0; i < found.loads.size(); ++i) {
    Footfall row{leg_name(legs[i]), stances(time, found.loads[i], kStands * weight)};
    row.duty_factor = duty_factor(row.stances, from, time.back());
    rows.push_back(std::move(row));
  }
  return rows;
}

}  // namespace gaitlab::report
