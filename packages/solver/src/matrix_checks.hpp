/// What every direct solver owes its callers: the residual of a solution, the weakest direction.
#pragma once

#include <culm/assembly/column_values.hpp>
#include <culm/assembly/tpetra.hpp>

#include <cmath>
#include <cstdint>
#include <functional>
#include <span>
#include <vector>

namespace culm::solver {

/// How well x solves A x = b. A row may hold nothing but rounding, so rows are not judged one by
/// one.
struct Residual {
  double largest = 0.0;  ///< |b - A x| in the maximum norm; infinite if a row is not finite
  double size = 0.0;     ///< largest sum of the absolute terms of a row
  double relative() const { return size > 0.0 ? largest / size : 0.0; }
};
/// Of this rank's rows. @param first_column of the rows, see assembly::first_columns @param r b -
/// A x, or empty
Residual residual(const assembly::CrsMatrix& A, std::span<const int> first_column,
                  const assembly::ColumnValues& x, std::span<const double> b, std::span<double> r);
/// Those of the rows of a matrix.
std::vector<int> first_columns(const assembly::CrsMatrix& A);

/// Residuals above it are more than rounding.
constexpr double good_residual = 1e-14;
/// Newton's method makes up for less. Above it pivots that were not chosen for this matrix are not
/// to be trusted; those that were leave little more than rounding.
constexpr double largest_residual_of_doubtful_pivots = 1e-12;

/// Refines a solution, up to twice and as long as it helps.
/// @param achieved its relative residual @param correct adds a correction @param check the relative
/// residual of the result @param undo takes the last correction back @return what is achieved
template <class Correct, class Check, class Undo>
double refine(double achieved, const Correct& correct, const Check& check, const Undo& undo) {
  for (int i = 0; i < 2 && achieved > good_residual && std::isfinite(achieved); ++i) {
    correct();
    const double refined = check();
    if (!(refined < achieved)) {
      undo();
      break;
    }
    achieved = refined;
  }
  return achieved;
}

/// Largest entry on this rank; infinite if one is not finite.
double largest_entry(const assembly::CrsMatrix& A);
/// A number that tells the values on this rank from others: equal ones have the same, others
/// another one, but for one case in 2^64.
std::uint64_t fingerprint(const assembly::CrsMatrix& A);

/// What makes an exactly singular matrix invertible and is far below every eigenvalue of a sound
/// one, over the largest entry.
constexpr double relative_shift = 1e-13;

/// A + shift 1, with the pattern of A.
Teuchos::RCP<assembly::CrsMatrix> shifted_copy(const assembly::CrsMatrix& A, double shift);

using Solve = std::function<void(const assembly::Vector& b, assembly::Vector& x)>;
/// Inverse iteration from a start vector without symmetry, the same in every run. Collective.
/// @param solve x = B^-1 b for a B close to A @param v of unit maximum norm @return |A v|
double inverse_iteration(const assembly::CrsMatrix& A, const Solve& solve, assembly::Vector& v);

}  // namespace culm::solver
