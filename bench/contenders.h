// Who runs against whom: engines, their set-ups and steps.
#pragma once
#include <string>
#include <vector>

#include "core/plugin/catalog.h"

namespace gaitlab::versus {

/// Whose converged run an engine's errors are measured against: the last of its steps; the one before shows how converged.
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

/// All that the catalog's engines can do; `left_out` says what they cannot.
Field field(const Catalog& catalog, std::vector<std::string>& left_out);

/// Name of the reference that the errors of `ours` are measured against, besides their own.
inline constexpr const char* kOther = "bullet";

}  // namespace gaitlab::versus
