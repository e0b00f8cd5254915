// Plugin with a static object that allocates 64 GB, which it never touches.
#include <memory>
#include <vector>

#include "core/plugin/plugin.h"

namespace {
struct Hoarder {
  Hoarder() {
    constexpr std::size_t kPiece = std::size_t{1} << 30U;
    for (int k = 0; k < 64; ++k) pieces.emplace_back(new char[kPiece]);
  }
  std::vector<std::unique_ptr<char[]>> pieces;
};
const Hoarder kHoarder;
}  // namespace

GAITLAB_PLUGIN(registry) { static_cast<void>(registry); }
