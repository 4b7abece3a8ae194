#include <culm/solver/eigen_solver.hpp>

#include "eigen_methods.hpp"
#include "multiple_values.hpp"

#include <Eigen/Dense>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <optional>

namespace culm::solver {
namespace {

// Found beside those that are wanted: the last vectors of a space are the least exact.
constexpr int guards = 2;

void append(InvertedPairs& all, const InvertedPairs& more, Eigen::Index count) {
  const Eigen::Index before = all.nu.size();
  all.nu.conservativeResize(before + count);
  all.nu.tail(count) = more.nu.head(count);
  all.vectors.conservativeResize(more.vectors.rows(), before + count);
  all.vectors.rightCols(count) = more.vectors.leftCols(count);
}

// Values in the complement of those that are found, until they are all further from the shift.
// None if they do not converge.
template <class Method>
InvertedPairs search(const ShiftedPencil& op, int count, const Method& method, std::string& notes) {
  constexpr int probes = 2;
  const int size = op.inverse.size();
  const int wanted = count + guards;
  if (wanted > size / 3) return {};
  InvertedPairs all = method(op, wanted, Eigen::MatrixXd(size, 0));
  if (all.nu.size() == 0) return all;
  add_note(all.convergence.note(), notes);
  const auto least = [&] { return all.nu.cwiseAbs().minCoeff(); };
  const Eigen::Index most = std::min<Eigen::Index>(size / 3, 4 * count);
  while (all.nu.size() < most) {
    const InvertedPairs more = method(op, probes, all.vectors);
    if (more.nu.size() == 0) return more;
    if (notes.empty()) notes = more.convergence.note();
    const Eigen::Index missed = (more.nu.array().abs() > (1.0 - 1e-8) * least()).count();
    if (missed == 0) break;
    append(all, more, missed);
    if (missed < probes) break;
  }
  return all;
}

void sort_by_size(InvertedPairs& pairs) {
  std::vector<Eigen::Index> order(static_cast<std::size_t>(pairs.nu.size()));
  std::iota(order.begin(), order.end(), Eigen::Index{0});
  std::stable_sort(order.begin(), order.end(), [&](Eigen::Index a, Eigen::Index b) {
    return std::abs(pairs.nu[a]) > std::abs(pairs.nu[b]);
  });
  pairs = {Eigen::VectorXd(pairs.nu(order)), Eigen::MatrixXd(pairs.vectors(Eigen::all, order))};
}

// One more application of the operator takes away what has no B in a vector and is no part of it.
// But it enlarges what is left of vectors with larger nu, so the vectors are those of the operator
// within the span of all; real ones also where rounding made a complex pair of two.
InvertedPairs finish(const ShiftedPencil& op, Eigen::MatrixXd vectors) {
  const auto product = [&](const auto& x) {
    Eigen::VectorXd Bx(x.size());
    op.inverse.multiply(*op.pencil.B, x, Bx);
    return Bx;
  };
  Eigen::MatrixXd B_vectors(vectors.rows(), vectors.cols());
  Eigen::MatrixXd images(vectors.rows(), vectors.cols());
  for (Eigen::Index i = 0; i < vectors.cols(); ++i) {
    auto x = vectors.col(i);
    op.inverse.solve(product(x), x);
    x /= std::sqrt(x.dot(product(x)));
    B_vectors.col(i) = product(x);
    op.inverse.solve(B_vectors.col(i), images.col(i));
  }
  const Eigen::MatrixXd S = B_vectors.transpose() * images;
  const Eigen::MatrixXd G = B_vectors.transpose() * vectors;
  const Eigen::GeneralizedSelfAdjointEigenSolver<Eigen::MatrixXd> within(0.5 * (S + S.transpose()),
                                                                         0.5 * (G + G.transpose()));
  return {within.eigenvalues(), vectors * within.eigenvectors()};
}

// Values much nearer to the shift than the others, as those of rigid motions are, leave rounding in
// the vectors of the others, and finish() enlarges it by the ratio of their distances: then a shift
// below them, away by a tenth of the distance of the others. Values are sorted.
std::optional<double> clear_shift(const Eigen::VectorXd& nu, double shift) {
  constexpr double gap = 1e2;
  for (Eigen::Index i = 1; i < nu.size(); ++i) {
    if (std::abs(nu[i - 1]) > gap * std::abs(nu[i])) return shift - 0.1 / std::abs(nu[i]);
  }
  return std::nullopt;
}

constexpr const char* reduced_whole =
    "the Krylov space did not hold the eigenvalues, so whole matrices were reduced";

// By the method of the result, or else by whole matrices.
InvertedPairs solve(const ShiftedPencil& op, int count, EigenPairs& result) {
  InvertedPairs pairs;
  if (result.solver != "Dense") {
    pairs = result.solver == "Anasazi" ? search(op, count, solve_krylov_schur, result.note)
                                       : search(op, count, solve_lanczos, result.note);
    // where all values are one, what is found may be no number
    if (pairs.nu.size() > 0 && pairs.nu.allFinite() && pairs.vectors.allFinite()) return pairs;
    if (op.inverse.size() > largest_dense) throw_unconverged(pairs.convergence, count);
    add_note(reduced_whole, result.note);
    result.solver = "Dense";
  }
  return solve_dense(op);
}

EigenPairs solve_at(const SymmetricPencil& pencil, const EigenSettings& settings,
                    const parallel::Comm& comm, bool may_move) {
  ShiftInvert inverse(combine({{1.0, pencil.A}, {-settings.shift, pencil.B}}),
                      settings.linear_solver, comm);
  const ShiftedPencil op{inverse, pencil, settings.shift};
  EigenPairs result;
  result.solver = symmetric_method(settings, inverse.size(), comm);
  InvertedPairs pairs = solve(op, settings.count, result);
  sort_by_size(pairs);
  // what the operator makes of vectors without B is rounding
  constexpr double eps = std::numeric_limits<double>::epsilon();
  const Eigen::Index finite =
      (pairs.nu.array().abs() > 1e2 * eps * pairs.nu.cwiseAbs().maxCoeff()).count();
  if (finite == 0) throw_broken_down();
  result.are_all = result.solver == "Dense" || finite < pairs.nu.size();
  pairs = {pairs.nu.head(finite), pairs.vectors.leftCols(finite)};
  if (const auto shift = clear_shift(pairs.nu, settings.shift); shift && may_move) {
    EigenSettings moved = settings;
    moved.shift = *shift;
    return solve_at(pencil, moved, comm, false);
  }
  const auto kept = std::min<Eigen::Index>(pairs.nu.size(), settings.count + guards);
  pairs = finish(op, pairs.vectors.leftCols(kept));
  sort_by_size(pairs);
  const auto count = std::min<Eigen::Index>(kept, settings.count);

  struct Found {
    double value, rounding;
    Eigen::Index column;
  };
  std::vector<Found> found;
  Eigen::VectorXd Ax(inverse.size()), Bx(inverse.size());
  for (Eigen::Index i = 0; i < count; ++i) {
    const Eigen::VectorXd x = pairs.vectors.col(i);
    // motions that nothing resists, such as those of a ship across the sea, have no A
    const Eigen::VectorXd size =
        inverse.absolute(*pencil.A, x) + std::abs(settings.shift) * inverse.absolute(*pencil.B, x);
    found.push_back({inverse.quotient(*pencil.A, x), eps * x.cwiseAbs().dot(size), i});
  }
  std::sort(found.begin(), found.end(),
            [](const Found& a, const Found& b) { return a.value < b.value; });
  result.vectors.resize(inverse.size(), count);
  for (std::size_t i = 0; i < found.size(); ++i) {
    result.values.push_back(found[i].value);
    result.rounding.push_back(found[i].rounding);
    result.vectors.col(static_cast<Eigen::Index>(i)) = pairs.vectors.col(found[i].column);
  }
  align_multiple(result);
  for (std::size_t i = 0; i < found.size(); ++i) {
    const Eigen::VectorXd x = result.vectors.col(static_cast<Eigen::Index>(i));
    inverse.multiply(*pencil.A, x, Ax);
    inverse.multiply(*pencil.B, x, Bx);
    const double size = inverse.absolute(*pencil.A, x).maxCoeff() +
                        std::abs(settings.shift) * inverse.absolute(*pencil.B, x).maxCoeff();
    result.worst_residual = std::max(result.worst_residual,
                                     (Ax - result.values[i] * Bx).lpNorm<Eigen::Infinity>() / size);
  }
  constexpr double useless = 1e-3;  // sound vectors have 1e-8 and less
  if (result.worst_residual <= useless) return result;
  // of values that are all one a space that is exhausted may give numbers that mean nothing
  if (result.solver == "Dense" || inverse.size() > largest_dense) throw_broken_down();
  EigenSettings whole = settings;
  whole.solver = "Dense";
  result = solve_at(pencil, whole, comm, may_move);
  add_note(reduced_whole, result.note);
  return result;
}

}  // namespace

const std::vector<std::string>& eigen_solver_names() {
  static const std::vector<std::string> names = {"Automatic", "Spectra", "Anasazi", "Dense"};
  return names;
}

const std::vector<std::string>& buckling_solver_names() {
  static const std::vector<std::string> names = {"Automatic", "Spectra", "Dense"};
  return names;
}

EigenPairs solve_eigenproblem(const SymmetricPencil& pencil, const EigenSettings& settings,
                              const parallel::Comm& comm) {
  return solve_at(pencil, settings, comm, true);
}

}  // namespace culm::solver
