#include <culm/parallel/comm.hpp>
#include <culm/parallel/patience.hpp>

#include <gtest/gtest.h>

#include <chrono>
#include <ctime>
#include <thread>

namespace culm::parallel {
namespace {

// Other programs have the processor meanwhile, however many there are.
TEST(Patience, RanksThatWaitForTheRootLeaveTheProcessor) {
  const Comm comm;
  const Patience patience;
  const std::clock_t before = std::clock();
  if (comm.is_root()) std::this_thread::sleep_for(std::chrono::milliseconds(100));
  comm.await_root();
  const double used = static_cast<double>(std::clock() - before) / CLOCKS_PER_SEC;
  EXPECT_GE(patience.waited(), comm.is_root() ? 0.1 : 0.0);
  EXPECT_LT(used, 0.5 * patience.waited() + 0.01);
}

}  // namespace
}  // namespace culm::parallel
