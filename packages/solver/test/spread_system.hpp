/// Matrices with the graphs of slender models whose blocks are spread over the ranks.
#pragma once

#include <culm/assembly/matrix.hpp>
#include <culm/assembly/vector.hpp>
#include <culm/parallel/comm.hpp>

#include "skeletons.hpp"

#include <Eigen/Core>
#include <Eigen/SparseCore>

#include <functional>
#include <memory>
#include <vector>

namespace culm::solver {

using assembly::Matrix;
using assembly::Rows;
using assembly::Vector;

// A matrix with the pattern of a skeleton, whose blocks are spread over the ranks.
class SpreadSystem {
 public:
  using OwnerOf = std::function<int(int block, int blocks, int ranks)>;

  SpreadSystem(const Skeleton& s, const OwnerOf& owner_of, unsigned seed = 1)
      : dense(random_values(s, seed)),
        rows(own_rows(s, owner_of, comm), comm),
        matrix(std::make_shared<Matrix>(rows, with_pattern(s, dense))) {}

  // The values again, after they have been changed.
  void refresh() const {
    std::size_t k = 0;
    matrix->each_entry([&](std::size_t row, long long column, double) {
      matrix->values()[k++] = dense(rows.global(row), column);
    });
  }

  Vector distribute(const Eigen::VectorXd& whole) const {
    Vector v(rows);
    for (std::size_t i = 0; i < rows.size(); ++i) v.values()[i] = whole[rows.global(i)];
    return v;
  }
  double difference(const Vector& v, const Eigen::VectorXd& whole) const {
    Vector d = distribute(whole);
    d.update(1.0, v, -1.0);
    return d.largest();
  }

  parallel::Comm comm;
  Eigen::MatrixXd dense;
  Rows rows;
  std::shared_ptr<Matrix> matrix;

 private:
  static std::vector<long long> own_rows(const Skeleton& s, const OwnerOf& owner_of,
                                         const parallel::Comm& comm) {
    std::vector<long long> mine;
    const std::vector<int> block_of = s.block_of_row();
    for (int row = 0; row < s.rows(); ++row) {
      const int blocks = static_cast<int>(s.sizes.size());
      if (owner_of(block_of[row], blocks, comm.size()) == comm.rank()) mine.push_back(row);
    }
    return mine;
  }
  static Eigen::SparseMatrix<double> with_pattern(const Skeleton& s, const Eigen::MatrixXd& dense) {
    const std::vector<int> block_of = s.block_of_row();
    std::vector<Eigen::Triplet<double>> entries;
    for (int i = 0; i < s.rows(); ++i) {
      for (int j = 0; j < s.rows(); ++j) {
        if (s.couples(block_of[i], block_of[j])) entries.emplace_back(i, j, dense(i, j));
      }
    }
    Eigen::SparseMatrix<double> sparse(s.rows(), s.rows());
    sparse.setFromTriplets(entries.begin(), entries.end());
    return sparse;
  }
};

inline int in_pieces(int block, int blocks, int ranks) { return block * ranks / blocks; }
inline int in_turn(int block, int, int ranks) { return block % ranks; }
inline int all_on_the_last(int, int, int ranks) { return ranks - 1; }

}  // namespace culm::solver
