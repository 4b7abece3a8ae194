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
  throw NumericalError(
      fmt::format("The mode at {:.6g} Hz of the lasting stiffness was not found with its branches "
                  "of 'Relaxation'.\nTry: other modes ('Near'), or 'Damping' = false, which leaves "
                  "branches out.",
                  std::abs(start) / (2.0 * std::numbers::pi)));
}

// A value near the zero of x^H T(lambda) x: branches stand still as they are at the value before,
// so strong ones lead to no creep and to no conjugate, as Newton's method would from far away.
Complex approached(const RelaxingPencil& pencil, Complex lambda, const Eigen::VectorXcd& x) {
  const Complex m = x.dot(pencil.M * x);
  const Complex c = x.dot(pencil.C * x);
  for (int i = 0; i < approaches; ++i) {
    Complex k = x.dot(pencil.K * x);
    for (const BranchTerm& term : pencil.terms) {
      k += follows(term, lambda).value * x.dot(term.matrix * x);
    }
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
  const Complex near = approached(pencil, start.value, start.vector);
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
  const Eigen::VectorXd terms = pencil.K.cwiseAbs() * mode.vector.cwiseAbs();
  mode.residual = (at(pencil, mode.value) * mode.vector).cwiseAbs().maxCoeff() / terms.maxCoeff();
  return mode;
}

}  // namespace culm::analysis
