#include "interchange/mjcf_pairs.h"

#include <algorithm>

namespace gaitlab::interchange {

namespace {

bool collide(const GeomMask& one, const GeomMask& other) {
  return (one.contype & other.conaffinity) != 0 || (other.contype & one.conaffinity) != 0;
}

bool collide(const std::vector<GeomMask>& geoms, const std::vector<GeomMask>& others) {
  return std::ranges::any_of(geoms, [&](const GeomMask& one) {
    return std::ranges::any_of(others, [&](const GeomMask& other) { return collide(one, other); });
  });
}

}  // namespace

void SilentPairs::add(std::size_t body, const GeomMask& geom) {
  geoms_.resize(std::max(geoms_.size(), body + 1));
  geoms_[body].push_back(geom);
}

void SilentPairs::add(std::size_t a, std::size_t b) {
  if (a != b) excluded_.insert(std::minmax(a, b));
}

std::set<SilentPairs::Pair> SilentPairs::with_geoms(bool colliding) const {
  std::set<Pair> pairs;
  for (std::size_t a = 0; a < geoms_.size(); ++a) {
    for (std::size_t b = a + 1; b < geoms_.size(); ++b) {
      if (!geoms_[a].empty() && !geoms_[b].empty() && collide(geoms_[a], geoms_[b]) == colliding) pairs.insert({a, b});
    }
  }
  return pairs;
}

std::set<SilentPairs::Pair> SilentPairs::silent() const {
  std::set<Pair> pairs = with_geoms(false);
  pairs.insert(excluded_.begin(), excluded_.end());
  return pairs;
}

bool SilentPairs::all_silent() const { return with_geoms(true).empty() && !with_geoms(false).empty(); }

}  // namespace gaitlab::interchange
