#include "shell_case.hpp"

#include <gtest/gtest.h>

namespace culm::shell {
namespace {

Nodes any_slots(int seed) { return kit::Random(seed).matrix<3, 8>(); }

TEST(ShellForms, AreNumberedByTheUpperTriangle) {
  int next = 0;
  for (int i = 0; i < 7; ++i) {
    for (int j = i; j < 7; ++j) {
      EXPECT_EQ(ShellForms::form(i, j), next);
      EXPECT_EQ(ShellForms::form(j, i), next++);
    }
  }
  EXPECT_EQ(next, ShellForms::num_strains);
}

TEST(ShellForms, ModesGiveBackTheNodes) {
  const Nodes q = any_slots(1);
  const ShellForms::Modes p = ShellForms::modes(q);
  const Vec3 centre = 0.25 * (q.col(0) + q.col(2) + q.col(4) + q.col(6));
  const double xi[] = {-1, 1, 1, -1};
  const double eta[] = {-1, -1, 1, 1};
  for (int a = 0; a < 4; ++a) {
    const Vec3 bilinear(xi[a], eta[a], xi[a] * eta[a]);
    EXPECT_LT((centre + p.leftCols<3>() * bilinear - q.col(2 * a)).norm(), 1e-15);
    EXPECT_LT((p.col(3) + p.rightCols<3>() * bilinear - q.col(2 * a + 1)).norm(), 1e-15);
  }
}

// the same as with the gradient, which the contract compares with differences
TEST(ShellForms, ForceAndStiffnessWithoutTheGradient) {
  const ShellForms forms(warped_reference());
  const Nodes mid = any_slots(2);
  const Nodes next = any_slots(3);
  Gradient<8, 28> B_mid;
  Gradient<8, 28> B_next;
  forms.gradient(0, mid, B_mid);
  forms.gradient(0, next, B_next);
  const ShellForms::Stiffness C = kit::Random(4).matrix<28, 28>();
  const ShellForms::Strain S = kit::Random(5).matrix<28, 1>();

  Nodes f = any_slots(6);  // it is added to
  const Vec<24> f0 = f.reshaped();
  ShellForms::add_force(mid, S, f);
  EXPECT_LT((f.reshaped() - f0 - B_mid * S).norm(), 1e-14);

  RowMat<24, 24> K = kit::Random(7).matrix<24, 24>();
  const RowMat<24, 24> K0 = K;
  ShellForms::add_stiffness(mid, next, C, 0.75, K);
  EXPECT_LT((K - K0 - 0.75 * B_mid * C * B_next.transpose()).norm(), 1e-14);
}

}  // namespace
}  // namespace culm::shell
