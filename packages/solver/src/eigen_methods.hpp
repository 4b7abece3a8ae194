/// The methods behind the eigensolvers: large eigenvalues nu of an operator that inverts.
#pragma once

#include <culm/base/error.hpp>

#include "shift_invert.hpp"

#include <exception>
#include <functional>

namespace culm::solver {

/// Below it whole matrices cost less than a Krylov space.
constexpr int small_problem = 250;

/// The name of the method in place of `Automatic`, where Arnoldi's method is one of them.
inline std::string general_method(const EigenSettings& settings, int size) {
  if (settings.solver == "Anasazi") return "Spectra";
  if (settings.solver != "Automatic") return settings.solver;
  return size <= small_problem || 6 * settings.count > size ? "Dense" : "Spectra";
}

/// The same for a symmetric pencil, which has a method with distributed vectors as well.
inline std::string symmetric_method(const EigenSettings& settings, int size,
                                    const parallel::Comm& comm) {
  if (settings.solver != "Automatic") return settings.solver;
  const std::string alone = general_method(settings, size);
  return alone == "Spectra" && comm.size() > 1 ? "Anasazi" : alone;
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
};

/// All of them, but for those that are zero. The operator between the range of B is a symmetric
/// matrix, whatever border A has.
InvertedPairs solve_dense(const ShiftedPencil& op);

/// The first `count` by size in the B-orthogonal complement of the columns of `found`: implicitly
/// restarted Lanczos of Spectra, alike on all ranks.
InvertedPairs solve_lanczos(const ShiftedPencil& op, int count, const Eigen::MatrixXd& found);

/// The same by block Krylov-Schur of Anasazi: vectors are distributed, and whole only at the end.
InvertedPairs solve_krylov_schur(const ShiftedPencil& op, int count, const Eigen::MatrixXd& found);

[[noreturn]] void throw_unconverged(int converged, int count, int restarts);
/// Of a Krylov space that is exhausted before it holds what is looked for.
[[noreturn]] void throw_broken_down();

/// Runs a method of a library, which may throw where a space is exhausted and numbers grow beyond
/// all bounds.
template <class Method>
auto guarded(const Method& method) {
  try {
    return method();
  } catch (const Error&) {
    throw;
  } catch (const std::exception&) {
    throw_broken_down();
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
};

/// All of them, from the matrix of the operator; by size, largest first, without those that are
/// zero.
GeneralPairs solve_dense(const Operator& op);

/// The first `count` by size: implicitly restarted Arnoldi of Spectra, alike on all ranks.
GeneralPairs solve_arnoldi(const Operator& op, int count);

}  // namespace culm::solver
