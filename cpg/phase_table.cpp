#include "cpg/phase_table.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <stdexcept>

namespace gaitlab::cpg {
namespace {}

PhaseTable::PhaseTable(std::vector<double> angles) : angles_(std::move(angles)), phases_(angles_.size()) {
  const std::size_t last = angles_.size() - 1;
  for (std::size_t k = 1; k <= last; ++k) {
    if (!(angles_[k] > angles_[k - 1]))
      throw std::invalid_argument("the orbit does not turn about its centre in one direction");
  }
  std::size_t k = 1;
  for (std::size_t i = 0; i <= last; ++i) {
    const double angle = kTurn * static_cast<double>(i) / static_cast<double>(last);
    while (k < last && angles_[k] < angle) ++k;
    const double share = std::clamp((angle - angles_[k - 1]) / (angles_[k] - angles_[k - 1]), 0.0, 1.0);
    phases_[i] = kTurn * (static_cast<double>(k - 1) + share) / static_cast<double>(last);
  }
}

double PhaseTable::look_up(const std::vector<double>& table, double at) {
  if (!std::isfinite(at)) return at;  // the caller reports the state that diverged
  const double turns = std::floor(at / kTurn);
  const double where = (at / kTurn - turns) * static_cast<double>(table.size() - 1);
  const auto k = std::min(static_cast<std::size_t>(where), table.size() - 2);
  return kTurn * turns + table[k] + (where - static_cast<double>(k)) * (table[k + 1] - table[k]);
}

}  // namespace gaitlab::cpg
