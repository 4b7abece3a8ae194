#include <culm/solver/eigen_solver.hpp>

#include "eigen_methods.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace culm::solver {
namespace {

using Complex = std::complex<double>;

// Share of inertia among the terms with a rate that is rounding.
constexpr double no_inertia = 1e-12;

// Share of the largest stiffness below which nothing resists a motion.
constexpr double unresisted = 1e-9;

double largest_entry(const assembly::Matrix& matrix, const parallel::Comm& comm) {
  double largest = 0.0;
  for (const double value : matrix.values()) largest = std::max(largest, std::abs(value));
  return comm.max(largest);
}

// Residual that no pair has. Infinite values are defective: rounding makes large finite ones of
// them, whose vectors solve nothing.
constexpr double largest_residual = 1e-6;

// y = A x of a real matrix.
Eigen::VectorXcd product(const ShiftInvert& inverse, const assembly::Matrix& A,
                         const Eigen::VectorXcd& x) {
  Eigen::VectorXd real(x.size()), imaginary(x.size());
  inverse.multiply(A, Eigen::VectorXd(x.real()), real);
  inverse.multiply(A, Eigen::VectorXd(x.imag()), imaginary);
  return real + Complex(0.0, 1.0) * imaginary;
}

// With z = (x, lambda x): (z', lambda z') = 1 / (lambda - s) in
//   -(K + s C + s^2 M) x' = M z_2 + (C + s M) z_1,   z_2' = z_1 + s x'
class Linearised {
 public:
  Linearised(const QuadraticPencil& pencil, const EigenSettings& settings,
             const parallel::Comm& comm)
      : pencil_(pencil),
        shift_(settings.shift),
        inverse_(combine({{1.0, pencil.K},
                          {settings.shift, pencil.C},
                          {settings.shift * settings.shift, pencil.M}}),
                 settings.linear_solver, comm),
        mass_(inverse_.size()),
        damping_(inverse_.size()),
        sum_(inverse_.size()) {}

  int size() const { return inverse_.size(); }
  const ShiftInvert& inverse() const { return inverse_; }

  void apply(const Eigen::Ref<const Eigen::VectorXd>& z, Eigen::Ref<Eigen::VectorXd> result) {
    const Eigen::Index n = size();
    sum_ = z.tail(n) + shift_ * z.head(n);
    inverse_.multiply(*pencil_.M, sum_, mass_);
    inverse_.multiply(*pencil_.C, z.head(n), damping_);
    sum_ = -mass_ - damping_;
    inverse_.solve(sum_, result.head(n));
    result.tail(n) = z.head(n) + shift_ * result.head(n);
  }

  // One more application takes away what has neither mass nor damping in a vector.
  Eigen::VectorXcd finish(const Eigen::VectorXcd& x, Complex value) {
    Eigen::VectorXd part(2 * size()), result(2 * size());
    Eigen::VectorXcd finished(size());
    part << x.real(), (value * x).real();
    apply(part, result);
    finished.real() = result.head(size());
    part << x.imag(), (value * x).imag();
    apply(part, result);
    finished.imag() = result.head(size());
    const double mass = finished.dot(product(inverse_, *pencil_.M, finished)).real();
    const double damping = std::abs(finished.dot(product(inverse_, *pencil_.C, finished)));
    // what moves no mass has a rate only
    const bool has_inertia = mass * std::max(std::abs(value), shift_) > no_inertia * damping;
    return finished / std::sqrt(has_inertia ? mass : damping);
  }

 private:
  const QuadraticPencil& pencil_;
  double shift_;
  ShiftInvert inverse_;
  Eigen::VectorXd mass_, damping_, sum_;
};

// The pairs next to the shift that solve the equations, by the size of their values.
void take(Linearised& problem, const QuadraticPencil& pencil, const EigenSettings& settings,
          const parallel::Comm& comm, const GeneralPairs& pairs, ComplexPairs& result) {
  const int n = problem.size();
  std::vector<std::pair<Complex, Eigen::Index>> found;
  for (Eigen::Index i = 0; i < pairs.nu.size(); ++i) {
    const Complex value = settings.shift + 1.0 / pairs.nu[i];
    if (value.imag() >= -1e-9 * std::abs(value)) found.emplace_back(value, i);
  }
  std::stable_sort(found.begin(), found.end(), [](const auto& a, const auto& b) {
    return std::abs(a.first) < std::abs(b.first);
  });

  constexpr double eps = std::numeric_limits<double>::epsilon();
  const double stiffness = largest_entry(*pencil.K, comm);
  result.values.clear();
  result.rounding.clear();
  result.worst_residual = 0.0;
  result.vectors.resize(n, 0);
  for (const auto& [value, column] : found) {
    if (result.vectors.cols() == settings.count) break;
    const Eigen::VectorXcd x = problem.finish(pairs.vectors.col(column).head(n), value);
    const Eigen::VectorXcd inertia = value * value * product(problem.inverse(), *pencil.M, x);
    const Eigen::VectorXcd rates = value * product(problem.inverse(), *pencil.C, x);
    const Eigen::VectorXcd rest = product(problem.inverse(), *pencil.K, x) + rates + inertia;
    const Eigen::VectorXd terms = problem.inverse().absolute(*pencil.K, x.cwiseAbs());
    double size = std::max(
        {terms.maxCoeff(), rates.lpNorm<Eigen::Infinity>(), inertia.lpNorm<Eigen::Infinity>()});
    // a motion that nothing resists has only rounding in its terms
    const double stiff = stiffness * x.lpNorm<Eigen::Infinity>();
    if (std::abs(value) <= settings.shift && size < unresisted * stiff) size = stiff;
    const double residual = rest.lpNorm<Eigen::Infinity>() / size;
    if (!(residual <= largest_residual)) continue;
    result.worst_residual = std::max(result.worst_residual, residual);
    result.values.push_back(value);
    result.rounding.push_back(eps * x.cwiseAbs().dot(terms));
    result.vectors.conservativeResize(Eigen::NoChange, result.vectors.cols() + 1);
    result.vectors.rightCols<1>() = x;
  }
}

}  // namespace

ComplexPairs solve_quadratic(const QuadraticPencil& pencil, const EigenSettings& settings,
                             const parallel::Comm& comm) {
  Linearised problem(pencil, settings, comm);
  const int n = problem.size();
  const Operator op{2 * n, [&](const auto& z, auto result) { problem.apply(z, result); }};
  ComplexPairs result;
  result.solver = general_method(settings, 2 * n);
  // both of a pair, and one more so that none is cut; what solves nothing is left out, so more
  for (int asked = 2 * settings.count + 2;; asked *= 2) {
    if (3 * asked > 2 * n && 2 * n <= largest_dense) result.solver = "Dense";
    const GeneralPairs pairs =
        result.solver == "Dense"
            ? solve_dense(op)
            : solve_arnoldi_or_dense(op, std::min(asked, 2 * n - 2), result.solver, result.note);
    take(problem, pencil, settings, comm, pairs, result);
    result.are_all = result.solver == "Dense" || asked >= 2 * n - 2;
    if (static_cast<int>(result.values.size()) == settings.count || result.are_all) return result;
    if (asked > 16 * settings.count) throw_broken_down();
  }
}

}  // namespace culm::solver
