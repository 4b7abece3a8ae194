/// Distributed vectors as one array on rank 0, in global order.
#pragma once

#include <culm/assembly/tpetra.hpp>
#include <culm/parallel/comm.hpp>

#include <vector>

namespace culm::solver {

/// The plan of the gather is made once for all vectors with one map.
class RootedVector {
 public:
  RootedVector(const assembly::Map& map, const parallel::Comm& comm);

  /// Global number of each gathered row; on the root, and empty on one rank.
  const std::vector<std::size_t>& rows() const { return place_; }
  /// @param whole on the root only
  void gather(const assembly::Vector& piece, std::span<double> whole);
  /// The reverse.
  void scatter(std::span<const double> whole, assembly::Vector& piece);

 private:
  bool alone_;
  parallel::Funnel funnel_;
  std::vector<std::size_t> place_;
  std::vector<double> gathered_;
};

}  // namespace culm::solver
