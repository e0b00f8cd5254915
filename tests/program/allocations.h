// Counter of the program's heap allocations.
#pragma once

namespace gaitlab::test {

/// Counts from its construction on; one at a time.
class Allocations {
 public:
  Allocations();
  ~Allocations();
  Allocations(const Allocations&) = delete;
  Allocations& operator=(const Allocations&) = delete;
  [[nodiscard]] long count() const;
};

}  // namespace gaitlab::test
