#include <culm/solver/eigen_solver.hpp>

#include "eigen_methods.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

namespace culm::solver {
namespace {

using Complex = std::complex<double>;

constexpr double eps = std::numeric_limits<double>::epsilon();

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

// With z = (x, lambda x / u): (z', lambda z') = 1 / (lambda - s) in
//   -(K + s C + s^2 M) x' = M u z_2 + (C + s M) z_1,   z_2' = (z_1 + s x') / u
// The unit u is near the lowest lambda, so that both parts are of one size: else one of them is
// rounding beside the other where frequencies are high.
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
        sum_(inverse_.size()) {
    choose_unit();
  }

  int size() const { return inverse_.size(); }
  const ShiftInvert& inverse() const { return inverse_; }

  void apply(const Eigen::Ref<const Eigen::VectorXd>& z, Eigen::Ref<Eigen::VectorXd> result) {
    const Eigen::Index n = size();
    sum_ = unit_ * z.tail(n) + shift_ * z.head(n);
    inverse_.multiply(*pencil_.M, sum_, mass_);
    inverse_.multiply(*pencil_.C, z.head(n), damping_);
    sum_ = -mass_ - damping_;
    inverse_.solve(sum_, result.head(n));
    result.tail(n) = (z.head(n) + shift_ * result.head(n)) / unit_;
  }

  // One more application takes away what has neither mass nor damping in a vector.
  Eigen::VectorXcd finish(const Eigen::VectorXcd& x, Complex value) {
    Eigen::VectorXd part(2 * size()), result(2 * size());
    Eigen::VectorXcd finished(size());
    part << x.real(), (value / unit_ * x).real();
    apply(part, result);
    finished.real() = result.head(size());
    part << x.imag(), (value / unit_ * x).imag();
    apply(part, result);
    finished.imag() = result.head(size());
    const double mass = finished.dot(product(inverse_, *pencil_.M, finished)).real();
    const double damping = std::abs(finished.dot(product(inverse_, *pencil_.C, finished)));
    // what moves no mass has a rate only
    const bool has_inertia = mass * std::max(std::abs(value), shift_) > no_inertia * damping;
    return finished / std::sqrt(has_inertia ? mass : damping);
  }

  // What is free of a motion: each application leaves of all others a tenth or less.
  Eigen::VectorXcd free_part(Eigen::VectorXcd x) {
    constexpr int applications = 12;
    for (int i = 0; i < applications; ++i) x = finish(x, 0.0);
    return x;
  }

 private:
  // By a few steps of the power method for 1 / lambda^2; a power of two, which rounds nothing.
  void choose_unit() {
    constexpr int steps = 4;
    Eigen::VectorXd x(size());
    for (Eigen::Index i = 0; i < x.size(); ++i) x[i] = std::sin(static_cast<double>(i) + 1.0);
    inverse_.multiply(*pencil_.M, x, mass_);
    for (int i = 0; i < steps; ++i) {
      const double before = x.dot(mass_);
      inverse_.solve(mass_, x);
      inverse_.multiply(*pencil_.M, x, mass_);
      const double growth = std::sqrt(x.dot(mass_) / before);
      if (!std::isfinite(growth) || growth == 0.0) return;
      x /= growth;
      mass_ /= growth;
      unit_ = std::exp2(std::round(-0.5 * std::log2(growth)));
    }
  }

  const QuadraticPencil& pencil_;
  double shift_;
  double unit_ = 1.0;
  ShiftInvert inverse_;
  Eigen::VectorXd mass_, damping_, sum_;
};

// Motions that nothing resists. Without brakes each is a double value at zero with one vector only:
// it is found twice, and the vectors of several may all be alike.
class FreeMotions {
 public:
  FreeMotions(Linearised& problem, const assembly::Matrix& M) : problem_(problem), M_(M) {}

  // Another one than those before, none if there are no more. @param x  where it may be found
  std::optional<Eigen::VectorXcd> next(const Eigen::VectorXcd& x) {
    for (const Eigen::VectorXcd& start : {x, any_start()}) {
      Eigen::VectorXcd rest = problem_.free_part(start);
      for (const auto& [vector, M_vector] : found_) rest -= M_vector.dot(rest) * vector;
      const double mass = rest.dot(product(problem_.inverse(), M_, rest)).real();
      constexpr double rest_of_others = 1e-4;  // of a mass of one
      if (!(mass > rest_of_others)) continue;
      rest /= std::sqrt(mass);
      found_.emplace_back(rest, product(problem_.inverse(), M_, rest));
      return rest;
    }
    return std::nullopt;
  }

 private:
  // With a part in all motions, another one each time, and alike on all ranks.
  Eigen::VectorXcd any_start() const {
    Eigen::VectorXcd start(problem_.size());
    const double first = 1.0 + static_cast<double>(found_.size());
    for (Eigen::Index i = 0; i < start.size(); ++i) {
      start[i] = std::sin(first + 12.9898 * first * static_cast<double>(i));
    }
    return start;
  }

  Linearised& problem_;
  const assembly::Matrix& M_;
  std::vector<std::pair<Eigen::VectorXcd, Eigen::VectorXcd>> found_;
};

// Free motions lie right at a shift next to zero, and twice: what rounding makes of the vectors of
// all others grows with the square of how much further these are. Then a shift by a tenth of the
// distance of the next one; none where that is not known or not needed.
std::optional<double> clear_shift(const Eigen::VectorXcd& nu, double shift) {
  constexpr double gap = 1e2;
  bool is_close = false;
  double next = 0.0;
  for (const Complex value : nu) {
    const double size = std::abs(value);
    if (size * shift > 0.5) {
      is_close = true;
    } else {
      next = std::max(next, size);
    }
  }
  if (!is_close || next == 0.0 || next * gap * shift > 1.0) return std::nullopt;
  return 0.1 / next;
}

// How well a value and a vector solve the equations, and what rounding may do to the square of the
// value.
struct Judgement {
  double residual = 0.0;
  double rounding = 0.0;
};

class Judge {
 public:
  Judge(const ShiftInvert& inverse, const QuadraticPencil& pencil, double shift, double stiffness)
      : inverse_(inverse), pencil_(pencil), shift_(shift), stiffness_(stiffness) {}

  Judgement operator()(Complex value, const Eigen::VectorXcd& x) const {
    const Eigen::VectorXcd momentum = product(inverse_, *pencil_.M, x);
    const Eigen::VectorXcd inertia = value * value * momentum;
    const Eigen::VectorXcd rates = value * product(inverse_, *pencil_.C, x);
    const Eigen::VectorXcd rest = product(inverse_, *pencil_.K, x) + rates + inertia;
    const Eigen::VectorXd terms = inverse_.absolute(*pencil_.K, x.cwiseAbs());
    double size = std::max(
        {terms.maxCoeff(), rates.lpNorm<Eigen::Infinity>(), inertia.lpNorm<Eigen::Infinity>()});
    // a motion that nothing resists has only rounding in its terms
    const double stiff = stiffness_ * x.lpNorm<Eigen::Infinity>();
    if (std::abs(value) <= shift_) {
      if (size < unresisted * stiff) size = stiff;
      size = std::max(size, shift_ * shift_ * momentum.lpNorm<Eigen::Infinity>());
    }
    const double mass = x.dot(momentum).real();
    return {rest.lpNorm<Eigen::Infinity>() / size,
            eps * (x.cwiseAbs().dot(terms) + shift_ * shift_ * mass)};
  }

 private:
  const ShiftInvert& inverse_;
  const QuadraticPencil& pencil_;
  double shift_;
  double stiffness_;  // largest entry
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
  // of a pair s, -s of what falls over the growing one first, which alone may find room
  constexpr double alike = 1e-6;
  for (std::size_t i = 1; i < found.size(); ++i) {
    const Complex before = found[i - 1].first, value = found[i].first;
    const bool are_alike = std::abs(value) - std::abs(before) <= alike * std::abs(value);
    if (are_alike && value.real() > before.real() + alike * std::abs(value)) {
      std::swap(found[i - 1], found[i]);
    }
  }

  const Judge judge(problem.inverse(), pencil, settings.shift, largest_entry(*pencil.K, comm));
  FreeMotions free(problem, *pencil.M);
  result.values.clear();
  result.rounding.clear();
  result.worst_residual = 0.0;
  result.vectors.resize(n, 0);
  for (const auto& [value, column] : found) {
    if (result.vectors.cols() == settings.count) break;
    Eigen::VectorXcd x = problem.finish(pairs.vectors.col(column).head(n), value);
    Judgement judged = judge(value, x);
    if (is_zero(value, judged.rounding)) {
      const std::optional<Eigen::VectorXcd> motion = free.next(x);
      if (!motion) continue;
      x = *motion;
      judged = judge(value, x);
    }
    if (!(judged.residual <= largest_residual)) continue;
    result.worst_residual = std::max(result.worst_residual, judged.residual);
    result.values.push_back(value);
    result.rounding.push_back(judged.rounding);
    result.vectors.conservativeResize(Eigen::NoChange, result.vectors.cols() + 1);
    result.vectors.rightCols<1>() = x;
  }
}

ComplexPairs solve_at(const QuadraticPencil& pencil, const EigenSettings& settings,
                      const parallel::Comm& comm, bool may_move) {
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
    if (const auto shift = clear_shift(pairs.nu, settings.shift); shift && may_move) {
      EigenSettings moved = settings;
      moved.shift = *shift;
      return solve_at(pencil, moved, comm, false);
    }
    take(problem, pencil, settings, comm, pairs, result);
    result.are_all = result.solver == "Dense" || asked >= 2 * n - 2;
    if (static_cast<int>(result.values.size()) == settings.count || result.are_all) return result;
    if (asked > 16 * settings.count) throw_broken_down();
  }
}

}  // namespace

bool is_zero(std::complex<double> value, double rounding) {
  // of lambda^2, whose double zero is not exact to rounding
  constexpr double bound = 1e3;
  return std::norm(value) <= bound * rounding;
}

ComplexPairs solve_quadratic(const QuadraticPencil& pencil, const EigenSettings& settings,
                             const parallel::Comm& comm) {
  return solve_at(pencil, settings, comm, true);
}

}  // namespace culm::solver
