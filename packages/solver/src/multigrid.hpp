/// Smoothed aggregation over nodes, with a direct solver on the coarsest grid.
#pragma once

#include <culm/solver/linear_solver.hpp>

#include "block_smoother.hpp"

#include <memory>
#include <vector>

namespace culm::solver {

/// An approximate inverse by one cycle over grids of fewer and fewer nodes. Nodes next to unknowns
/// that are no motions – multipliers, signals – stay what they are on all grids, so that the direct
/// solver sees them. Symmetric where the matrix is. @source P. Vanek, J. Mandel, M. Brezina,
/// Algebraic multigrid by smoothed aggregation, 1996
class Multigrid {
 public:
  /// @param memory  what the factors of the coarsest matrix may take [B], on all ranks together,
  /// where a further grid would do as well. Collective, as all functions.
  Multigrid(const Teuchos::RCP<const assembly::CrsMatrix>& matrix, assembly::NodeMotions nodes,
            double memory, const parallel::Comm& comm);
  ~Multigrid();

  /// Whether the coarsest matrix has an inverse.
  bool is_regular() const { return is_regular_; }
  /// Whether nothing tells already that the matrix is not positive definite.
  bool may_be_definite() const { return may_be_definite_; }
  /// Takes new values of the matrix for the finest grid; the others stay.
  void refresh();
  /// x = M b.
  void apply(const assembly::Vector& b, assembly::Vector& x);
  /// y = A x on the finest grid.
  void multiply(const assembly::Vector& x, assembly::Vector& y) const;
  /// The direction in which the coarsest matrix is weakest, brought to the finest grid.
  void weakest_direction(assembly::Vector& v);
  /// Whether more memory would have saved a grid.
  bool lacks_memory() const { return lacks_memory_; }
  /// Unknowns of the grids, the finest first.
  std::vector<long long> sizes() const;

 private:
  struct Level;

  bool is_worth_factors(double memory, const parallel::Comm& comm);
  void cycle(std::size_t level, const assembly::Vector& b, assembly::Vector& x);
  void add_prolonged(std::size_t level, const assembly::Vector& coarse, assembly::Vector& x) const;

  std::vector<std::unique_ptr<Level>> levels_;
  std::unique_ptr<LinearSolver> coarsest_;
  Teuchos::RCP<const assembly::CrsMatrix> coarsest_matrix_;
  bool is_regular_ = false;
  bool lacks_memory_ = false;
  bool may_be_definite_ = true;
};

}  // namespace culm::solver
