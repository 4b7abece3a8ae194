#include "../src/residual_check.hpp"

#include "spread_system.hpp"

#include <gtest/gtest.h>

namespace culm::solver {
namespace {

// Rows of which others own columns, in pieces that touch at one block and in turn at all of them.
TEST(ResidualCheck, IsThatOfTheWholeMatrix) {
  for (const Skeleton& s : skeletons()) {
    for (const auto& owner_of : {in_pieces, in_turn}) {
      const SpreadSystem system(s, owner_of);
      const Eigen::VectorXd x = Eigen::VectorXd::LinSpaced(s.rows(), -1.0, 2.0);
      const Eigen::VectorXd b = Eigen::VectorXd::LinSpaced(s.rows(), 3.0, -0.5);
      const Eigen::VectorXd rest = b - system.dense * x;
      const Eigen::VectorXd sizes = b.cwiseAbs() + system.dense.cwiseAbs() * x.cwiseAbs();
      ResidualCheck check(assembly::tpetra(*system.matrix), system.comm);
      const double found = check.keep_rest(system.distribute(b), system.distribute(x));
      EXPECT_NEAR(found, rest.cwiseAbs().maxCoeff() / sizes.maxCoeff(), 1e-14) << s.name;
      EXPECT_LT(system.difference(check.rest(), rest), 1e-13 * sizes.maxCoeff()) << s.name;
      EXPECT_DOUBLE_EQ(check(system.distribute(b), system.distribute(x)), found);
    }
  }
}

}  // namespace
}  // namespace culm::solver
