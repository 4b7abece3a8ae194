/// The methods behind the eigensolvers: large eigenvalues nu of an operator that inverts.
#pragma once

#include <culm/base/error.hpp>

#include "shift_invert.hpp"

#include <algorithm>
#include <array>
#include <exception>
#include <functional>

namespace culm::solver {

/// Below it whole matrices cost less than a Krylov space.
constexpr int small_problem = 250;

/// Where a Krylov space does not hold what is looked for, whole matrices up to this size do.
constexpr int largest_dense = 2000;

/// Numbers in the vectors of a space, 1.2 GB, beyond which it is not enlarged.
constexpr int largest_space = 150'000'000;

/// Vectors of the Krylov spaces for `count` values that are tried one after the other: values that
/// lie close together, and pairs that a space cuts, want larger ones.
inline std::array<int, 4> krylov_spaces(int count, int size) {
  const int first = std::max(2 * count + 1, count + 20);
  const int most = std::min(size, std::max(first, largest_space / std::max(1, size)));
  return {std::min(first, most), std::min(3 * first, most), std::min(9 * first, most),
          std::min(27 * first, most)};
}
/// Restarts of each.
constexpr int most_restarts = 40;
/// Of an eigenvalue in a Krylov space, relative.
constexpr double krylov_tolerance = 1e-11;

/// How far a Krylov method got.
struct Convergence {
  int converged = 0;  ///< values
  int space = 0;      ///< vectors of the last space that was tried
  int tried = 0;      ///< spaces

  /// For users: what the values took; empty if it was the first space.
  std::string note() const;
};

/// The name of the method in place of `Automatic`, where Arnoldi's method is one of them.
inline std::string general_method(const EigenSettings& settings, int size) {
  if (settings.solver == "Anasazi") return "Spectra";
  if (settings.solver != "Automatic") return settings.solver;
  return size <= small_problem || 6 * settings.count > size ? "Dense" : "Spectra";
}

/// The same for a symmetric pencil, which has a method with distributed vectors as well. That one
/// takes some three times as many solutions, so it serves where the vectors of a space, which each
/// process has whole with Spectra, are more than some 400 MB.
inline std::string symmetric_method(const EigenSettings& settings, int size,
                                    const parallel::Comm& comm) {
  constexpr double most_numbers = 5e7;
  constexpr double space = 4.0;  // vectors for each value
  if (settings.solver != "Automatic") return settings.solver;
  const std::string alone = general_method(settings, size);
  const bool is_large = space * settings.count * size > most_numbers;
  return alone == "Spectra" && is_large && comm.size() > 1 ? "Anasazi" : alone;
}

/// (A - shift B)^-1 B of a symmetric pencil, hence nu = 1 / (lambda - shift).
struct ShiftedPencil {
  ShiftInvert& inverse;
  const SymmetricPencil& pencil;
  double shift;
};

/// Some nu with vectors, columns with x^T B x = 1.
struct InvertedPairs {
  Eigen::VectorXd nu;
  Eigen::MatrixXd vectors;
  Convergence convergence = {};
};

/// All of them, but for those that are zero. The operator between the range of B is a symmetric
/// matrix, whatever border A has.
InvertedPairs solve_dense(const ShiftedPencil& op);

/// The first `count` by size in the B-orthogonal complement of the columns of `found`: implicitly
/// restarted Lanczos of Spectra, alike on all ranks. None if they do not converge.
InvertedPairs solve_lanczos(const ShiftedPencil& op, int count, const Eigen::MatrixXd& found);

/// The same by block Krylov-Schur of Anasazi: vectors are distributed, and whole only at the end.
InvertedPairs solve_krylov_schur(const ShiftedPencil& op, int count, const Eigen::MatrixXd& found);

[[noreturn]] void throw_unconverged(const Convergence& convergence, int count);
/// Of vectors that solve nothing.
[[noreturn]] void throw_broken_down();

/// Tries spaces until one holds `count` values. @param method of a library: from the size of the
/// space to the number of values that converged. It may throw where a space is exhausted and
/// numbers grow beyond all bounds.
template <class Method>
Convergence widen(int count, int size, const Method& method) {
  Convergence result;
  for (const int space : krylov_spaces(count, size)) {
    if (space == result.space) break;
    result.space = space;
    ++result.tried;
    try {
      result.converged = method(space);
    } catch (const Error&) {
      throw;
    } catch (const std::exception&) {
      result.converged = 0;
    }
    if (result.converged >= count) break;
  }
  return result;
}

/// Appends one note to another.
inline void add_note(const std::string& note, std::string& notes) {
  if (!note.empty() && notes.find(note) == std::string::npos) {
    notes += (notes.empty() ? "" : "; ") + note;
  }
}

/// Any real operator: y = T x.
struct Operator {
  int size = 0;
  std::function<void(const Eigen::Ref<const Eigen::VectorXd>& x, Eigen::Ref<Eigen::VectorXd> y)>
      apply;
};

struct GeneralPairs {
  Eigen::VectorXcd nu;
  Eigen::MatrixXcd vectors;
  Convergence convergence = {};
};

/// All of them, from the matrix of the operator; by size, largest first, without those that are
/// zero.
GeneralPairs solve_dense(const Operator& op);

/// The first `count` by size: implicitly restarted Arnoldi of Spectra, alike on all ranks. None if
/// they do not converge.
GeneralPairs solve_arnoldi(const Operator& op, int count);

/// The same, and all of them by `Dense` if they do not converge and the operator is not too large.
/// @param method name of the one that did it @param notes for users. Throws NumericalError.
GeneralPairs solve_arnoldi_or_dense(const Operator& op, int count, std::string& method,
                                    std::string& notes);

}  // namespace culm::solver
