#include <culm/parallel/comm.hpp>
#include <culm/solver/linear_solver.hpp>

#include <Eigen/Dense>
#include <Teuchos_DefaultMpiComm.hpp>
#include <gtest/gtest.h>

#include <cmath>

namespace culm::solver {
namespace {

using assembly::CrsMatrix;
using assembly::GlobalIndex;
using assembly::Map;
using assembly::values_of;

// An unsymmetric matrix with a band and some far entries; row i lives on rank i % size, so no rank
// has a contiguous piece.
class ScatteredSystem {
 public:
  static constexpr int size = 60;

  ScatteredSystem() : dense_(Eigen::MatrixXd::Zero(size, size)) {
    for (int i = 0; i < size; ++i) {
      for (int j : {i - 2, i - 1, i, i + 1, (7 * i + 3) % size}) {
        if (j >= 0 && j < size) dense_(i, j) += std::sin(1.0 + 3.0 * i - 2.0 * j) + 4.0 * (i == j);
      }
    }
    std::vector<GlobalIndex> rows;
    for (int i = comm_.rank(); i < size; i += comm_.size()) rows.push_back(i);
    const auto mpi = Teuchos::rcp(new Teuchos::MpiComm<int>(comm_.handle()));
    map_ = comm_.size() == 1
               ? Teuchos::rcp(new Map(size, 0, mpi))
               : Teuchos::rcp(new Map(size, Teuchos::arrayViewFromVector(rows), 0, mpi));
    matrix_ = Teuchos::rcp(new CrsMatrix(map_, 8));
    for (GlobalIndex i : rows) insert_row(i);
    matrix_->fillComplete();
  }

  const Eigen::MatrixXd& dense() const { return dense_; }
  const Teuchos::RCP<const Map> map() const { return map_; }
  Teuchos::RCP<CrsMatrix> matrix() const { return matrix_; }
  const parallel::Comm& comm() const { return comm_; }

  Vector distribute(const Eigen::VectorXd& whole) const {
    Vector v(map_);
    const auto values = values_of(v);
    for (std::size_t i = 0; i < values.size(); ++i) {
      values[i] = whole[map_->getGlobalElement(static_cast<int>(i))];
    }
    return v;
  }
  // largest difference to a whole vector on any rank
  double difference(const Vector& v, const Eigen::VectorXd& whole) const {
    Vector d = distribute(whole);
    d.update(1.0, v, -1.0);
    return d.normInf();
  }

 private:
  void insert_row(GlobalIndex i) {
    std::vector<GlobalIndex> columns;
    std::vector<double> values;
    for (int j = 0; j < size; ++j) {
      if (dense_(i, j) == 0.0) continue;
      columns.push_back(j);
      values.push_back(dense_(i, j));
    }
    matrix_->insertGlobalValues(i, Teuchos::arrayViewFromVector(columns),
                                Teuchos::arrayViewFromVector(values));
  }

  parallel::Comm comm_;
  Eigen::MatrixXd dense_;
  Teuchos::RCP<const Map> map_;
  Teuchos::RCP<CrsMatrix> matrix_;
};

TEST(RootedKlu2, SolvesUnsymmetricSystemsOnAnyNumberOfRanks) {
  const ScatteredSystem system;
  const Eigen::VectorXd x = Eigen::VectorXd::LinSpaced(ScatteredSystem::size, -1.0, 2.0);
  const auto solver = make_rooted_klu2(system.matrix(), system.comm());
  ASSERT_TRUE(solver->factor());
  Vector solution(system.map());
  EXPECT_LT(solver->solve(system.distribute(system.dense() * x), solution), 1e-14);
  EXPECT_LT(system.difference(solution, x), 1e-12);
}

TEST(RootedKlu2, NewValuesReplaceOldFactors) {
  const ScatteredSystem system;
  const auto solver = make_rooted_klu2(system.matrix(), system.comm());
  ASSERT_TRUE(solver->factor());
  const auto values = system.matrix()->getLocalMatrixHost().values;
  for (std::size_t k = 0; k < values.extent(0); ++k) values(k) *= 2.0;
  ASSERT_TRUE(solver->factor());
  const Eigen::VectorXd x = Eigen::VectorXd::Ones(ScatteredSystem::size);
  Vector solution(system.map());
  solver->solve(system.distribute(system.dense() * x), solution);
  EXPECT_LT(system.difference(solution, 0.5 * x), 1e-12);
}

TEST(RootedKlu2, SingularMatrixIsNoticedAndItsDirectionFound) {
  const ScatteredSystem system;
  const auto values = system.matrix()->getLocalMatrixHost().values;
  // row 5 becomes zero, so nothing resists a direction that the left kernel e_5 allows
  for (int row = 0; row < static_cast<int>(system.map()->getNodeNumElements()); ++row) {
    if (system.map()->getGlobalElement(row) != 5) continue;
    const auto begin = system.matrix()->getLocalMatrixHost().graph.row_map;
    for (auto k = begin(row); k < begin(row + 1); ++k) values(k) = 0.0;
  }
  const auto solver = make_rooted_klu2(system.matrix(), system.comm());
  Vector x(system.map());
  const Vector b = system.distribute(Eigen::VectorXd::Ones(ScatteredSystem::size));
  EXPECT_TRUE(!solver->factor() || solver->solve(b, x) > 1e-8);
  Vector direction(system.map());
  EXPECT_LT(solver->weakest_direction(direction), 2e-15);
  EXPECT_NEAR(direction.normInf(), 1.0, 1e-12);
}

}  // namespace
}  // namespace culm::solver
