// Tables of a file that was read, in the form in which they are written again.
#pragma once
#include <span>
#include <vector>

#include "core/recording/h5.h"

namespace gaitlab {

inline std::vector<BesideOf> tables_of(std::span<const Beside> read) {
  std::vector<BesideOf> found;
  for (const Beside& one : read) found.push_back({one.name.c_str(), &one.table});
  return found;
}

}  // namespace gaitlab
