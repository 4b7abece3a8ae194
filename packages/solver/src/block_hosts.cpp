#include "block_hosts.hpp"

#include <culm/math/types.hpp>

#include "blocks.hpp"
#include "elimination_groups.hpp"

#include <Eigen/Dense>

#include <algorithm>
#include <numeric>

namespace culm::solver {
namespace {

constexpr double smallest_pivot = 1e-6;
constexpr int scalings = 8;  // each takes the square root of what is out of scale

// Largest entry of every row and column to 1, nearly.
void equilibrate(Eigen::MatrixXd& A) {
  const auto factors = [](Eigen::VectorXd largest) -> Eigen::VectorXd {
    return (largest.array() > 0.0).select(largest.array().rsqrt(), 1.0);
  };
  for (int i = 0; i < scalings; ++i) {
    const Eigen::VectorXd rows = factors(A.cwiseAbs().rowwise().maxCoeff());
    const Eigen::VectorXd columns = factors(A.cwiseAbs().colwise().maxCoeff());
    A = rows.asDiagonal() * A * columns.asDiagonal();
  }
}

class Parts {
 public:
  explicit Parts(const BlockRows& rows) : rows_(rows), blocks_(find_blocks(rows)) {
    first_row_.resize(blocks_.sizes.size());
    std::exclusive_scan(blocks_.sizes.begin(), blocks_.sizes.end(), first_row_.begin(), 0);
    place_.resize(blocks_.rows.size(), -1);
  }

  std::vector<int> find_hosts(int first_kept) {
    const parallel::Graph graph = couple(blocks_, block_of_row(blocks_));
    return solver::find_hosts(graph, [&](std::span<const int> blocks) {
      const auto kept = std::ranges::count_if(blocks, [&](int b) { return b >= first_kept; });
      if (kept > 0) return blocks.size() == 1;  // needs no host and is none
      return is_regular(gather(blocks));
    });
  }

 private:
  Eigen::MatrixXd gather(std::span<const int> blocks) {
    int size = 0;
    for (int block : blocks)
      size = for_rows(block, size, [&](int row, int at) { place_[index(row)] = at; });
    Eigen::MatrixXd part = Eigen::MatrixXd::Zero(size, size);
    for (int block : blocks) {
      for_rows(block, 0, [&](int row, int) {
        rows_.for_entries(row, [&](int other, std::size_t source) {
          const int column = place_[index(other)];
          if (column >= 0) part(place_[index(row)], column) = rows_.value(source);
        });
      });
    }
    for (int block : blocks) for_rows(block, 0, [&](int row, int) { place_[index(row)] = -1; });
    return part;
  }

  template <class Visit>
  int for_rows(int block, int at, const Visit& visit) const {
    for (int i = 0; i < blocks_.sizes[index(block)]; ++i) visit(first_row_[index(block)] + i, at++);
    return at;
  }

  static bool is_regular(Eigen::MatrixXd part) {
    if (!part.allFinite()) return false;
    equilibrate(part);
    const Eigen::FullPivLU<Eigen::MatrixXd> lu(part);
    const auto pivots = lu.matrixLU().diagonal().cwiseAbs();
    return pivots.minCoeff() > smallest_pivot * lu.maxPivot();
  }

  const BlockRows& rows_;
  Blocks blocks_;
  std::vector<int> first_row_;
  std::vector<int> place_;  // of the rows of a part; else -1
};

}  // namespace

std::vector<int> choose_hosts(const BlockRows& rows, int first_kept) {
  return Parts(rows).find_hosts(first_kept);
}

}  // namespace culm::solver
