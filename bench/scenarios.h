// Scenarios of the benchmarks: shipped ones, and chains of any length.
#pragma once
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "app/app.h"
#include "core/scenario/read_scenario.h"

namespace gaitlab::bench {

/// Catalog of all engines and plugins. Static, because it must outlive the scenarios made from it.
inline Catalog& catalog() {
  static Catalog all = app::standard_catalog();
  return all;
}

/// A shipped scenario with engine articulated.
inline Scenario shipped(const std::string& name, std::vector<std::string> sets = {}) {
  sets.emplace_back("physics.engine=articulated");
  return read_scenario(std::string(GAITLAB_SOURCE_DIR) + "/scenarios/" + name, sets, catalog());
}

/// Scenario of a caterpillar with this number of modules.
inline Scenario chain(std::size_t modules, std::vector<std::string> sets = {}) {
  std::vector<Dock> docks;
  for (int k = 1; k < static_cast<int>(modules); ++k) docks.push_back({1, k, 4, k - 1, 0});
  Scenario s = shipped("caterpillar.yaml", std::move(sets));
  s.robot = std::make_shared<Robot>(assemble(s.robot->types, std::vector<std::size_t>(modules, 0), docks));
  return s;
}

}  // namespace gaitlab::bench
