/// How far a matrix is from symmetry.
#pragma once

#include <culm/assembly/matrix.hpp>
#include <culm/parallel/comm.hpp>

#include <memory>

namespace culm::solver {

/// Largest |A_ij - A_ji| over the root of the product of the largest entries of rows i and j: what
/// is left of symmetry. Collective.
double asymmetry(const std::shared_ptr<const assembly::Matrix>& matrix, const parallel::Comm& comm);

/// The same of a matrix that is a small part of another one on the same rows: entries below
/// 1e-10 of the rows of that are rounding. Collective.
double asymmetry_within(const std::shared_ptr<const assembly::Matrix>& part,
                        const std::shared_ptr<const assembly::Matrix>& whole,
                        const parallel::Comm& comm);

}  // namespace culm::solver
