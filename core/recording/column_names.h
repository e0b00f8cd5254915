// Readable names of columns and numbers, with the names of joints and contact elements instead of their numbers.
#pragma once
#include <string>
#include <vector>

namespace gaitlab {

/// Names of joints and contact elements, at the indices that names of columns contain. A name is empty or missing if it is
/// unknown.
struct PartNames {
  std::vector<std::string> joints = {}, contacts = {};
};

/// Returns `m7/passive torque` for `joint.15.torque`, `m7/passive torque error` for `torque_error.15`, `m2/active/p0 fn` for
/// `contact.3.fn`. Returns the name of the column if it does not belong to a part (`base.x`), or if the name of the part is
/// unknown.
std::string readable_column(const std::string& column, const PartNames& names);

/// Returns `m7/passive torque RMS` for the summary number `m7/passive.torque.rms`. Returns the name of the number if it does
/// not belong to a joint.
std::string readable_number(const std::string& number);

}  // namespace gaitlab
