// Same build, same scenario, same bytes; and no allocation in the steady state.
#include <atomic>
#include <cstdlib>
#include <locale>
#include <new>

#include "core/scenario/scenario.h"
#include "core/trace/trace.h"
#include "fixture.h"

namespace {
std::atomic<bool> counting{false};
std::atomic<long> allocations{0};

void* counted(std::size_t size) {
  if (counting) ++allocations;
  if (void* memory = std::malloc(size == 0 ? 1 : size)) return memory;
  throw std::bad_alloc();
}
}  // namespace

void* operator new(std::size_t size) { return counted(size); }
void* operator new[](std::size_t size) { return counted(size); }
void operator delete(void* memory) noexcept { std::free(memory); }
void operator delete[](void* memory) noexcept { std::free(memory); }
void operator delete(void* memory, std::size_t) noexcept { std::free(memory); }
void operator delete[](void* memory, std::size_t) noexcept { std::free(memory); }

namespace gaitlab::test {
namespace {

TEST(Determinism, OtherFolderOtherTimeSameBytes) {
  const Folder one;
  const Folder two;
  const std::string run = "run '" + kScenarios + "caterpillar.yaml' --set duration=0.6 --quiet --out ";
  ASSERT_EQ(gaitlab(run + "a", one / "").code, 0);
  ASSERT_EQ(gaitlab(run + "some/where/b", two / "").code, 0);
  for (const char* file : {"trace.csv", "scenario.resolved.yaml"}) {
    EXPECT_EQ(read(one / (std::string("a/") + file)), read(two / (std::string("some/where/b/") + file))) << file;
  }
  // The resolved scenario alone, from a folder that knows no module: the same trace, and itself again.
  ASSERT_EQ(gaitlab("run '" + (one / "a/scenario.resolved.yaml") + "' --quiet --out c", two / "").code, 0);
  EXPECT_EQ(read(one / "a/trace.csv"), read(two / "c/trace.csv"));
  EXPECT_EQ(read(one / "a/scenario.resolved.yaml"), read(two / "c/scenario.resolved.yaml"));
}

/// Writes 0,5 for 0.5 and 1.000 for 1000.
struct Comma final : std::numpunct<char> {
  [[nodiscard]] char do_decimal_point() const override { return ','; }
  [[nodiscard]] char do_thousands_sep() const override { return '.'; }
  [[nodiscard]] std::string do_grouping() const override { return "\3"; }
};

TEST(Determinism, OtherLocaleSameBytes) {
  const auto texts = [] {
    const Scenario s = shipped("caterpillar.yaml", {"duration=0.1"});
    return std::pair(resolved(s), hash(run(s).trace));
  };
  const auto plain = texts();
  const std::locale before = std::locale::global(std::locale(std::locale(), new Comma));
  const auto german = texts();
  std::locale::global(before);
  EXPECT_EQ(plain, german);
}

TEST(Determinism, SnapshotGoesOnAsIfNothingHadHappened) {
  const Scenario s = shipped("caterpillar.yaml", {"duration=0.1"});
  Simulation simulation({&s, 1});
  for (int i = 0; i < 1000; ++i) simulation.step();
  const std::vector<double> snapshot(simulation.state().begin(), simulation.state().end());
  for (int i = 0; i < 1000; ++i) simulation.step();
  const std::vector<double> first(simulation.state().begin(), simulation.state().end());
  std::copy(snapshot.begin(), snapshot.end(), simulation.state().begin());
  for (int i = 0; i < 1000; ++i) simulation.step();
  EXPECT_TRUE(std::equal(first.begin(), first.end(), simulation.state().begin()));
}

TEST(SteadyState, AllocatesNothing) {
  const Scenario s = shipped("caterpillar.yaml", {"duration=0.1"});
  Simulation simulation({&s, 1});
  for (int i = 0; i < 1000; ++i) simulation.step();  // first ticks size Bullet's scratch
  allocations = 0;
  counting = true;
  for (int i = 0; i < 1000; ++i) simulation.step();  // trace rows and control ticks among them
  counting = false;
  EXPECT_EQ(allocations, 0);
}

}  // namespace
}  // namespace gaitlab::test
