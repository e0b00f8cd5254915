// Counter of the heap allocations of a test.
#pragma once

namespace gaitlab::test {

/// Counts heap allocations from construction to destruction. Only one object may exist at a time.
class Allocations {
 public:
  Allocations();
  ~Allocations();
  Allocations(const Allocations&) = delete;
  Allocations& operator=(const Allocations&) = delete;
  [[nodiscard]] long count() const;
};

}  // namespace gaitlab::test
