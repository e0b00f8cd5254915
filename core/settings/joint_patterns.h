// Names of joints as a user gives them: one joint's own, or a pattern that means several.
#pragma once
#include <cstddef>
#include <string>
#include <vector>

namespace gaitlab {

/// Numbers of the joints that a name (`m3/active`) or a pattern (`*/active`, `m3/*`) means, rising; none: no_joint says what to
/// say of it.
std::vector<std::size_t> joints_of(const std::string& text, const std::vector<std::string>& joints);

/// What to say of a name or pattern that means no joint, with the nearest one that does: `no joint 'm3/activ'; did you mean
/// 'm3/active'?`; empty where it means one.
std::string no_joint(const std::string& text, const std::vector<std::string>& joints);

/// The same where one joint is asked for, which no pattern gives.
std::string not_one_joint(const std::string& text, const std::vector<std::string>& joints);

/// The names of the joints that a list of names and patterns means, in the list's order; a pattern adds those that are not
/// named before it. What means no joint stays.
std::vector<std::string> joints_meant(const std::vector<std::string>& list, const std::vector<std::string>& joints);

}  // namespace gaitlab
