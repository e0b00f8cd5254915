// Pairs of bodies that may overlap, by names or patterns.
#pragma once
#include <string>
#include <vector>

namespace gaitlab {

/// Names of two bodies, or patterns (core/model/pattern.h) of several.
struct BodyPair {
  std::string first, second;
  bool operator==(const BodyPair&) const = default;
};

/// Pairs of bodies in a list that BodyPair entries name, in either order.
class BodyPairs {
 public:
  BodyPairs() = default;
  BodyPairs(const std::vector<BodyPair>& pairs, const std::vector<std::string>& bodies);
  /// True if a pair names the bodies with these indices.
  [[nodiscard]] bool has(std::size_t a, std::size_t b) const;

 private:
  struct Named {
    std::vector<bool> first, second;  ///< by body
  };
  std::vector<Named> pairs_ = {};
};

}  // namespace gaitlab
