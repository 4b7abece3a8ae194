#include "prolongation.hpp"

#include <culm/math/types.hpp>

#include "exchange.hpp"

#include <Eigen/Dense>

#include <utility>

namespace culm::solver {
namespace {

using RowMajor = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

// Orthonormal Q and R with B = Q R; without columns that are combinations of others.
std::pair<Eigen::MatrixXd, Eigen::MatrixXd> orthonormalise(const Eigen::MatrixXd& B) {
  constexpr double dependent = 1e-10;  // share of a column that others leave
  Eigen::MatrixXd Q(B.rows(), 0);
  for (Eigen::Index column = 0; column < B.cols(); ++column) {
    Eigen::VectorXd rest = B.col(column);
    const double size = rest.norm();
    for (int pass = 0; pass < 2; ++pass) rest -= Q * (Q.transpose() * rest);
    const double left = rest.norm();
    if (!(left > dependent * size)) continue;
    Q.conservativeResize(Eigen::NoChange, Q.cols() + 1);
    Q.rightCols<1>() = rest / left;
  }
  return {Q, Q.transpose() * B};
}

}  // namespace

Prolongation join_rigidly(const GridLevel& grid, const Aggregates& aggregates,
                          const std::vector<bool>& carried, const parallel::Comm& comm) {
  std::vector<std::vector<int>> members(index(aggregates.count));
  for (int node = 0; node < grid.nodes(); ++node) {
    members[index(aggregates.of_node[index(node)])].push_back(node);
  }
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
      std::tie(bases[a].Q, bases[a].R) = orthonormalise(B);
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
    const Eigen::Map<const RowMajor> inverse(smoother.inverse(node), height, height);
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
