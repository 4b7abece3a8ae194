#include "../src/block_lu.hpp"

#include <culm/base/error.hpp>

#include "../src/block_hosts.hpp"
#include "../src/blocks.hpp"
#include "../src/guarded_block_lu.hpp"
#include "../src/matrix_checks.hpp"
#include "skeletons.hpp"

#include <Eigen/Dense>
#include <Teuchos_DefaultMpiComm.hpp>
#include <culm_kit/no_heap.hpp>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <random>

namespace culm::solver {
namespace {

using assembly::CrsMatrix;
using assembly::GlobalIndex;
using assembly::Map;

// A matrix on this rank with the pattern of a skeleton.
class BlockMatrix {
 public:
  explicit BlockMatrix(const Skeleton& s, unsigned seed = 1) : values(random_values(s, seed)) {
    const std::vector<int> block_of = s.block_of_row();
    const auto self = Teuchos::rcp(new Teuchos::MpiComm<int>(MPI_COMM_SELF));
    const auto map = Teuchos::rcp(new Map(s.rows(), 0, self));
    matrix = Teuchos::rcp(new CrsMatrix(map, static_cast<std::size_t>(s.rows())));
    for (int row = 0; row < s.rows(); ++row) {
      std::vector<GlobalIndex> columns;
      std::vector<double> entries;
      for (int column = 0; column < s.rows(); ++column) {
        if (!s.couples(block_of[row], block_of[column])) continue;
        columns.push_back(column);
        entries.push_back(values(row, column));
      }
      matrix->insertGlobalValues(row, Teuchos::arrayViewFromVector(columns),
                                 Teuchos::arrayViewFromVector(entries));
    }
    matrix->fillComplete();
  }

  // The values again, after they have been changed.
  void refresh() {
    const auto local = matrix->getLocalMatrixHost();
    for (int row = 0; row < local.numRows(); ++row) {
      const auto at = static_cast<std::size_t>(row);
      for (auto k = local.graph.row_map(at); k < local.graph.row_map(at + 1); ++k) {
        local.values(k) = values(row, local.graph.entries(k));
      }
    }
  }

  Eigen::MatrixXd values;
  Teuchos::RCP<CrsMatrix> matrix;
};

template <class Factors>
Eigen::VectorXd solve(Factors& factors, Eigen::VectorXd b) {
  factors.solve({b.data(), static_cast<std::size_t>(b.size())});
  return b;
}

double relative_residual(const Eigen::MatrixXd& A, const Eigen::VectorXd& x,
                         const Eigen::VectorXd& b) {
  const double size = (A.cwiseAbs() * x.cwiseAbs() + b.cwiseAbs()).maxCoeff();
  return (b - A * x).lpNorm<Eigen::Infinity>() / size;
}

TEST(BlockLu, SolvesAndKnowsTheDeterminant) {
  for (const Skeleton& s : skeletons()) {
    for (unsigned seed = 1; seed <= 5; ++seed) {
      const BlockMatrix A(s, seed);
      BlockLu blocks(*A.matrix);
      ASSERT_TRUE(blocks.factor()) << s.name << " of " << s.sizes.size();
      const Eigen::VectorXd x = Eigen::VectorXd::LinSpaced(s.rows(), -1.0, 2.0);
      const Eigen::VectorXd b = A.values * x;
      const Eigen::VectorXd found = solve(blocks, b);
      const Eigen::FullPivLU<Eigen::MatrixXd> dense(A.values);
      // numbers without order need pivots from everywhere; without them they lose some digits
      EXPECT_LT(relative_residual(A.values, found, b), 1e-10) << s.name << " of " << s.sizes.size();
      EXPECT_LT((found - x).norm(), 1e-10 / dense.rcond() * x.norm());
      const double exact = dense.determinant();
      EXPECT_EQ(blocks.determinant().sign, exact > 0.0 ? 1 : -1) << s.name;
      EXPECT_NEAR(blocks.determinant().log_size, std::log(std::abs(exact)), 1e-9) << s.name;
    }
  }
}

TEST(BlockLu, RowsMayBeExchangedInsideBlocks) {
  for (const int size : {2, 3, 4, 6}) {
    const Skeleton s = tree(20, [size](int) { return size; });
    BlockMatrix A(s);
    // the large entries leave the diagonal, in every third block
    for (int b = 0; b < 20; b += 3) {
      auto rows = A.values.middleRows(size * b, size);
      rows = Eigen::MatrixXd(rows.colwise().reverse());
      A.values.diagonal().segment(size * b, size) *= 1e-6;
    }
    A.refresh();
    BlockLu blocks(*A.matrix);
    ASSERT_TRUE(blocks.factor());
    const Eigen::VectorXd b = Eigen::VectorXd::LinSpaced(s.rows(), -1.0, 2.0);
    EXPECT_LT(relative_residual(A.values, solve(blocks, b), b), 1e-13) << size;
    EXPECT_EQ(blocks.determinant().sign, A.values.determinant() > 0.0 ? 1 : -1) << size;
  }
}

TEST(BlockLu, AllocatesNothingAfterTheFirstFactorisation) {
  for (const Skeleton& s : {chain(50, [](int) { return 6; }), bodies(20, true)}) {
    BlockMatrix A(s);
    BlockLu blocks(*A.matrix);
    ASSERT_TRUE(blocks.factor());
    Eigen::VectorXd x = Eigen::VectorXd::Ones(s.rows());
    A.values *= 2.0;
    A.refresh();
    const kit::NoHeap guard;
    ASSERT_TRUE(blocks.factor());
    blocks.solve({x.data(), static_cast<std::size_t>(x.size())});
    EXPECT_EQ(std::abs(blocks.determinant().sign), 1);
  }
}

// Rows with equal columns make a block where they stand side by side in the matrix, too: values of
// a row between them belong to somebody else.
TEST(BlockLu, RowsOfAPartThatStandApartAreNoBlock) {
  const BlockMatrix A(chain(2, [](int) { return 2; }));
  EXPECT_THAT(find_blocks(*A.matrix).sizes, testing::ElementsAre(4));
  PartOfRows part;
  part.rows = part.place = {0, 2, 1, 3};
  const BlockRows rows(*A.matrix, part);
  EXPECT_THAT(find_blocks(rows).sizes, testing::ElementsAre(1, 1, 1, 1));
  BlockLu factors(rows);
  ASSERT_TRUE(factors.factor());
  const Eigen::Vector4d b(-1.0, 0.5, 2.0, 3.0);
  const Eigen::Vector4d x = solve(factors, b(part.rows))(part.place);
  EXPECT_LT(relative_residual(A.values, x, b), 1e-12);
}

// What is left of the last blocks is their Schur complement, and a solution comes in two halves.
TEST(BlockLu, KeepsTheLastBlocks) {
  for (const Skeleton& s : skeletons()) {
    const BlockMatrix A(s);
    const int blocks = static_cast<int>(s.sizes.size());
    for (const int kept : {1, 2}) {
      if (kept >= blocks) continue;
      const int rows = std::accumulate(s.sizes.end() - kept, s.sizes.end(), 0);
      const int inner = s.rows() - rows;
      const std::vector<int> found_blocks = block_of_row(find_blocks(*A.matrix));
      if (found_blocks[inner - 1] == found_blocks[inner]) continue;  // the same columns
      const auto& M = A.values;
      const Eigen::PartialPivLU<Eigen::MatrixXd> inside(M.topLeftCorner(inner, inner));
      if (inside.rcond() < 1e-6) continue;
      BlockLu factors(*A.matrix, rows);
      ASSERT_TRUE(factors.factor()) << s.name << " of " << blocks;
      const Eigen::MatrixXd exact =
          M.bottomRightCorner(rows, rows) -
          M.bottomLeftCorner(rows, inner) * inside.solve(M.topRightCorner(inner, rows));
      using ByRows = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;
      const Eigen::Map<const ByRows> found(factors.remainder().data(), rows, rows);
      EXPECT_LT((found - exact).norm(), 1e-9 * exact.norm()) << s.name << " of " << blocks;

      const Eigen::VectorXd x = Eigen::VectorXd::LinSpaced(s.rows(), -1.0, 2.0);
      Eigen::VectorXd b = M * x;
      factors.reduce({b.data(), static_cast<std::size_t>(b.size())});
      b.tail(rows) = exact.partialPivLu().solve(b.tail(rows)).eval();
      factors.extend({b.data(), static_cast<std::size_t>(b.size())});
      EXPECT_LT((b - x).norm(), 1e-7 * x.norm()) << s.name << " of " << blocks;
    }
  }
}

// What is reduced on the way is what is reduced afterwards, to the last digit, the first time too.
TEST(BlockLu, ReducesWhileItFactors) {
  for (const Skeleton& s : skeletons()) {
    BlockMatrix A(s);
    const int kept = s.sizes.back();
    const std::vector<int> found_blocks = block_of_row(find_blocks(*A.matrix));
    if (s.sizes.size() < 2 || found_blocks[s.rows() - kept - 1] == found_blocks[s.rows() - kept]) {
      continue;
    }
    BlockLu one_by_one(*A.matrix, kept), at_once(*A.matrix, kept);
    for (int i = 0; i < 2; ++i) {
      ASSERT_EQ(one_by_one.factor(), true) << s.name;
      const Eigen::VectorXd b = Eigen::VectorXd::LinSpaced(s.rows(), -1.0, 2.0 + i);
      Eigen::VectorXd x = b, y = b;
      const std::span<double> of_x(x.data(), static_cast<std::size_t>(x.size()));
      const std::span<double> of_y(y.data(), static_cast<std::size_t>(y.size()));
      one_by_one.reduce(of_x);
      ASSERT_TRUE(at_once.factor_and_reduce(of_y));
      EXPECT_EQ(y, b);
      at_once.put_kept(of_y);
      EXPECT_EQ(y, x) << s.name << " of " << s.sizes.size();
      one_by_one.extend(of_x);
      at_once.extend(of_y);
      EXPECT_EQ(y, x) << s.name << " of " << s.sizes.size();
      A.values *= 2.0;
      A.refresh();
    }
  }
}

// Where panels are made changes no digit.
TEST(BlockLu, ABenchChangesNothing) {
  constexpr std::size_t none_cached = 0;
  for (const Skeleton& s : skeletons()) {
    BlockMatrix A(s);
    const int last = s.sizes.back();
    const std::vector<int> blocks = block_of_row(find_blocks(*A.matrix));
    const bool stands_alone =
        s.sizes.size() > 1 && blocks[s.rows() - last - 1] != blocks[s.rows() - last];
    for (const int kept : {0, stands_alone ? last : 0}) {
      BlockLu in_place(*A.matrix, kept), by_bench(*A.matrix, kept, none_cached);
      for (int i = 0; i < 2; ++i) {
        const std::string where = s.name + " of " + std::to_string(s.sizes.size());
        Eigen::VectorXd x = Eigen::VectorXd::LinSpaced(s.rows(), -1.0, 2.0), y = x;
        const std::span<double> of_x(x.data(), static_cast<std::size_t>(x.size()));
        const std::span<double> of_y(y.data(), static_cast<std::size_t>(y.size()));
        ASSERT_TRUE(in_place.factor_and_reduce(of_x) && by_bench.factor_and_reduce(of_y)) << where;
        EXPECT_TRUE(std::ranges::equal(in_place.remainder(), by_bench.remainder())) << where;
        in_place.put_kept(of_x);
        by_bench.put_kept(of_y);
        in_place.extend(of_x);
        by_bench.extend(of_y);
        EXPECT_EQ(x, y) << where;
        in_place.reduce(of_x);
        by_bench.reduce(of_y);
        EXPECT_EQ(x, y) << where;
        EXPECT_EQ(in_place.determinant().log_size, by_bench.determinant().log_size) << where;
        A.values *= 2.0;
        A.refresh();
      }
    }
  }
}

// Factors that were not kept are made again, of what was factored and of nothing else.
TEST(BlockLu, RefusesToReduceWithAnotherMatrix) {
  const Skeleton s = chain(9, [](int) { return 6; });
  BlockMatrix A(s);
  BlockLu by_bench(*A.matrix, 0, 0);
  Eigen::VectorXd x = Eigen::VectorXd::Ones(s.rows());
  const std::span<double> of_x(x.data(), static_cast<std::size_t>(x.size()));
  ASSERT_TRUE(by_bench.factor_and_reduce(of_x));
  A.values *= 0.0;
  A.refresh();
  EXPECT_THROW(by_bench.reduce(of_x), InternalError);
}

// Of a chain two panels are made at a time, of a tree those that wait for their second branch, too.
TEST(BlockLu, ABenchHoldsFewPanels) {
  constexpr int nodes = 63;
  const auto six = [](int) { return 6; };
  const auto size_of = [&](const Skeleton& s) {
    const BlockMatrix A(s);
    const BlockPlan plan = plan_blocks(*A.matrix, std::vector<int>(nodes, -1), nodes, 0);
    std::size_t largest = 0;
    for (const BlockPlan::Panel& p : plan.panels) {
      largest = std::max(largest, whole_lines(static_cast<std::size_t>(p.size) * p.stride() +
                                              static_cast<std::size_t>(p.width) * p.size));
    }
    return static_cast<double>(plan.bench_size) / static_cast<double>(largest);
  };
  EXPECT_LE(size_of(chain(nodes, six)), 3.0);  // the last panel is narrower
  EXPECT_LE(size_of(tree(nodes, six)), 33.0);  // leaves first
}

// Elimination begins at the free end, so that nothing is dragged along.
TEST(BlockLu, AKeptEndDoesNotWidenAChain) {
  const Skeleton s = chain(60, [](int) { return 6; });
  const BlockMatrix A(s);
  const std::vector<int> no_hosts(60, -1);
  const BlockPlan plan = plan_blocks(*A.matrix, no_hosts, 59);
  for (const BlockPlan::Panel& panel : plan.panels) EXPECT_LE(panel.width, 6);
}

// Against the order of the memory, elimination of long chains waits for the matrix.
TEST(BlockLu, AChainIsEliminatedInItsOwnOrder) {
  constexpr int nodes = 60;
  const BlockMatrix A(chain(nodes, [](int) { return 6; }));
  const BlockPlan plan = plan_blocks(*A.matrix, std::vector<int>(nodes, -1), nodes);
  // the last two may be exchanged: both are ends then
  EXPECT_TRUE(std::is_sorted(plan.unknown.begin(), plan.unknown.end() - 12));
}

TEST(BlockLu, WithItsHostsFactorsDoNotDependOnEarlierOnes) {
  const Skeleton s = bodies(12, true);
  BlockMatrix A(s, 1);
  BlockLu used(*A.matrix);
  ASSERT_TRUE(used.factor());
  A.values = random_values(s, 2);
  A.refresh();
  BlockLu fresh(*A.matrix);
  ASSERT_TRUE(fresh.set_hosts(used.hosts()));
  ASSERT_TRUE(used.factor() && fresh.factor());
  const Eigen::VectorXd b = Eigen::VectorXd::LinSpaced(s.rows(), -1.0, 2.0);
  EXPECT_EQ(solve(used, b), solve(fresh, b));
  EXPECT_FALSE(fresh.set_hosts(std::vector<int>{-1}));
  EXPECT_FALSE(fresh.set_hosts(std::vector<int>(24, 24)));
}

TEST(BlockLu, RefusesPivotsThatAreRoundingOrNoNumbers) {
  const Skeleton s = chain(9, [](int) { return 6; });
  for (const double last : {0.0, std::numeric_limits<double>::quiet_NaN()}) {
    BlockMatrix A(s);
    A.values.row(20) = last * A.values.row(20);
    A.refresh();
    BlockLu blocks(*A.matrix);
    EXPECT_FALSE(blocks.factor());
  }
  // two nodes that move together meet no resistance
  Eigen::MatrixXd spring(2, 2);
  spring << 1.0, -1.0, -1.0, 1.0;
  BlockMatrix A(chain(2, [](int) { return 1; }));
  A.values = spring / 3.0;
  A.refresh();
  BlockLu blocks(*A.matrix);
  EXPECT_FALSE(blocks.factor());
}

// A rotor of a hub and a blade, which nothing holds but a hinge and a brake on a tower. With the
// hinge alone it turns, so the hub must be eliminated with the brake as well.
TEST(BlockLu, APartThatOnlyJointsHoldIsEliminatedWithThem) {
  enum { hub, tower, hinge, brake, ground, blade };
  const Skeleton s{
      "rotor",
      {{hub, blade}, {hub, hinge}, {tower, hinge}, {hub, brake}, {tower, brake}, {tower, ground}},
      {6, 6, 5, 1, 12, 6},
      {hinge, brake}};
  BlockMatrix A(s);
  const Eigen::MatrixXd stiffness = A.values.bottomRightCorner(6, 6);
  A.values.topLeftCorner(6, 6) = stiffness;
  A.values.topRightCorner(6, 6) = -stiffness;
  A.values.bottomLeftCorner(6, 6) = -stiffness;
  A.refresh();
  EXPECT_EQ(choose_hosts(*A.matrix), (std::vector<int>{-1, -1, hub, tower, -1, -1}));
  BlockLu blocks(*A.matrix);
  ASSERT_TRUE(blocks.factor());
  EXPECT_EQ(blocks.hosts(), (std::vector<int>{tower, -1, tower, tower, -1, -1}));
  const Eigen::VectorXd b = Eigen::VectorXd::LinSpaced(s.rows(), -1.0, 2.0);
  EXPECT_LT(relative_residual(A.values, solve(blocks, b), b), 1e-13);
  EXPECT_EQ(blocks.determinant().sign, A.values.determinant() > 0.0 ? 1 : -1);
}

// A generator with next to no mass between a heavy rotor and a tower; equations of joints of any
// scale. Neither the mass that comes to the generator nor the scale is a sign of bad pivots.
TEST(BlockLu, LightBodiesBetweenHeavyOnesAndScaledJointsServe) {
  enum { rotor, generator, tower, shaft, bearing, brake };
  const Skeleton s{"drive train",
                   {{rotor, shaft},
                    {generator, shaft},
                    {generator, bearing},
                    {tower, bearing},
                    {generator, brake},
                    {tower, brake}},
                   {6, 6, 6, 5, 5, 1},
                   {shaft, bearing, brake}};
  for (const double scale : {1.0, 1e6, 1e13}) {
    for (unsigned seed = 1; seed <= 5; ++seed) {
      BlockMatrix A(s, seed);
      const auto make_body = [&](int body, double mass) {
        auto block = A.values.block(6 * body, 6 * body, 6, 6);
        block = mass * Eigen::MatrixXd(block * block.transpose());
      };
      make_body(rotor, 1e5);
      make_body(generator, 1e-1);
      make_body(tower, 1e6);
      A.values.bottomLeftCorner(11, 18) *= scale;
      A.values.topRightCorner(18, 11) = A.values.bottomLeftCorner(11, 18).transpose();
      A.refresh();
      BlockLu blocks(*A.matrix);
      ASSERT_TRUE(blocks.factor()) << scale << " " << seed;
      Eigen::VectorXd x = Eigen::VectorXd::LinSpaced(s.rows(), -1.0, 2.0);
      x.tail(11) /= scale;
      const Eigen::VectorXd b = A.values * x;
      const Eigen::VectorXd found = solve(blocks, b);
      const Eigen::VectorXd rest = (b - A.values * found).cwiseAbs();
      const Eigen::VectorXd size = A.values.cwiseAbs() * x.cwiseAbs();
      EXPECT_LT(rest.head(18).maxCoeff(), 1e-11 * size.head(18).maxCoeff()) << scale << " " << seed;
      EXPECT_LT(rest.tail(11).maxCoeff(), 1e-11 * size.tail(11).maxCoeff()) << scale << " " << seed;
      EXPECT_EQ(blocks.determinant().sign,
                Eigen::FullPivLU<Eigen::MatrixXd>(A.values).determinant() > 0.0 ? 1 : -1);
    }
  }
}

TEST(FindHosts, EachJointFindsABodyOfItsOwn) {
  // joints with five equations need one body each, and only one assignment does
  Skeleton s = bodies(40, false);
  for (const int joint : s.hollow) s.sizes[static_cast<std::size_t>(joint)] = 5;
  const std::vector<int> host = choose_hosts(*BlockMatrix(s).matrix);
  for (int i = 0; i < 40; ++i) {
    EXPECT_EQ(host[static_cast<std::size_t>(i)], -1);
    EXPECT_EQ(host[static_cast<std::size_t>(40 + i)], i);
  }
}

TEST(FindHosts, OneBodyMayServeTwoJointsAndOneMayHaveToWait) {
  // a body with joints to the ground of 3, 2 and 2 freedoms; the last is one too many
  Skeleton s{"star", {{0, 1}, {0, 2}, {0, 3}}, {6, 3, 2, 2}, {1, 2, 3}};
  const std::vector<int> host = choose_hosts(*BlockMatrix(s).matrix);
  EXPECT_EQ(std::ranges::count(host, 0), 2);
  EXPECT_EQ(host[0], -1);
  EXPECT_EQ(std::ranges::count(host, 1) + std::ranges::count(host, 2) + std::ranges::count(host, 3),
            1);
}

TEST(FindHosts, ScaleDoesNotMatter) {
  const Skeleton s = bodies(8, true);
  BlockMatrix A(s);
  const std::vector<int> host = choose_hosts(*A.matrix);
  for (int i = 0; i < s.rows(); ++i) {
    A.values.row(i) *= std::pow(10.0, i % 13 - 6);
    A.values.col(i) *= std::pow(10.0, i % 11 - 5);
  }
  A.refresh();
  EXPECT_EQ(choose_hosts(*A.matrix), host);
}

bool is_by_klu2(const GuardedBlockLu& guarded) {
  const std::vector<int> pivots = guarded.pivots();
  return !pivots.empty() && pivots.front() >= 0;
}

TEST(GuardedBlockLu, ChoosesOtherHostsWhereThoseAtHandDoNotServe) {
  const Skeleton s = chain(9, [](int) { return 6; });
  BlockMatrix A(s);
  GuardedBlockLu guarded(*A.matrix);
  ASSERT_TRUE(guarded.factor());
  const std::vector<int> before = guarded.pivots();
  guarded.remember_pivots();
  A.values.block(0, 0, 6, 6).setOnes();
  A.refresh();
  ASSERT_TRUE(guarded.factor());
  EXPECT_FALSE(is_by_klu2(guarded));
  EXPECT_NE(guarded.pivots(), before);
  const Eigen::VectorXd b = Eigen::VectorXd::LinSpaced(s.rows(), -1.0, 2.0);
  EXPECT_LT(relative_residual(A.values, solve(guarded, b), b), 1e-13);
  guarded.restore_pivots();
  EXPECT_EQ(guarded.pivots(), before);
}

TEST(GuardedBlockLu, Klu2TakesOverAndGoesOnUntilPivotsAreRestored) {
  const Skeleton s = chain(9, [](int) { return 6; });
  BlockMatrix A(s);
  const Eigen::VectorXd b = Eigen::VectorXd::LinSpaced(s.rows(), -1.0, 2.0);
  GuardedBlockLu guarded(*A.matrix);
  ASSERT_TRUE(guarded.factor());
  const Eigen::VectorXd by_blocks = solve(guarded, b);
  const std::vector<int> hosts = guarded.pivots();
  guarded.remember_pivots();

  ASSERT_TRUE(guarded.factor_anew());
  EXPECT_TRUE(is_by_klu2(guarded));
  const Eigen::VectorXd by_klu2 = solve(guarded, b);
  EXPECT_LT(relative_residual(A.values, by_klu2, b), 1e-13);
  ASSERT_TRUE(guarded.factor());
  EXPECT_TRUE(is_by_klu2(guarded));
  EXPECT_EQ(guarded.remark().find("2 of 2 factorisations by KLU2"), 0u);
  const std::vector<int> pivots = guarded.pivots();

  guarded.restore_pivots();
  EXPECT_EQ(guarded.pivots(), hosts);
  ASSERT_TRUE(guarded.factor());
  EXPECT_EQ(solve(guarded, b), by_blocks);

  GuardedBlockLu resumed(*A.matrix);
  ASSERT_TRUE(resumed.set_pivots(pivots));
  ASSERT_TRUE(resumed.factor());
  EXPECT_EQ(resumed.pivots(), pivots);
  EXPECT_EQ(solve(resumed, b), by_klu2);
  EXPECT_FALSE(resumed.set_pivots(std::vector<int>{1, 0}));
  ASSERT_TRUE(resumed.set_pivots({}));
  ASSERT_TRUE(resumed.factor());
  EXPECT_EQ(solve(resumed, b), by_blocks);
}

// Whoever factors in the end, what was begun for a right-hand side is finished.
TEST(GuardedBlockLu, FinishesWhatItBegan) {
  const Skeleton s = chain(9, [](int) { return 6; });
  BlockMatrix A(s);
  const Eigen::VectorXd b = Eigen::VectorXd::LinSpaced(s.rows(), -1.0, 2.0);
  const std::span<const double> of_b(b.data(), static_cast<std::size_t>(b.size()));
  GuardedBlockLu guarded(*A.matrix);
  const auto finish = [&] {
    Eigen::VectorXd x = b;
    guarded.finish({x.data(), static_cast<std::size_t>(x.size())});
    return x;
  };
  ASSERT_TRUE(guarded.factor_for(of_b));
  const Eigen::VectorXd x = finish();
  EXPECT_EQ(solve(guarded, b), x);
  // another solution in between
  ASSERT_TRUE(guarded.factor_for(of_b));
  solve(guarded, 2.0 * b);
  EXPECT_EQ(finish(), x);
  // other hosts, then KLU2
  A.values.block(0, 0, 6, 6).setOnes();
  A.refresh();
  ASSERT_TRUE(guarded.factor_for(of_b));
  EXPECT_LT(relative_residual(A.values, finish(), b), 1e-13);
  ASSERT_TRUE(guarded.factor_anew());
  ASSERT_TRUE(guarded.factor_for(of_b));
  EXPECT_TRUE(is_by_klu2(guarded));
  EXPECT_LT(relative_residual(A.values, finish(), b), 1e-13);
}

TEST(GuardedBlockLu, SingularMatricesLeaveNoTrace) {
  const Skeleton s = chain(9, [](int) { return 6; });
  BlockMatrix A(s);
  const Eigen::MatrixXd sound = A.values;
  GuardedBlockLu guarded(*A.matrix);
  for (const bool by_klu2 : {false, true}) {
    A.values = sound;
    A.refresh();
    ASSERT_TRUE(by_klu2 ? guarded.factor_anew() : guarded.factor());
    const std::vector<int> before = guarded.pivots();
    guarded.remember_pivots();
    A.values.row(20).setZero();
    A.refresh();
    EXPECT_FALSE(guarded.factor());
    EXPECT_EQ(guarded.pivots(), before);
    EXPECT_EQ(is_by_klu2(guarded), by_klu2);
    guarded.restore_pivots();
    EXPECT_EQ(guarded.pivots(), before);
  }
}

}  // namespace
}  // namespace culm::solver
