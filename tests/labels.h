// A label of tests, by which CTest and `lab` choose them.
#pragma once
#include <string>
#include <utility>
#include <vector>

namespace gaitlab::test {

/// Labels of the tests that a filter of GoogleTest names, in the file of these tests:
///     const Label kWalks("Walk.*:WalkUnder.*-Walk.Ends", "long;unsanitized");
/// Labels in use: `long`, more than a second of CPU, left out of `./lab test --quick`; `unsanitized`, minutes under the
/// sanitizers for lines that shorter tests reach, left out there. `even`, `odd`: gates that CI takes every second time. A
/// comment beside an object states what takes the time where the names of the tests do not. A test with a label is an entry of
/// CTest; the others of its suite are one entry together, because a process for each would cost more than most of them.
class Label {
 public:
  Label(std::string tests, std::string labels) : filter(std::move(tests)), names(std::move(labels)) { all().push_back(this); }
  Label(const Label&) = delete;
  Label& operator=(const Label&) = delete;

  /// All labels of the program.
  static std::vector<const Label*>& all() {
    static std::vector<const Label*> list;
    return list;
  }

  const std::string filter, names;
};

}  // namespace gaitlab::test
