// Lists of pairs of bodies in files: the keys `may_overlap` of module types and of the section `robot`.
#pragma once
#include <string>
#include <vector>

#include "core/model/body_pairs.h"
#include "core/settings/node.h"

namespace gaitlab {

inline constexpr const char* kMayOverlap = "may_overlap";

/// Reads pairs of names or patterns. `bodies` are the bodies of `owner`, such as a module type. A text that matches no body,
/// and a pair of one body with itself, are problems.
std::vector<BodyPair> read_body_pairs(const Node& list, const std::vector<std::string>& bodies, const std::string& owner,
                                      Problems& problems);

/// Pairs as a list for a file.
Node body_pairs_node(const std::vector<BodyPair>& pairs);

}  // namespace gaitlab
