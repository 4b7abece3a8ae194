#include <culm/solver/eigen_solver.hpp>

#include "eigen_methods.hpp"

#include <fmt/format.h>

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
      reduce_whole();
    } else {
      search();
      if (pencil_.is_symmetric && method_ != "Dense") search_copies();
    }
    return sorted();
  }

 private:
  void apply(const Eigen::Ref<const Eigen::VectorXd>& x, Eigen::Ref<Eigen::VectorXd> y) {
    Eigen::VectorXd Dx(x.size());
    inverse_.multiply(*pencil_.D, x, Dx);
    inverse_.solve(-Dx, y);
    remove_found(y);
  }

  Operator make_operator() {
    return {inverse_.size(), [this](const auto& x, auto y) { apply(x, y); }};
  }

  void clear() {
    nu_.clear();
    sign_.clear();
    complex_.clear();
    vectors_.resize(inverse_.size(), 0);
    K_vectors_.resize(inverse_.size(), 0);
  }

  void reduce_whole() {
    clear();
    add(solve_dense(make_operator()), 0.0);
    method_ = "Dense";
    are_all_ = true;
  }

  void remove_found(Eigen::Ref<Eigen::VectorXd> x) const {
    for (std::size_t i = 0; i < nu_.size(); ++i) {
      const auto at = static_cast<Eigen::Index>(i);
      x -= sign_[i] * K_vectors_.col(at).dot(x) * vectors_.col(at);
    }
  }

  // Complex values are left out, so more are asked for where there are some.
  void search() {
    const auto count = static_cast<std::size_t>(settings_.count);
    const int most = inverse_.size() - 2;
    for (int asked = settings_.count; asked <= 16 * settings_.count; asked *= 2) {
      clear();
      add(solve_arnoldi_or_dense(make_operator(), std::min(asked, most), method_, note_), 0.0);
      are_all_ = are_all_ || method_ == "Dense" || asked >= most;
      if (nu_.size() >= count || are_all_) return;
    }
  }

  // Copies of multiple values are missed by one search; see solve_eigenproblem.
  void search_copies() {
    while (!nu_.empty() && nu_.size() < 4U * static_cast<unsigned>(settings_.count)) {
      const auto before = nu_.size();
      double least = std::abs(nu_.front());
      for (double nu : nu_) least = std::min(least, std::abs(nu));
      const GeneralPairs more = solve_arnoldi(make_operator(), 2);
      if (more.nu.size() == 0) {
        if (inverse_.size() <= largest_dense) return reduce_whole();
        add_note(
            "the search for copies did not converge: a factor that is there twice may be "
            "listed once",
            note_);
        return;
      }
      if (note_.empty()) note_ = more.convergence.note();
      add(more, (1.0 - 1e-8) * least);
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
      if (size <= 1e3 * eps * largest) {
        are_all_ = are_all_ || least == 0.0;  // what is left is rounding of zero
        continue;
      }
      if (size < least) continue;
      if (std::abs(nu.imag()) > 1e-6 * size) {
        complex_.push_back(size);
        continue;
      }
      // two values that rounding made conjugate have one complex vector, and both its parts
      Eigen::VectorXd x = found.vectors.col(i).real();
      if (nu.imag() < 0.0) x = found.vectors.col(i).imag();
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
    result.note = note_;
    result.are_all = are_all_;
    const double last = order.empty() ? 0.0 : std::abs(nu_[order.back()]);
    const auto left_out =
        std::count_if(complex_.begin(), complex_.end(), [&](double size) { return size > last; });
    if (left_out > 0) {
      add_note(fmt::format("{} complex values next to zero were left out: they belong to flutter",
                           left_out),
               result.note);
    }
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
  std::vector<double> sign_;     // of x^T K x
  std::vector<double> complex_;  // sizes of complex values that were left out
  std::string note_;
  bool are_all_ = false;
  Eigen::MatrixXd vectors_;
  Eigen::MatrixXd K_vectors_;
};

}  // namespace

EigenPairs solve_buckling(const BucklingPencil& pencil, const EigenSettings& settings,
                          const parallel::Comm& comm) {
  return Buckling(pencil, settings, comm).solve();
}

}  // namespace culm::solver
