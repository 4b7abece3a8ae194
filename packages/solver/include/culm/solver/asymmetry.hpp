/// Symmetry of small differences of large matrices.
#pragma once

#include <culm/assembly/matrix.hpp>
#include <culm/parallel/comm.hpp>

#include <memory>

namespace culm::solver {

/// As asymmetry, of a matrix that is a small part of another one on the same rows: entries below
/// 1e-10 of the rows of that are rounding. Collective.
double asymmetry_within(const std::shared_ptr<const assembly::Matrix>& part,
                        const std::shared_ptr<const assembly::Matrix>& whole,
                        const parallel::Comm& comm);

}  // namespace culm::solver
