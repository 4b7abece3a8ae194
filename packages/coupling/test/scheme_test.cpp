#include <culm/coupling/parts.hpp>
#include <culm/coupling/scheme.hpp>

#include <Eigen/Dense>
#include <culm_kit/deck_list.hpp>
#include <gtest/gtest.h>

#include <cmath>
#include <memory>
#include <string>
#include <utility>
#include <vector>

namespace culm::coupling {
namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;

// H(x) = b - A x: a partner that answers motion against the force, `ratio` times as heavy as the
// structure in its heaviest direction.
struct Answer {
  explicit Answer(double ratio, int size = 5)
      : A(VectorXd::LinSpaced(size, 0.1 * ratio, ratio).asDiagonal()), b(VectorXd::Ones(size)) {
    // not in the axes of the unknowns
    const MatrixXd full = MatrixXd::NullaryExpr(size, size, [](auto i, auto j) {
      return std::sin(static_cast<double>(1 + 3 * i + 7 * j));
    });
    const MatrixXd Q = Eigen::HouseholderQR<MatrixXd>(full).householderQ();
    A = (Q * A * Q.transpose()).eval();
  }
  VectorXd operator()(const VectorXd& x) const { return b - A * x; }
  MatrixXd A;
  VectorXd b;
};

// Attempts until the residual is small; 200 if it never is.
int attempts(Scheme& scheme, const Answer& answer, VectorXd x) {
  int tried = 1;
  for (; tried < 200; ++tried) {
    const VectorXd y = answer(x);
    if (!((y - x).norm() > 1e-10)) break;
    x = scheme.next(x, y);
  }
  scheme.end_window();
  return tried;
}

std::unique_ptr<Scheme> make(const std::string& name, double relaxation) {
  Schema schema("Coupling", "");
  add_scheme_fields(schema);
  return make_scheme(
      kit::deck_list(schema, {{"Scheme", name}, {"Relaxation", relaxation}}, "coupling"));
}

int attempts(const std::string& scheme, double relaxation, double ratio) {
  const auto made = make(scheme, relaxation);
  return attempts(*made, Answer(ratio), VectorXd::Zero(5));
}

// Without relaxation loads grow as soon as the partner is the heavier one.
TEST(Schemes, ConstantRelaxationEndsAtItsLimit) {
  EXPECT_LT(attempts("Constant", 1.0, 0.5), 50);
  EXPECT_EQ(attempts("Constant", 1.0, 1.1), 200);
  EXPECT_LT(attempts("Constant", 0.3, 3.0), 100);
  EXPECT_EQ(attempts("Constant", 0.3, 6.0), 200);  // 2 / 0.3 = 6.7 = 1 + 5.7
}

TEST(Schemes, AitkenFindsItsRelaxation) {
  EXPECT_LT(attempts("Aitken", 0.1, 0.5), 20);
  EXPECT_LT(attempts("Aitken", 0.1, 5.0), 100);
}

// A linear problem of n unknowns is solved by n + 2 attempts, however heavy the partner is, and
// from what earlier windows have taught at once.
TEST(Schemes, QuasiNewtonSolvesALinearProblemInSoManyAttemptsAsUnknowns) {
  for (const double ratio : {0.5, 5.0, 100.0}) {
    QuasiNewton scheme(0.1, 8, 1e-8);
    const Answer answer(ratio);
    EXPECT_LE(attempts(scheme, answer, VectorXd::Zero(5)), 8) << ratio;
    EXPECT_LE(attempts(scheme, answer, VectorXd::LinSpaced(5, -1.0, 2.0)), 3) << ratio;
  }
}

// Equal loads teach nothing and do no harm.
TEST(Schemes, QuasiNewtonLeavesOutEmptyDifferences) {
  QuasiNewton scheme(0.1, 8, 1e-2);
  const Answer answer(2.0);
  const VectorXd x = VectorXd::Ones(5);
  scheme.next(x, answer(x));
  const VectorXd next = scheme.next(x, answer(x));
  EXPECT_TRUE(next.allFinite());
  EXPECT_EQ(next, x + 0.1 * (answer(x) - x));
}

// What a scheme has learnt goes on after it was saved.
TEST(Schemes, GoOnFromWhatTheyHaveLearnt) {
  for (const char* name : {"Quasi Newton", "Aitken"}) {
    const auto first = make(name, 0.1);
    const Answer answer(3.0);
    attempts(*first, answer, VectorXd::Zero(5));
    Snapshot snapshot;
    first->save(snapshot);
    const auto second = make(name, 0.1);
    second->restore(snapshot);
    VectorXd x = VectorXd::LinSpaced(5, -1.0, 2.0);
    for (int i = 0; i < 4; ++i) {
      const VectorXd next = first->next(x, answer(x));
      EXPECT_EQ(second->next(x, answer(x)), next) << name;
      x = next;
    }
  }
}

// Structure and partner at once, f from x and x from f: attempts until both fit.
int parallel_attempts(Scheme& scheme, double unit, VectorXd start) {
  const Answer partner(1.0);
  PartScale scale;
  std::vector<VectorXd> tried = {std::move(start), VectorXd::Zero(5)}, found;
  for (int attempt = 1; attempt < 200; ++attempt) {
    found = {partner(tried[1] / unit), unit * tried[0]};
    if ((found[0] - tried[0]).norm() < 1e-10 && (found[1] - tried[1]).norm() < 1e-10 * unit) {
      scheme.end_window();
      return attempt;
    }
    tried = scale.next(scheme, tried, found);
  }
  return 200;
}

// Loads and motions have units of their own, which shall not count.
TEST(Schemes, PartsAreMeasuredByTheirOwnResiduals) {
  for (const char* name : {"Quasi Newton", "Aitken"}) {
    const int expected = parallel_attempts(*make(name, 0.1), 1.0, VectorXd::Zero(5));
    EXPECT_LT(expected, 150) << name;
    for (const double unit : {1e-9, 1e9}) {
      EXPECT_NEAR(parallel_attempts(*make(name, 0.1), unit, VectorXd::Zero(5)), expected, 2)
          << name << unit;
    }
  }
}

TEST(Schemes, PartsAreSolvedInSoManyAttemptsAsUnknowns) {
  QuasiNewton scheme(0.1, 8, 1e-8);
  EXPECT_LE(parallel_attempts(scheme, 1e-3, VectorXd::Zero(5)), 13);
}

}  // namespace
}  // namespace culm::coupling
