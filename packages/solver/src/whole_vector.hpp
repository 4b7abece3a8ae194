/// Distributed vectors as one array on all ranks, in global order.
#pragma once

#include <culm/assembly/tpetra.hpp>
#include <culm/parallel/comm.hpp>

#include <Eigen/Core>

#include <vector>

namespace culm::solver {

/// Between a vector of a map and an array that every rank has whole.
class WholeVector {
 public:
  WholeVector(const assembly::Map& map, const parallel::Comm& comm);

  int size() const { return size_; }
  /// Global number of each row here.
  const std::vector<int>& rows() const { return rows_; }
  /// Takes the rows of this rank.
  void take(const Eigen::Ref<const Eigen::VectorXd>& whole, assembly::Vector& piece) const;
  /// Joins the pieces; collective, and exact.
  void join(const assembly::Vector& piece, Eigen::Ref<Eigen::VectorXd> whole) const;

 private:
  parallel::Comm comm_;
  int size_;
  std::vector<int> rows_;
};

}  // namespace culm::solver
