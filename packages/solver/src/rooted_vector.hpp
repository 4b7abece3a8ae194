/// Distributed vectors as one array on rank 0, in global order.
#pragma once

#include <culm/assembly/vector.hpp>
#include <culm/parallel/comm.hpp>

#include <span>
#include <vector>

namespace culm::solver {

/// The plan of the gather is made once for all vectors of the same rows.
class RootedVector {
 public:
  RootedVector(const assembly::Rows& rows, const parallel::Comm& comm);

  /// Global number of each gathered row; on the root, and empty on one rank.
  const std::vector<std::size_t>& rows() const { return place_; }
  /// @param piece values of this rank @param whole on the root only
  void gather(std::span<const double> piece, std::span<double> whole);
  /// The reverse.
  void scatter(std::span<const double> whole, std::span<double> piece);

 private:
  bool alone_;
  parallel::Funnel funnel_;
  std::vector<std::size_t> place_;
  std::vector<double> gathered_;
};

}  // namespace culm::solver
