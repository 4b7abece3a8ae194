#include "../src/patch_modes.hpp"

#include "../src/krylov.hpp"

#include <Eigen/Eigenvalues>
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <tuple>

namespace culm::solver {
namespace {

using assembly::CrsMatrix;
using assembly::Map;
using assembly::Vector;

// A square plate of n x n nodes one apart, each with a deflection w and slopes a, b: shear in the
// edges of its elements, (dw - mean slope)^2, and bending, which is so many times weaker, between
// all of their nodes. Held at one side.
struct Plate {
  Plate(int n, double bending, const parallel::Comm& on) : comm(on) {
    const auto ranks = assembly::ranks_of(comm);
    const int nodes = n * n;
    const int begin = nodes * comm.rank() / comm.size();
    const int end = nodes * (comm.rank() + 1) / comm.size();
    const auto all = static_cast<Tpetra::global_size_t>(3 * nodes);
    const auto map =
        Teuchos::rcp(new Map(all, static_cast<std::size_t>(3 * (end - begin)), 0, ranks));
    matrix = Teuchos::rcp(new CrsMatrix(map, 27));
    const auto add = [&](int row, int column, double value) {
      const long long global = column;
      if (map->isNodeGlobalElement(row)) matrix->insertGlobalValues(row, 1, &value, &global);
    };
    // k (sum of c_i u_i)^2, with zeros as well, so that blocks of nodes are full
    const auto spring = [&](double k, int p, int q, const Eigen::Matrix<double, 6, 1>& c) {
      for (int i = 0; i < 6; ++i) {
        for (int j = 0; j < 6; ++j) {
          add(3 * (i < 3 ? p : q) + i % 3, 3 * (j < 3 ? p : q) + j % 3, k * c[i] * c[j]);
        }
      }
    };
    for (int y = 0; y < n; ++y) {
      for (int x = 0; x < n; ++x) {
        const int node = x + n * y;
        const bool is_right = x + 1 < n, is_below = y + 1 < n;
        if (is_right) spring(1.0, node, node + 1, {-1.0, -0.5, 0.0, 1.0, -0.5, 0.0});
        if (is_below) spring(1.0, node, node + n, {-1.0, 0.0, -0.5, 1.0, 0.0, -0.5});
        for (const auto& [is_there, p, q] :
             {std::tuple{is_right, node, node + 1}, std::tuple{is_below, node, node + n},
              std::tuple{is_right && is_below, node, node + n + 1},
              std::tuple{is_right && is_below, node + 1, node + n}}) {
          if (!is_there) continue;
          spring(bending, p, q, {0.0, 1.0, 0.0, 0.0, -1.0, 0.0});
          spring(bending, p, q, {0.0, 0.0, 1.0, 0.0, 0.0, -1.0});
        }
        for (int i = 0; i < 3 && x == 0; ++i) add(3 * node + i, 3 * node + i, 1.0);
      }
    }
    matrix->fillComplete();
    motions.widths.assign(static_cast<std::size_t>(end - begin), 3);
    motions.rigid.setZero(3 * (end - begin), 6);
    for (int node = begin; node < end; ++node) {
      const Vec3 place(node % n, node / n, 0.0);
      motions.places.push_back(place);
      motions.normals.emplace_back(Vec3::UnitZ());
      // w in translation along z, w and slopes in rotations about x and y
      auto rigid = motions.rigid.middleRows<3>(3 * (node - begin));
      rigid(0, 2) = 1.0;
      rigid.col(3) << place.y(), 0.0, 1.0;
      rigid.col(4) << -place.x(), -1.0, 0.0;
    }
  }

  std::vector<bool> none() const { return std::vector<bool>(motions.widths.size()); }
  GridLevel grid() const { return {matrix, motions.widths, motions.rigid, comm}; }
  Vector vector(double wave) const {
    Vector v(assembly::rows_of(matrix->getRowMap()));
    for (std::size_t i = 0; i < v.rows().size(); ++i) {
      v.values()[i] = std::sin(1.0 + wave * static_cast<double>(v.rows().global(i)));
    }
    return v;
  }

  parallel::Comm comm;
  Teuchos::RCP<CrsMatrix> matrix;
  assembly::NodeMotions motions;
};

TEST(PatchModes, InvertTheirPatch) {
  // the matrix of one element on this rank alone, with the diagonal blocks of its nodes
  const Plate alone(2, 1e-3, parallel::Comm(MPI_COMM_SELF));
  Eigen::MatrixXd A = Eigen::MatrixXd::Zero(12, 12), D = A;
  const auto local = alone.matrix->getLocalMatrixHost();
  for (int i = 0; i < 12; ++i) {
    for (auto k = local.graph.row_map(static_cast<std::size_t>(i));
         k < local.graph.row_map(static_cast<std::size_t>(i + 1)); ++k) {
      const int j = local.graph.entries(k);
      A(i, j) += local.values(k);
      if (i / 3 == j / 3) D(i, j) += local.values(k);
    }
  }
  const Eigen::GeneralizedSelfAdjointEigenSolver<Eigen::MatrixXd> all(A, D);
  const Eigen::VectorXd v = all.eigenvectors().col(0);
  ASSERT_LT(all.eigenvalues()[0], 0.1);

  const Plate plate(2, 1e-3, parallel::Comm());
  const GridLevel grid = plate.grid();
  PatchModes modes(grid, plate.none(), plate.comm);
  EXPECT_EQ(modes.count(), (all.eigenvalues().array() < 0.4).count());
  Vector x = plate.vector(0.0), force(x.rows()), back(x.rows());
  for (std::size_t i = 0; i < x.rows().size(); ++i) {
    x.values()[i] = v[static_cast<Eigen::Index>(x.rows().global(i))];
  }
  grid.multiply(x, force);
  modes.add(force, back);
  back.update(-1.0, x);
  EXPECT_LT(back.largest(), 1e-6 * x.largest());  // single precision
}

TEST(PatchModes, AreSymmetricAndTheSameOnAnyNumberOfRanks) {
  const auto energies = [](const parallel::Comm& comm) {
    const Plate plate(8, 1e-3, comm);
    const GridLevel grid = plate.grid();
    PatchModes modes(grid, plate.none(), comm);
    const Vector a = plate.vector(1.3), b = plate.vector(0.7);
    Vector Ma(a.rows()), Mb(a.rows());
    modes.add(a, Ma);
    modes.add(b, Mb);
    const double ab = b.dot(Ma);
    EXPECT_NEAR(ab, a.dot(Mb), 1e-10 * std::abs(ab));
    EXPECT_GE(modes.count(), 49);  // one for each element
    return std::tuple{modes.count(), ab, a.dot(Ma)};
  };
  const auto [count, ab, aa] = energies(parallel::Comm());
  const auto [count_alone, ab_alone, aa_alone] = energies(parallel::Comm(MPI_COMM_SELF));
  EXPECT_EQ(count, count_alone);
  EXPECT_NEAR(ab, ab_alone, 1e-9 * std::abs(ab));
  EXPECT_NEAR(aa, aa_alone, 1e-9 * aa);
}

TEST(PatchModes, NoneWhereBendingIsStiff) {
  const Plate plate(8, 1.0, parallel::Comm());
  EXPECT_EQ(PatchModes(plate.grid(), plate.none(), plate.comm).count(), 0);
}

TEST(PatchModes, LeaveOutWhatIsCarried) {
  const Plate plate(2, 1e-3, parallel::Comm());
  std::vector<bool> carried = plate.none();
  if (plate.matrix->getRowMap()->isNodeGlobalElement(0)) carried.front() = true;
  EXPECT_EQ(PatchModes(plate.grid(), carried, plate.comm).count(), 0);
}

TEST(PatchModes, KeepIterationsFewWithoutShear) {
  const Plate plate(24, 1e-3, parallel::Comm());
  Multigrid multigrid(plate.matrix, plate.motions, std::numeric_limits<double>::infinity(),
                      plate.comm);
  const Vector b = plate.vector(1.0);
  Vector x(b.rows());
  const KrylovEnd end = conjugate_gradients(multigrid, b, x, {1e-8, 200});
  EXPECT_TRUE(end.converged);
  EXPECT_LT(end.iterations, 20);  // 43 with the blocks of nodes alone
}

}  // namespace
}  // namespace culm::solver
