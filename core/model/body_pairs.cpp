#include "core/model/body_pairs.h"

#include <algorithm>

#include "core/model/pattern.h"

namespace gaitlab {

BodyPairs::BodyPairs(const std::vector<BodyPair>& pairs, const std::vector<std::string>& bodies) {
  const auto named = [&](const std::string& text) {
    std::vector<bool> found;
    for (const std::string& body : bodies) found.push_back(glob(text, body));
    return found;
  };
  for (const BodyPair& pair : pairs) pairs_.push_back({named(pair.first), named(pair.second)});
}

bool BodyPairs::has(std::size_t a, std::size_t b) const {
  return std::ranges::any_of(
      pairs_, [&](const Named& pair) { return (pair.first[a] && pair.second[b]) || (pair.first[b] && pair.second[a]); });
}

}  // namespace gaitlab
