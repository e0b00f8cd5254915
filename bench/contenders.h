// Contenders of a benchmark: engines, their set-ups and steps.
#pragma once
#include <string>
#include <vector>

#include "core/plugin/catalog.h"

namespace gaitlab::versus {

/// Reference for an engine's errors: the last of its steps; the one before shows its convergence.
struct Reference {
  std::string name;
  std::vector<std::string> sets;  ///< texts of --set
  std::vector<double> steps;      ///< s, falling, at least two
};

enum class Group { bullet, bullet_solver, mujoco_user, mujoco_best, ours };

struct Contender {
  std::string name;
  Group group = Group::ours;
  std::string reference;          ///< Reference::name
  std::vector<std::string> sets;  ///< texts of --set
  std::vector<double> steps;      ///< s
  std::size_t lanes = 1;          ///< rollouts side by side
};

struct Field {
  std::vector<Reference> references;
  std::vector<Contender> contenders;
};

/// All contenders possible with the catalog's engines; `left_out` lists the impossible ones.
Field field(const Catalog& catalog, std::vector<std::string>& left_out);

/// Name of the reference for the errors of `ours`, besides their own.
inline constexpr const char* kOther = "bullet";

}  // namespace gaitlab::versus
