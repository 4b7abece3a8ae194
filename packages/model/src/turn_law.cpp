#include <culm/math/lagrange.hpp>
#include <culm/math/quadrature.hpp>
#include <culm/model/turn_law.hpp>

#include <algorithm>
#include <cmath>

namespace culm::model {
namespace {

// Energy in EI/h, its gradient and curvature by the angles of the end and, for order 3, of the
// inner node before it; angles of the other half are their negatives.
struct Bending {
  double energy = 0.0;
  Vec<2> slope = Vec<2>::Zero();
  Mat<2, 2> curvature = Mat<2, 2>::Zero();
};

// Angle of a node = weights . (end, inner)
template <int Order>
Vec<2> node_weights(int node) {
  if (node == 0) return {-1.0, 0.0};
  if (node == Order) return {1.0, 0.0};
  return {0.0, Lagrange<Order>::node(node) * Order};
}

// h K = 2 sum_{a<b} (N_a N_b' - N_b N_a') sin(phi_b - phi_a), from (1.4)
template <int Order>
Bending bend(const Vec<2>& angles) {
  Bending bending;
  for (const auto& [xi, weight] : gauss_legendre(Order)) {
    const auto N = Lagrange<Order>::values(xi);
    const auto dN = Lagrange<Order>::derivatives(xi);
    double K = 0.0;
    Vec<2> slope = Vec<2>::Zero();
    Mat<2, 2> curvature = Mat<2, 2>::Zero();
    for (int a = 0; a <= Order; ++a) {
      for (int b = a + 1; b <= Order; ++b) {
        const Vec<2> between = node_weights<Order>(b) - node_weights<Order>(a);
        const double factor = 2.0 * (N[a] * dN[b] - N[b] * dN[a]);
        const double turn = between.dot(angles);
        K += factor * std::sin(turn);
        slope += factor * std::cos(turn) * between;
        curvature -= factor * std::sin(turn) * between * between.transpose();
      }
    }
    bending.energy += 0.25 * weight * K * K;
    bending.slope += 0.5 * weight * K * slope;
    bending.curvature += 0.5 * weight * (slope * slope.transpose() + K * curvature);
  }
  return bending;
}

// F and its derivatives by the turn.
struct Curvature {
  double value, slope, curvature;
};

// From energy F^2/2, moment F F' and stiffness F'^2 + F F''.
Curvature curvature_of(double energy, double moment, double stiffness) {
  const double F = std::sqrt(2.0 * energy);
  const double slope = moment / F;
  return {F, slope, (stiffness - slope * slope) / F};
}

Curvature curvature_at(int order, double turn) {
  if (turn < 1e-3) return {turn, 1.0, 0.0};  // rounding would count, and no error does
  Vec<2> angles(0.5 * turn, turn / 6.0);
  if (order < 3) {
    const Bending b = order == 1 ? bend<1>(angles) : bend<2>(angles);
    return curvature_of(b.energy, 0.5 * b.slope[0], 0.25 * b.curvature(0, 0));
  }
  Bending b = bend<3>(angles);
  constexpr int enough = 50;  // quadratic up to the greatest moment
  for (int i = 0; i < enough && std::abs(b.slope[1]) > 1e-14; ++i) {
    angles[1] -= b.slope[1] / b.curvature(1, 1);
    b = bend<3>(angles);
  }
  const double coupling = b.curvature(0, 1) * b.curvature(0, 1) / b.curvature(1, 1);
  return curvature_of(b.energy, 0.5 * b.slope[0], 0.25 * (b.curvature(0, 0) - coupling));
}

// Where a falling function crosses zero between 0 and `end`.
template <class Function>
double crossing(double end, const Function& f) {
  double begin = 0.0;
  while (end - begin > 1e-9) {
    const double middle = 0.5 * (begin + end);
    (f(middle) > 0.0 ? begin : end) = middle;
  }
  return 0.5 * (begin + end);
}

constexpr double beyond_all_moments = 2.2;  // [rad], where all orders have passed the greatest one

}  // namespace

TurnErrors TurnLaw::errors(double turn, double reference) const {
  const double most = greatest_moment();
  const double at = std::min(turn, most);
  const double from = std::min(reference, most);
  const Curvature F = curvature_at(order_, at);
  const double strain = F.value - curvature_at(order_, from).value;
  const double secant = std::abs(at - from) > 1e-3 ? strain / (at - from) : F.slope;
  return {1.0 / (F.slope * F.slope) - 1.0, 1.0 - secant * F.slope,
          1.0 - (F.slope * F.slope + strain * F.curvature)};
}

double TurnLaw::turn_with(double energy_error) const {
  return crossing(greatest_moment(), [&](double turn) {
    const double slope = curvature_at(order_, turn).slope;
    return energy_error - (1.0 / (slope * slope) - 1.0);
  });
}

double TurnLaw::greatest_moment() const {
  return crossing(beyond_all_moments, [&](double turn) {
    const Curvature F = curvature_at(order_, turn);
    return F.slope * F.slope + F.value * F.curvature;
  });
}

}  // namespace culm::model
