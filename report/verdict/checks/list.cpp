#include "report/verdict/checks/list.h"

#include <algorithm>
#include <iterator>

namespace gaitlab::report {

std::span<const CheckKind> check_kinds() {
  static const std::vector<CheckKind> kKinds = [] {
    std::vector<CheckKind> all;
    for (const auto rows : checks::kList) std::ranges::move(rows(), std::back_inserter(all));
    return all;
  }();
  return kKinds;
}

}  // namespace gaitlab::report
