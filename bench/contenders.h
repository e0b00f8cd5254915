// Contenders of a benchmark, which are engines with settings and steps.
#pragma once
#include <string>
#include <vector>

#include "core/plugin/catalog.h"

namespace gaitlab::versus {

/// Reference run for the errors of an engine. The run with the last step is the reference; the run with the step before shows
/// its convergence.
struct Reference {
  std::string name;
  std::vector<std::string> sets;  ///< arguments of --set
  std::vector<double> steps;      ///< s, decreasing, at least two
};

enum class ContenderGroup { bullet, bullet_solver, mujoco_user, mujoco_best, ours };

struct Contender {
  std::string name;
  ContenderGroup group = ContenderGroup::ours;
  std::string reference;          ///< name of the Reference for the errors
  std::vector<std::string> sets;  ///< arguments of --set
  std::vector<double> steps;      ///< s
  std::size_t lanes = 1;          ///< number of rollouts that are simulated side by side
};

struct ContenderField {
  std::vector<Reference> references;
  std::vector<Contender> contenders;
};

/// All contenders that are possible with the engines in the catalog. `left_out` receives sentences about those that are not.
ContenderField field(const Catalog& catalog, std::vector<std::string>& left_out);

/// Name of a second reference for the errors of ContenderGroup::ours.
inline constexpr const char* kOther = "bullet";

}  // namespace gaitlab::versus
