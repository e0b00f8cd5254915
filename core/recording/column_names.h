// Columns and numbers as people read them: by the names of joints and contact elements, not by their numbers.
#pragma once
#include <string>
#include <vector>

namespace gaitlab {

/// Names of a run's parts, by their numbers in the columns; an empty name, or too few: not known.
struct PartNames {
  std::vector<std::string> joints = {}, contacts = {};
};

/// `m7/passive torque` for `joint.15.torque`, `m7/passive torque error` for `torque_error.15`, `m2/active/p0 fn` for
/// `contact.3.fn`. The column's own name where it is of no part (`base.x`), or of one whose name is not known.
std::string readable_column(const std::string& column, const PartNames& names);

/// `m7/passive torque RMS` for the summary number `m7/passive.torque.rms`; the number's own name where it is of no joint.
std::string readable_number(const std::string& number);

}  // namespace gaitlab
