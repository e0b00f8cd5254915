// Readable names of columns and numbers: with the names of joints and contact elements, not their numbers.
#pragma once
#include <string>
#include <vector>

namespace gaitlab {

/// Names of a run's parts, by their numbers in the columns; an empty or missing name: not known.
struct PartNames {
  std::vector<std::string> joints = {}, contacts = {};
};

/// `m7/passive torque` for `joint.15.torque`, `m7/passive torque error` for `torque_error.15`, `m2/active/p0 fn` for
/// `contact.3.fn`. The column's name if it does not belong to a part (`base.x`), or if the part's name is not known.
std::string readable_column(const std::string& column, const PartNames& names);

/// `m7/passive torque RMS` for the summary number `m7/passive.torque.rms`; the number's name if it does not belong to a joint.
std::string readable_number(const std::string& number);

}  // namespace gaitlab
