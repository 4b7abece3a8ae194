#include "prolongation.hpp"

#include <culm/math/types.hpp>

#include "exchange.hpp"

#include <Eigen/Dense>

#include <utility>

namespace culm::solver {
namespace {

using RowMajor = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

// Orthonormal Q and R with B = Q R; without columns that are combinations of others. Q spans
// further motions as well.
std::pair<Eigen::MatrixXd, Eigen::MatrixXd> orthonormalise(const Eigen::MatrixXd& B,
                                                           const Eigen::MatrixXd& further) {
  constexpr double dependent = 1e-10;  // share of a column that others leave
  Eigen::MatrixXd Q(B.rows(), 0);
  for (Eigen::Index column = 0; column < B.cols() + further.cols(); ++column) {
    Eigen::VectorXd rest = column < B.cols() ? B.col(column) : further.col(column - B.cols());
    const double size = rest.norm();
    for (int pass = 0; pass < 2; ++pass) rest -= Q * (Q.transpose() * rest);
    const double left = rest.norm();
    if (!(left > dependent * size)) continue;
    Q.conservativeResize(Eigen::NoChange, Q.cols() + 1);
    Q.rightCols<1>() = rest / left;
  }
  return {Q, Q.transpose() * B};
}

std::vector<std::vector<int>> members_of(const Aggregates& aggregates) {
  std::vector<std::vector<int>> members(index(aggregates.count));
  for (std::size_t node = 0; node < aggregates.of_node.size(); ++node) {
    members[index(aggregates.of_node[node])].push_back(static_cast<int>(node));
  }
  return members;
}

// How nodes of a shell move where it bends without shear, with one of three constant curvatures:
// each node as a body that stays with its mean plane. No columns where that has no meaning.
Eigen::MatrixXd bend(const std::vector<int>& members, const GridLevel& grid,
                     const Surface& surface) {
  if (surface.places.empty()) return {};
  Vec3 centre = Vec3::Zero(), normal = Vec3::Zero();
  Eigen::Index rows = 0;
  for (const int node : members) {
    if (surface.normals[index(node)].isZero(0.0)) return {};
    centre += surface.places[index(node)] / static_cast<double>(members.size());
    normal += surface.normals[index(node)];
    rows += grid.width(node);
  }
  if (normal.isZero(0.0)) return {};
  normal.normalize();
  const Vec3 e1 = normal.unitOrthogonal();
  const Vec3 e2 = normal.cross(e1);
  Eigen::MatrixXd bent(rows, 3);
  Eigen::Index at = 0;
  for (const int node : members) {
    const Vec3& place = surface.places[index(node)];
    const double x = e1.dot(place - centre), y = e2.dot(place - centre);
    Eigen::Matrix<double, 6, 3> motion;  // translation of what is in the origin, and rotation
    motion.bottomRows<3>() << -x * normal.cross(e1), -y * normal.cross(e2),
        -normal.cross(y * e1 + x * e2);
    motion.topRows<3>() << 0.5 * x * x * normal, 0.5 * y * y * normal, x * y * normal;
    for (int k = 0; k < 3; ++k) {
      motion.col(k).head<3>() -= motion.col(k).tail<3>().cross(place);
    }
    const int width = grid.width(node);
    bent.middleRows(at, width) = grid.rigid().middleRows(grid.first_column(node), width) * motion;
    at += width;
  }
  return bent;
}

}  // namespace

Prolongation join(const GridLevel& grid, const Aggregates& aggregates,
                  const std::vector<bool>& carried, const Surface& surface,
                  const parallel::Comm& comm) {
  const std::vector<std::vector<int>> members = members_of(aggregates);
  struct Basis {
    Eigen::MatrixXd Q, R;
  };
  std::vector<Basis> bases(members.size());
  Prolongation result;
  long long unknowns = 0;
  std::vector<long long> first_unknown;
  for (std::size_t a = 0; a < members.size(); ++a) {
    Eigen::Index rows = 0;
    for (int node : members[a]) rows += grid.width(node);
    Eigen::MatrixXd B(rows, 6);
    Eigen::Index at = 0;
    for (int node : members[a]) {
      const int width = grid.width(node);
      B.middleRows(at, width) = grid.rigid().middleRows(grid.first_column(node), width);
      at += width;
    }
    if (carried[index(members[a].front())]) {
      bases[a] = {Eigen::MatrixXd::Identity(rows, rows), B};
    } else {
      std::tie(bases[a].Q, bases[a].R) = orthonormalise(B, bend(members[a], grid, surface));
    }
    first_unknown.push_back(unknowns);
    result.widths.push_back(static_cast<int>(bases[a].Q.cols()));
    unknowns += bases[a].Q.cols();
  }
  result.begin = count_by_rank(unknowns, comm);
  const long long offset = result.begin[index(comm.rank())];
  result.rigid.resize(unknowns, 6);
  std::vector<Eigen::Index> next(members.size(), 0);
  for (int node = 0; node < grid.nodes(); ++node) {
    const std::size_t a = index(aggregates.of_node[index(node)]);
    const Eigen::MatrixXd& Q = bases[a].Q;
    result.rows.add_node(grid.width(node));
    double* block = result.rows.add_block(offset + first_unknown[a], static_cast<int>(Q.cols()));
    Eigen::Map<RowMajor>(block, grid.width(node), Q.cols()) =
        Q.middleRows(next[a], grid.width(node));
    next[a] += grid.width(node);
  }
  for (std::size_t a = 0; a < members.size(); ++a) {
    result.rigid.middleRows(first_unknown[a], bases[a].R.rows()) = bases[a].R;
  }
  return result;
}

NodeBlocks smooth(const NodeBlocks& rows, const GridLevel& grid, const BlockSmoother& smoother,
                  const parallel::Comm& comm) {
  const NodeBlocks theirs = import_nodes(rows, grid.begin(), grid.beside(), comm);
  const double damping = 4.0 / (3.0 * smoother.largest_eigenvalue());
  NodeBlocks smoothed;
  struct Sum {
    long long first_unknown;
    RowMajor value;
  };
  std::vector<Sum> sums;
  for (int node = 0; node < grid.nodes(); ++node) {
    const int height = grid.width(node);
    sums.clear();
    const auto find = [&](long long first_unknown, int width) -> RowMajor& {
      for (Sum& sum : sums) {
        if (sum.first_unknown == first_unknown) return sum.value;
      }
      return sums.emplace_back(Sum{first_unknown, RowMajor::Zero(height, width)}).value;
    };
    const auto columns = grid.rows().columns(node);
    const Eigen::Map<const RowMajor> matrix(grid.rows().values(node), height,
                                            static_cast<Eigen::Index>(columns.size()));
    for (std::size_t k = 0; k < columns.size() && !smoother.leaves(node);) {
      const int other = grid.node_of(columns[k]);
      const bool is_here = other < grid.nodes();
      const NodeBlocks& source = is_here ? rows : theirs;
      const std::size_t at = index(is_here ? other : other - grid.nodes());
      const int width = grid.width(other);
      const auto coupling = matrix.middleCols(static_cast<Eigen::Index>(k), width);
      for (std::size_t b = source.first[at]; b < source.first[at + 1]; ++b) {
        const NodeBlocks::Block& block = source.blocks[b];
        const Eigen::Map<const RowMajor> value(source.values.data() + block.value, width,
                                               block.width);
        find(block.first_unknown, block.width).noalias() += coupling.lazyProduct(value);
      }
      k += index(width);
    }
    const Eigen::MatrixXd inverse =
        Eigen::Map<const Eigen::MatrixXf>(smoother.inverse(node), height, height).cast<double>();
    for (Sum& sum : sums) sum.value = -damping * (inverse * sum.value);
    for (std::size_t b = rows.first[index(node)]; b < rows.first[index(node) + 1]; ++b) {
      const NodeBlocks::Block& block = rows.blocks[b];
      find(block.first_unknown, block.width) +=
          Eigen::Map<const RowMajor>(rows.values.data() + block.value, height, block.width);
    }
    smoothed.add_node(height);
    for (const Sum& sum : sums) {
      double* block = smoothed.add_block(sum.first_unknown, static_cast<int>(sum.value.cols()));
      Eigen::Map<RowMajor>(block, height, sum.value.cols()) = sum.value;
    }
  }
  return smoothed;
}

}  // namespace culm::solver
