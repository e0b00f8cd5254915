#include "report/figures/run/run_footfalls.h"

#include <fmt/format.h>

#include <algorithm>

namespace gaitlab::report {

std::string lacking_load(const Scenario& scenario, const Recording& r, const std::vector<Leg>& legs) {
  const std::vector<ContactElement> elements = contact_elements(*scenario.robot, scenario.contact.on);
  for (const Leg& leg : legs) {
    for (const std::int64_t m : leg.modules) {
      const auto of_module = [&](const ContactElement& element) {
        return scenario.robot->bodies[element.body].module == static_cast<std::size_t>(m);
      };
      std::string column = fmt::format("load.{}", m);
      if (std::ranges::any_of(elements, of_module) && r.series(column).empty()) return column;
    }
  }
  return "";
}

std::vector<Footfall> footfalls(const Scenario& scenario, const Recording& r, const std::vector<Leg>& legs,
                                std::span<const double> time, double from) {
  const double weight = scenario.robot->mass * scenario.physics.gravity.norm();
  const std::vector<std::string> names = leg_names(legs);
  std::vector<Footfall> rows;
  for (std::size_t i = 0; i < legs.size(); ++i) {
    if (!lacking_load(scenario, r, {legs[i]}).empty()) continue;  // a leg without data must not appear unloaded
    std::vector<double> load(time.size(), 0.0);
    for (const std::int64_t m : legs[i].modules) {
      const Series of_module = r.series(fmt::format("load.{}", m));
      for (std::size_t k = 0; k < of_module.size(); ++k) load[k] += of_module[k];
    }
    Footfall row{names[i], stances(time, load, kStands * weight)};
    row.duty_factor = duty_factor(row.stances, from, time.back());
    rows.push_back(std::move(row));
  }
  return rows;
}

}  // namespace gaitlab::report
