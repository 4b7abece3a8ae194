#include <culm/solver/eigen_solver.hpp>

#include "eigen_methods.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <optional>

namespace culm::solver {
namespace {

void append(InvertedPairs& all, const InvertedPairs& more, Eigen::Index count) {
  const Eigen::Index before = all.nu.size();
  all.nu.conservativeResize(before + count);
  all.nu.tail(count) = more.nu.head(count);
  all.vectors.conservativeResize(more.vectors.rows(), before + count);
  all.vectors.rightCols(count) = more.vectors.leftCols(count);
}

// Values in the complement of those that are found, until they are all further from the shift.
InvertedPairs search(const ShiftedPencil& op, int count) {
  constexpr int probes = 2;
  const int size = op.inverse.size();
  InvertedPairs all = solve_lanczos(op, count, Eigen::MatrixXd(size, 0));
  const auto least = [&] { return all.nu.cwiseAbs().minCoeff(); };
  const Eigen::Index most = std::min<Eigen::Index>(size / 3, 4 * count);
  while (all.nu.size() < most) {
    const InvertedPairs more = solve_lanczos(op, probes, all.vectors);
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
void finish(const ShiftedPencil& op, Eigen::Ref<Eigen::VectorXd> x) {
  Eigen::VectorXd Bx(x.size());
  op.inverse.multiply(*op.pencil.B, x, Bx);
  op.inverse.solve(Bx, x);
  op.inverse.multiply(*op.pencil.B, x, Bx);
  x /= std::sqrt(x.dot(Bx));
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

EigenPairs solve_at(const SymmetricPencil& pencil, const EigenSettings& settings,
                    const parallel::Comm& comm, bool may_move) {
  ShiftInvert inverse(combine({{1.0, pencil.A}, {-settings.shift, pencil.B}}),
                      settings.linear_solver, comm);
  const ShiftedPencil op{inverse, pencil, settings.shift};
  EigenPairs result;
  result.solver = method(settings, inverse.size());
  InvertedPairs pairs = result.solver == "Dense" ? solve_dense(op) : search(op, settings.count);
  sort_by_size(pairs);
  if (const auto shift = clear_shift(pairs.nu, settings.shift); shift && may_move) {
    EigenSettings moved = settings;
    moved.shift = *shift;
    return solve_at(pencil, moved, comm, false);
  }
  const auto count = std::min<Eigen::Index>(pairs.nu.size(), settings.count);

  constexpr double eps = std::numeric_limits<double>::epsilon();
  struct Found {
    double value, rounding;
    Eigen::Index column;
  };
  std::vector<Found> found;
  Eigen::VectorXd Ax(inverse.size()), Bx(inverse.size());
  for (Eigen::Index i = 0; i < count; ++i) {
    Eigen::Ref<Eigen::VectorXd> x = pairs.vectors.col(i);
    finish(op, x);
    inverse.multiply(*pencil.A, x, Ax);
    inverse.multiply(*pencil.B, x, Bx);
    const Eigen::VectorXd terms = inverse.absolute(*pencil.A, x);
    const double value = x.dot(Ax);  // Rayleigh quotient
    found.push_back({value, eps * x.cwiseAbs().dot(terms), i});
    result.worst_residual = std::max(
        result.worst_residual, (Ax - value * Bx).lpNorm<Eigen::Infinity>() / terms.maxCoeff());
  }
  std::sort(found.begin(), found.end(),
            [](const Found& a, const Found& b) { return a.value < b.value; });
  result.vectors.resize(inverse.size(), count);
  for (std::size_t i = 0; i < found.size(); ++i) {
    result.values.push_back(found[i].value);
    result.rounding.push_back(found[i].rounding);
    result.vectors.col(static_cast<Eigen::Index>(i)) = pairs.vectors.col(found[i].column);
  }
  return result;
}

}  // namespace

const std::vector<std::string>& eigen_solver_names() {
  static const std::vector<std::string> names = {"Automatic", "Spectra", "Dense"};
  return names;
}

EigenPairs solve_eigenproblem(const SymmetricPencil& pencil, const EigenSettings& settings,
                              const parallel::Comm& comm) {
  return solve_at(pencil, settings, comm, true);
}

}  // namespace culm::solver
