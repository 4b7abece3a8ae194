#include <culm/analysis/relaxing_modes.hpp>
#include <culm/base/error.hpp>

#include <Eigen/SparseLU>
#include <fmt/format.h>

#include <cmath>
#include <limits>
#include <numbers>

namespace culm::analysis {
namespace {

using Complex = std::complex<double>;
using ComplexMatrix = Eigen::SparseMatrix<Complex>;

constexpr int most_iterations = 50;
constexpr int approaches = 8;        // each brings some digits where branches are strong
constexpr double converged = 1e-13;  // change of the value, over its size
constexpr double settled = 1e-6;     // where a change that falls no more is rounding

struct Follows {
  Complex value, derivative;  // of the factor, by lambda
};

Follows follows(const BranchTerm& term, Complex lambda) {
  const Complex s = lambda + term.shift;
  const Complex resists = 1.0 + s * term.time;
  const Complex value = s * term.time / resists, derivative = term.time / (resists * resists);
  if (!term.of_velocity) return {value, derivative};
  return {s * value, value + s * derivative};
}

ComplexMatrix at(const RelaxingPencil& pencil, Complex lambda) {
  ComplexMatrix T = lambda * lambda * pencil.M.cast<Complex>();
  T += lambda * pencil.C.cast<Complex>();
  T += pencil.K.cast<Complex>();
  for (const BranchTerm& term : pencil.terms) T += follows(term, lambda).value * term.matrix;
  return T;
}

// T'(lambda) x
Eigen::VectorXcd derivative(const RelaxingPencil& pencil, Complex lambda,
                            const Eigen::VectorXcd& x) {
  Eigen::VectorXcd y = pencil.M * x;
  y *= 2.0 * lambda;
  y += pencil.C * x;
  for (const BranchTerm& term : pencil.terms) {
    y += follows(term, lambda).derivative * (term.matrix * x);
  }
  return y;
}

[[noreturn]] void give_up(Complex start) {
  throw NumericalError(fmt::format(
      "The mode at {:.6g} Hz of the lasting stiffness was not found with its branches "
      "of 'Relaxation'.\nTry: more or fewer 'Modes', or 'Damping' = false, which leaves "
      "branches out.",
      std::abs(start) / (2.0 * std::numbers::pi)));
}

// x^H of all branches x
Complex of_branches(const RelaxingPencil& pencil, Complex lambda, const Eigen::VectorXcd& x) {
  Complex sum = 0.0;
  for (const BranchTerm& term : pencil.terms) {
    sum += follows(term, lambda).value * x.dot(term.matrix * x);
  }
  return sum;
}

// Whether a motion only grows: then what branches do to it is real, and so is what it becomes.
bool only_grows(Complex lambda) {
  return lambda.real() > 0.0 && std::abs(lambda.imag()) <= 1e-9 * lambda.real();
}

// The zero of x^H T(lambda) x on the positive axis, between which and zero the stiffness that
// lasts keeps its sign; by halves.
Complex approached_on_axis(const RelaxingPencil& pencil, double lambda, const Eigen::VectorXcd& x) {
  const double m = x.dot(pencil.M * x).real();
  const double c = x.dot(pencil.C * x).real();
  const double k = x.dot(pencil.K * x).real();
  const auto value = [&](double s) {
    return m * s * s + c * s + k + of_branches(pencil, s, x).real();
  };
  constexpr int halves = 60;
  double low = 0.0, high = lambda;
  for (int i = 0; i < halves && value(high) * k > 0.0; ++i) high *= 2.0;
  for (int i = 0; i < halves; ++i) {
    const double middle = 0.5 * (low + high);
    (value(middle) * k > 0.0 ? low : high) = middle;
  }
  return 0.5 * (low + high);
}

// A value near the zero of x^H T(lambda) x: branches stand still as they are at the value before,
// so strong ones lead to no creep and to no conjugate, as Newton's method would from far away.
Complex approached(const RelaxingPencil& pencil, Complex lambda, const Eigen::VectorXcd& x) {
  const Complex m = x.dot(pencil.M * x);
  const Complex c = x.dot(pencil.C * x);
  for (int i = 0; i < approaches; ++i) {
    const Complex k = x.dot(pencil.K * x) + of_branches(pencil, lambda, x);
    const Complex root = std::sqrt(c * c - 4.0 * m * k);
    const Complex one = (-c + root) / (2.0 * m), other = (-c - root) / (2.0 * m);
    lambda = std::abs(one - lambda) < std::abs(other - lambda) ? one : other;
  }
  return lambda;
}

// The zero of x^H T(lambda) x next to a value: exact where branches do not change the shape.
Complex value_along(const RelaxingPencil& pencil, Complex lambda, const Eigen::VectorXcd& x) {
  const Complex start = lambda;
  for (int i = 0; i < most_iterations; ++i) {
    const Complex change = x.dot(at(pencil, lambda) * x) / x.dot(derivative(pencil, lambda, x));
    lambda -= change;
    if (!std::isfinite(std::abs(lambda))) give_up(start);
    if (std::abs(change) <= converged * std::abs(lambda)) break;
  }
  return lambda;
}

}  // namespace

ComplexMode compute_relaxing_mode(const RelaxingPencil& pencil, const ComplexMode& start) {
  const Complex near = only_grows(start.value)
                           ? approached_on_axis(pencil, start.value.real(), start.vector)
                           : approached(pencil, start.value, start.vector);
  ComplexMode mode{value_along(pencil, near, start.vector), start.vector};
  const Eigen::VectorXcd v = start.vector;  // x is kept at v^H x = v^H v
  const double size = v.squaredNorm();
  double last = std::numeric_limits<double>::infinity();
  Eigen::SparseLU<ComplexMatrix> factors;
  for (int i = 0;; ++i) {
    if (i == most_iterations) give_up(start.value);
    ComplexMatrix T = at(pencil, mode.value);
    T.makeCompressed();
    factors.compute(T);
    // at an eigenvalue to the last digit
    if (factors.info() != Eigen::Success) break;
    const Eigen::VectorXcd u = factors.solve(derivative(pencil, mode.value, mode.vector));
    const Complex along = v.dot(u) / size;
    const Complex change = 1.0 / along;
    if (!u.allFinite() || !std::isfinite(std::abs(change))) give_up(start.value);
    mode.value -= change;
    mode.vector = u / along;
    const double moved = std::abs(change) / std::abs(mode.value);
    if (moved <= converged || (moved <= settled && moved > 0.5 * last)) break;
    last = moved;
  }
  mode.value = value_along(pencil, mode.value, mode.vector);
  if (mode.value.imag() < 0.0) {  // the other one of a pair, which says the same
    mode.value = std::conj(mode.value);
    mode.vector = mode.vector.conjugate().eval();
  }
  const Eigen::VectorXd terms = pencil.K.cwiseAbs() * mode.vector.cwiseAbs();
  mode.residual = (at(pencil, mode.value) * mode.vector).cwiseAbs().maxCoeff() / terms.maxCoeff();
  return mode;
}

}  // namespace culm::analysis
