#include "tower_bending.hpp"

#include <culm/math/quadrature.hpp>

#include <Eigen/Eigenvalues>

#include <algorithm>
#include <cmath>

namespace culm::openfast {

double first_bending(const Cantilever& tower, const std::optional<FloatingBase>& base) {
  constexpr int elements = 40;
  constexpr int size = 2 * (elements + 1);  // deflection and slope of each node
  Eigen::MatrixXd K = Eigen::MatrixXd::Zero(size, size);
  Eigen::MatrixXd M = Eigen::MatrixXd::Zero(size, size);
  const double h = tower.length / elements;
  for (int e = 0; e < elements; ++e) {
    for (const QuadraturePoint& point : gauss_legendre(4)) {
      const double t = 0.5 * (1.0 + point.xi);
      const Eigen::RowVector4d N(1.0 - 3.0 * t * t + 2.0 * t * t * t,
                                 h * (t - 2.0 * t * t + t * t * t), 3.0 * t * t - 2.0 * t * t * t,
                                 h * (t * t * t - t * t));
      const Eigen::RowVector4d ddN(-6.0 + 12.0 * t, h * (-4.0 + 6.0 * t), 6.0 - 12.0 * t,
                                   h * (-2.0 + 6.0 * t));
      const double weight = 0.5 * point.weight * h;
      const double x = (e + t) / elements;
      K.block<4, 4>(2 * e, 2 * e) +=
          weight * tower.stiffness(x) / std::pow(h, 4) * ddN.transpose() * ddN;
      M.block<4, 4>(2 * e, 2 * e) += weight * tower.mass(x) * N.transpose() * N;
    }
  }
  M(size - 2, size - 2) += tower.tip_mass;
  if (base) {
    const double first = base->mass * base->depth;
    Mat<2, 2> body;
    body << base->mass, -first, -first, base->inertia + first * base->depth;
    M.topLeftCorner<2, 2>() += body;
  }
  const int held = base ? 0 : 2;
  const Eigen::GeneralizedSelfAdjointEigenSolver<Eigen::MatrixXd> modes(
      K.bottomRightCorner(size - held, size - held), M.bottomRightCorner(size - held, size - held),
      Eigen::EigenvaluesOnly);
  // a floating one has two rigid motions
  return std::sqrt(modes.eigenvalues()[base ? 2 : 0]);
}

Cantilever extended(const Cantilever& tower, double depth) {
  Cantilever longer = tower;
  longer.length = tower.length + depth;
  const auto own = [share = depth / longer.length](double x) {
    return std::max(0.0, (x - share) / (1.0 - share));
  };
  longer.mass = [own, mass = tower.mass](double x) { return mass(own(x)); };
  longer.stiffness = [own, stiffness = tower.stiffness](double x) { return stiffness(own(x)); };
  return longer;
}

}  // namespace culm::openfast
