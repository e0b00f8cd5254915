// Pairs of bodies of an MJCF robot that never collide.
#pragma once
#include <cstddef>
#include <set>
#include <utility>
#include <vector>

namespace gaitlab::interchange {

/// Two geoms collide if contype of one and conaffinity of the other have a common bit.
struct GeomMask {
  int contype, conaffinity;
};

class SilentPairs {
 public:
  using Pair = std::pair<std::size_t, std::size_t>;  ///< numbers of bodies, ascending

  /// Adds a geom of a body.
  void add(std::size_t body, const GeomMask& geom);
  /// Adds a pair that the file excludes; a body beside itself counts for nothing.
  void add(std::size_t a, std::size_t b);
  /// Pairs that the file excludes, and pairs of bodies with geoms of which no two collide.
  [[nodiscard]] std::set<Pair> silent() const;
  /// True if there are pairs of bodies with geoms, and in none of them two geoms collide.
  [[nodiscard]] bool all_silent() const;

 private:
  /// Pairs of bodies with geoms, those whose geoms collide or the others.
  [[nodiscard]] std::set<Pair> with_geoms(bool colliding) const;

  std::vector<std::vector<GeomMask>> geoms_;  ///< by body
  std::set<Pair> excluded_;
};

}  // namespace gaitlab::interchange
