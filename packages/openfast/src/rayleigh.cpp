#include "rayleigh.hpp"

#include <culm/math/quadrature.hpp>

#include <cmath>

namespace culm::openfast {

namespace {

struct Shape {
  double value;
  double curvature;  // second derivative by x
};

Shape evaluate(const FileMode& mode, double x) {
  Shape shape{0.0, 0.0};
  for (int k = 0; k < 5; ++k) {
    const double c = mode.coefficients[static_cast<std::size_t>(k)];
    shape.value += c * std::pow(x, k + 2);
    shape.curvature += c * (k + 2) * (k + 1) * std::pow(x, k);
  }
  return shape;
}

}  // namespace

double rayleigh(const Cantilever& beam, const FileMode& mode) {
  double stiffness = 0.0;
  double mass = 0.0;
  for (std::size_t i = 0; i + 1 < beam.places.size(); ++i) {
    const double half = 0.5 * (beam.places[i + 1] - beam.places[i]);
    for (const QuadraturePoint& point : gauss_legendre(6)) {
      const double x = beam.places[i] + half * (1.0 + point.xi);
      const Shape shape = evaluate(mode, x);
      stiffness += half * point.weight * beam.stiffness(x) * shape.curvature * shape.curvature;
      mass += half * point.weight * beam.mass(x) * shape.value * shape.value;
    }
  }
  const double tip = evaluate(mode, 1.0).value;
  const double generalised = mass * beam.length + beam.tip_mass * tip * tip;
  return std::sqrt(stiffness / std::pow(beam.length, 3) / generalised);
}

}  // namespace culm::openfast
