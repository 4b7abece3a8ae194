/// Distributed vectors as one array on all ranks, in global order.
#pragma once

#include <culm/assembly/vector.hpp>
#include <culm/parallel/comm.hpp>

#include <Eigen/Core>

#include <span>
#include <vector>

namespace culm::solver {

/// Between the values of this rank and an array that every rank has whole.
class WholeVector {
 public:
  WholeVector(const assembly::Rows& rows, const parallel::Comm& comm);

  int size() const { return size_; }
  /// Global number of each row here.
  const std::vector<int>& rows() const { return rows_; }
  /// Takes the rows of this rank.
  void take(const Eigen::Ref<const Eigen::VectorXd>& whole, std::span<double> piece) const;
  /// Joins the pieces; collective, and exact.
  void join(std::span<const double> piece, Eigen::Ref<Eigen::VectorXd> whole) const;

 private:
  parallel::Comm comm_;
  int size_;
  std::vector<int> rows_;
};

}  // namespace culm::solver
