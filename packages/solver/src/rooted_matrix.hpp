/// A copy of a distributed matrix on rank 0, in global order.
#pragma once

#include <culm/assembly/tpetra.hpp>
#include <culm/parallel/comm.hpp>

#include "rooted_vector.hpp"

#include <optional>
#include <vector>

namespace culm::solver {

/// The plan of the gather is made once, because the pattern never changes. On one rank the matrix
/// itself is used and nothing is copied.
class RootedMatrix {
 public:
  RootedMatrix(Teuchos::RCP<const assembly::CrsMatrix> matrix, const parallel::Comm& comm);

  /// Brings the present values to the root.
  void gather_values();
  /// The serial matrix; on the root only.
  const Teuchos::RCP<assembly::CrsMatrix>& matrix() const { return serial_; }
  /// Vectors of the serial matrix; on the root only.
  assembly::Vector& rhs() { return *rhs_; }
  assembly::Vector& solution() { return *solution_; }
  void gather_rhs(const assembly::Vector& b);
  void scatter_solution(assembly::Vector& x);

 private:
  void plan_gather();
  void build_serial(const std::vector<int>& counts, const std::vector<long long>& columns);

  Teuchos::RCP<const assembly::CrsMatrix> distributed_;
  parallel::Comm comm_;
  Teuchos::RCP<assembly::CrsMatrix> serial_;
  std::optional<assembly::Vector> rhs_;
  std::optional<assembly::Vector> solution_;
  parallel::Funnel value_funnel_;
  RootedVector rows_;
  std::vector<std::size_t> value_place_;  ///< gathered value -> value of the serial matrix
  std::vector<double> gathered_values_;
};

}  // namespace culm::solver
