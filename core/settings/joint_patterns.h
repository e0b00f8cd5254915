// Joint names given by a user, each the name of one joint or a pattern that matches several joints.
#pragma once
#include <cstddef>
#include <string>
#include <vector>

namespace gaitlab {

/// Ascending numbers of the joints that match a name (`m3/active`) or a pattern (`*/active`, `m3/*`). If the result is empty,
/// no_joint() gives the message.
std::vector<std::size_t> joints_of(const std::string& text, const std::vector<std::string>& joints);

/// Message for a name or pattern that matches no joint, with the most similar name or pattern that matches one: `no joint
/// 'm3/activ'; did you mean 'm3/active'?`. Empty if a joint matches. `part` is `joint`, or `module` for names of modules.
std::string no_joint(const std::string& text, const std::vector<std::string>& joints, const std::string& part = "joint");

/// The message of no_joint() where a single joint is required, so that patterns are not allowed.
std::string not_one_joint(const std::string& text, const std::vector<std::string>& joints, const std::string& part = "joint");

/// Names of the joints that match a list of names and patterns, in the order of the list. A pattern adds the joints that no
/// earlier entry names. Texts that match no joint are kept.
std::vector<std::string> joints_meant(const std::vector<std::string>& list, const std::vector<std::string>& joints);

}  // namespace gaitlab
