#include <culm/solver/eigen_solver.hpp>

#include "eigen_methods.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace culm::solver {
namespace {

// T = -K^-1 D has the eigenvalues nu = 1 / mu. It is self-adjoint in the product x^T K y, which is
// definite on the motions that constraints allow where K is stable.
class Buckling {
 public:
  Buckling(const BucklingPencil& pencil, const EigenSettings& settings, const parallel::Comm& comm)
      : pencil_(pencil),
        settings_(settings),
        inverse_(combine({{1.0, pencil.K}}), settings.linear_solver, comm),
        method_(general_method(settings, inverse_.size())),
        vectors_(inverse_.size(), 0),
        K_vectors_(inverse_.size(), 0) {}

  EigenPairs solve() {
    if (method_ == "Dense") {
      add(solve_dense({inverse_.size(), [this](const auto& x, auto y) { apply(x, y); }}), 0.0);
    } else {
      search();
    }
    return sorted();
  }

 private:
  void apply(const Eigen::Ref<const Eigen::VectorXd>& x, Eigen::Ref<Eigen::VectorXd> y) {
    Eigen::VectorXd Dx(x.size());
    inverse_.multiply(*pencil_.D, x, Dx);
    inverse_.solve(-Dx, y);
    if (method_ != "Dense") remove_found(y);
  }

  void remove_found(Eigen::Ref<Eigen::VectorXd> x) const {
    for (std::size_t i = 0; i < nu_.size(); ++i) {
      const auto at = static_cast<Eigen::Index>(i);
      x -= sign_[i] * K_vectors_.col(at).dot(x) * vectors_.col(at);
    }
  }

  // Copies of multiple values are missed by one search; see solve_eigenproblem.
  void search() {
    const Operator op{inverse_.size(), [this](const auto& x, auto y) { apply(x, y); }};
    const int count = std::min(settings_.count, inverse_.size() - 2);
    add(solve_arnoldi(op, count), 0.0);
    while (pencil_.is_symmetric && !nu_.empty() && nu_.size() < 4U * static_cast<unsigned>(count)) {
      const auto before = nu_.size();
      double least = std::abs(nu_.front());
      for (double nu : nu_) least = std::min(least, std::abs(nu));
      add(solve_arnoldi(op, 2), (1.0 - 1e-8) * least);
      if (nu_.size() == before) return;
    }
  }

  // Keeps real values of at least this size, with vectors that are K-orthogonal to the others.
  void add(const GeneralPairs& found, double least) {
    constexpr double eps = std::numeric_limits<double>::epsilon();
    Eigen::VectorXd Kx(inverse_.size());
    const double largest = found.nu.size() > 0 ? found.nu.cwiseAbs().maxCoeff() : 0.0;
    for (Eigen::Index i = 0; i < found.nu.size(); ++i) {
      const std::complex<double> nu = found.nu[i];
      const double size = std::abs(nu);
      if (std::abs(nu.imag()) > 1e-6 * size || size < least || size <= 1e3 * eps * largest)
        continue;
      Eigen::VectorXd x = found.vectors.col(i).real();
      if (pencil_.is_symmetric) remove_found(x);
      inverse_.multiply(*pencil_.K, x, Kx);
      const double energy = x.dot(Kx);
      if (energy == 0.0) continue;
      const double factor = 1.0 / std::sqrt(std::abs(energy));
      vectors_.conservativeResize(Eigen::NoChange, vectors_.cols() + 1);
      K_vectors_.conservativeResize(Eigen::NoChange, vectors_.cols());
      vectors_.rightCols<1>() = factor * x;
      K_vectors_.rightCols<1>() = factor * Kx;
      sign_.push_back(energy > 0.0 ? 1.0 : -1.0);
      nu_.push_back(nu.real());
    }
  }

  EigenPairs sorted() {
    std::vector<std::size_t> order(nu_.size());
    for (std::size_t i = 0; i < order.size(); ++i) order[i] = i;
    std::stable_sort(order.begin(), order.end(), [this](std::size_t a, std::size_t b) {
      return std::abs(nu_[a]) > std::abs(nu_[b]);
    });
    // of pairs of both signs the positive one comes first, whatever rounding says
    for (std::size_t pass = 0; pass < order.size(); ++pass) {
      for (std::size_t i = 0; i + 1 < order.size(); ++i) {
        const double a = nu_[order[i]];
        const double b = nu_[order[i + 1]];
        if (a < 0.0 && b > 0.0 && std::abs(a + b) < 1e-6 * b) std::swap(order[i], order[i + 1]);
      }
    }
    order.resize(std::min(order.size(), static_cast<std::size_t>(settings_.count)));
    EigenPairs result;
    result.solver = method_;
    result.vectors.resize(inverse_.size(), static_cast<Eigen::Index>(order.size()));
    constexpr double eps = std::numeric_limits<double>::epsilon();
    Eigen::VectorXd Kx(inverse_.size()), Dx(inverse_.size());
    for (std::size_t i = 0; i < order.size(); ++i) {
      const auto x = vectors_.col(static_cast<Eigen::Index>(order[i]));
      const double value = 1.0 / nu_[order[i]];
      result.vectors.col(static_cast<Eigen::Index>(i)) = x;
      inverse_.multiply(*pencil_.K, x, Kx);
      inverse_.multiply(*pencil_.D, x, Dx);
      const Eigen::VectorXd terms = inverse_.absolute(*pencil_.K, x);
      result.values.push_back(value);
      result.rounding.push_back(eps * x.cwiseAbs().dot(terms));
      result.worst_residual = std::max(
          result.worst_residual, (Kx + value * Dx).lpNorm<Eigen::Infinity>() / terms.maxCoeff());
    }
    return result;
  }

  const BucklingPencil& pencil_;
  const EigenSettings& settings_;
  ShiftInvert inverse_;
  std::string method_;
  std::vector<double> nu_;
  std::vector<double> sign_;  // of x^T K x
  Eigen::MatrixXd vectors_;
  Eigen::MatrixXd K_vectors_;
};

}  // namespace

EigenPairs solve_buckling(const BucklingPencil& pencil, const EigenSettings& settings,
                          const parallel::Comm& comm) {
  return Buckling(pencil, settings, comm).solve();
}

}  // namespace culm::solver
