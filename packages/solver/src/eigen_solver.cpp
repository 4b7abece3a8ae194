#include <culm/base/error.hpp>
#include <culm/solver/eigen_solver.hpp>

#include "eigen_methods.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

namespace culm::solver {
namespace {

// Below it whole matrices cost less than a Krylov space.
constexpr int small = 250;

void append(InvertedPairs& all, const InvertedPairs& more, Eigen::Index count) {
  const Eigen::Index before = all.nu.size();
  all.nu.conservativeResize(before + count);
  all.nu.tail(count) = more.nu.head(count);
  all.vectors.conservativeResize(more.vectors.rows(), before + count);
  all.vectors.rightCols(count) = more.vectors.leftCols(count);
}

// Values in the complement of those that are found, until they are all further from the shift.
InvertedPairs search(ShiftInvert& op, int count) {
  constexpr int probes = 2;
  InvertedPairs all = solve_spectra(op, count, Eigen::MatrixXd(op.size(), 0));
  const auto least = [&] { return all.nu.cwiseAbs().minCoeff(); };
  const Eigen::Index most = std::min<Eigen::Index>(op.size() / 3, 4 * count);
  while (all.nu.size() < most) {
    const InvertedPairs more = solve_spectra(op, probes, all.vectors);
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
void finish(ShiftInvert& op, Eigen::Ref<Eigen::VectorXd> x) {
  Eigen::VectorXd Bx(op.size());
  op.multiply_B(x, Bx);
  op.solve(Bx, x);
  op.multiply_B(x, Bx);
  x /= std::sqrt(x.dot(Bx));
}

}  // namespace

const std::vector<std::string>& eigen_solver_names() {
  static const std::vector<std::string> names = {"Automatic", "Spectra", "Dense"};
  return names;
}

EigenPairs solve_eigenproblem(const SymmetricPencil& pencil, const EigenSettings& settings,
                              const parallel::Comm& comm) {
  ShiftInvert op(pencil, settings, comm);
  EigenPairs result;
  result.solver = settings.solver;
  if (result.solver == "Automatic") {
    result.solver = op.size() <= small || 6 * settings.count > op.size() ? "Dense" : "Spectra";
  }
  InvertedPairs pairs = result.solver == "Dense" ? solve_dense(op) : search(op, settings.count);
  sort_by_size(pairs);
  const auto count = std::min<Eigen::Index>(pairs.nu.size(), settings.count);

  constexpr double eps = std::numeric_limits<double>::epsilon();
  Eigen::VectorXd Ax(op.size()), Bx(op.size());
  struct Found {
    double value, rounding;
    Eigen::Index column;
  };
  std::vector<Found> found;
  for (Eigen::Index i = 0; i < count; ++i) {
    Eigen::Ref<Eigen::VectorXd> x = pairs.vectors.col(i);
    finish(op, x);
    op.multiply_A(x, Ax);
    op.multiply_B(x, Bx);
    const double value = x.dot(Ax);  // Rayleigh quotient
    found.push_back({value, eps * op.size_of_A(x), i});
    const double terms = Ax.norm() + (std::abs(value) + std::abs(op.shift())) * Bx.norm();
    result.worst_residual = std::max(result.worst_residual, (Ax - value * Bx).norm() / terms);
  }
  std::sort(found.begin(), found.end(),
            [](const Found& a, const Found& b) { return a.value < b.value; });
  result.vectors.resize(op.size(), count);
  for (std::size_t i = 0; i < found.size(); ++i) {
    result.values.push_back(found[i].value);
    result.rounding.push_back(found[i].rounding);
    result.vectors.col(static_cast<Eigen::Index>(i)) = pairs.vectors.col(found[i].column);
  }
  return result;
}

}  // namespace culm::solver
