/// Soft motions of four nodes that belong together.
#pragma once

#include <culm/parallel/comm.hpp>

#include "grid_level.hpp"

#include <vector>

namespace culm::solver {

/// What inverse blocks of nodes do not see: where an element of a shell is much longer than thick,
/// its nodes move without shear only together. A patch are four nodes that are all coupled, as
/// those of an element, with everything around them held; of its eigenvectors v, A v = lambda D v
/// with the diagonal blocks D of the nodes, it has those with small lambda, each as a subspace of
/// its own in an additive method. Patches of thick shells, and those of beams, have none.
/// @source J. Schoeberl, Multigrid methods for a parameter dependent problem in primal variables,
/// 1999: a smoother has to cover such motions by local ones
class PatchModes {
 public:
  /// Of the present values; later ones need not be the same. @param carried nodes of this rank
  /// that belong to no patch: next to equations, which would resist. Collective, as all functions.
  PatchModes(const GridLevel& grid, const std::vector<bool>& carried, const parallel::Comm& comm);

  /// How many there are on all ranks.
  long long count() const { return count_; }
  /// z += sum of v (v^T r) / (v^T A v).
  void add(const assembly::Vector& r, assembly::Vector& z);

 private:
  const GridLevel& grid_;
  RoundedMatrix modes_;  // a row for each, with v^T A v = 1, over the columns of the matrix
  long long count_ = 0;
  assembly::Vector columns_, sums_;  // of all local columns
  assembly::Vector sum_;
};

}  // namespace culm::solver
