#include <Eigen/Core>
#include <culm_kit/no_heap.hpp>
#include <gtest/gtest.h>

#include <memory>

namespace culm::kit {
namespace {

// Keeps the compiler from removing an allocation nobody uses.
template <class T>
void keep(T& value) {
  asm volatile("" : : "r"(&value) : "memory");
}

// A sanitizer has functions of its own, and nothing is counted there.
#if defined(__SANITIZE_ADDRESS__)
constexpr bool counts = false;
#elif defined(__has_feature)
constexpr bool counts = !__has_feature(address_sanitizer);
#else
constexpr bool counts = true;
#endif

TEST(NoHeap, NoticesNew) {
  if (!counts) GTEST_SKIP() << "under a sanitizer";
  const long before = allocation_count;
  auto number = std::make_unique<double>(1.0);
  keep(*number);
  EXPECT_GT(allocation_count, before);
}

TEST(NoHeap, NoticesEigen) {
  if (!counts) GTEST_SKIP() << "under a sanitizer";
  const long before = allocation_count;
  Eigen::VectorXd vector(100);
  keep(vector);
  EXPECT_GT(allocation_count, before);
}

TEST(NoHeap, AcceptsTheStack) {
  const NoHeap guard;
  Eigen::Matrix<double, 6, 6> m = Eigen::Matrix<double, 6, 6>::Identity();
  keep(m);
}

}  // namespace
}  // namespace culm::kit
