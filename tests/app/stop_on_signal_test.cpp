#include "app/shell/stop_on_signal.h"

#include <gtest/gtest.h>

namespace gaitlab::test {
namespace {

void own_handler(int) {}

/// A program that contains gaitlab, such as Python, keeps its handlers.
TEST(StopOnSignal, RestoresTheHandlersOfBefore) {
  struct sigaction mine = {};
  mine.sa_handler = own_handler;
  struct sigaction before = {};
  sigaction(SIGTERM, &mine, &before);
  {
    const app::StopOnSignal stop(app::StopOnSignal::Second::ends_the_process);
    app::stopped() = false;
    raise(SIGTERM);
    EXPECT_TRUE(app::stopped());
  }
  app::stopped() = false;
  struct sigaction after = {};
  sigaction(SIGTERM, &before, &after);
  EXPECT_EQ(after.sa_handler, &own_handler);
}

}  // namespace
}  // namespace gaitlab::test
