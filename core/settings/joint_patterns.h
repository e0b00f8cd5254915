// Joint names given by a user: the name of one joint, or a pattern that matches several.
#pragma once
#include <cstddef>
#include <string>
#include <vector>

namespace gaitlab {

/// Ascending numbers of the joints that match a name (`m3/active`) or a pattern (`*/active`, `m3/*`); for an empty result see
/// no_joint.
std::vector<std::size_t> joints_of(const std::string& text, const std::vector<std::string>& joints);

/// Message for a name or pattern that matches no joint, with the nearest one that does: `no joint 'm3/activ'; did you mean
/// 'm3/active'?`; empty if it matches one.
std::string no_joint(const std::string& text, const std::vector<std::string>& joints);

/// The same message if a single joint is required, for which patterns are not allowed.
std::string not_one_joint(const std::string& text, const std::vector<std::string>& joints);

/// Names of the joints that match a list of names and patterns, in the list's order; a pattern adds the joints that are not
/// named before it. Texts that match no joint are kept.
std::vector<std::string> joints_meant(const std::vector<std::string>& list, const std::vector<std::string>& joints);

}  // namespace gaitlab
