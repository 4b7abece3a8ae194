#include <culm/math/symmetric.hpp>

#include <gtest/gtest.h>

namespace culm {
namespace {

TEST(Symmetric, GivesBackWhatItTook) {
  const RowMat<7, 7> any = RowMat<7, 7>::Random();
  const RowMat<7, 7> full = any + any.transpose();
  EXPECT_EQ(Symmetric<7>(full).full(), full);
}

TEST(Symmetric, TakesTheUpperTriangle) {
  RowMat<3, 3> full;
  full << 1.0, 2.0, 3.0, -2.0, 4.0, 5.0, -3.0, -5.0, 6.0;
  const RowMat<3, 3> taken = Symmetric<3>(full).full();
  EXPECT_EQ(taken, taken.transpose());
  EXPECT_EQ(taken(0, 2), 3.0);
  EXPECT_EQ(taken(2, 1), 5.0);
}

TEST(Symmetric, TakesHalfTheMemory) {
  EXPECT_EQ(sizeof(Symmetric<28>), 28U * 29U / 2U * sizeof(double));
}

}  // namespace
}  // namespace culm
