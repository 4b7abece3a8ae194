#include "yielding_layers.hpp"

#include <culm/shell/element_batches.hpp>
#include <culm/shell/layer_quadrature.hpp>

#include "shell_integrals.hpp"

#include <Eigen/Cholesky>

#include <algorithm>
#include <array>
#include <cmath>

namespace culm::shell {
namespace {

using Place = structure::MaterialPoint<ElasticShell, material::PlaneStressPlasticity>;

// A point across a layer: where from -1 to 1, and its share of the thickness.
struct Height {
  double at;
  double weight;
};

// Simpson's rule in each cell; with the middle of the layer, and where cells meet once.
std::vector<Height> heights(int cells) {
  std::vector<Height> all;
  const int last = 2 * cells;
  for (int i = 0; i <= last; ++i) {
    const double of_rule = i % 2 == 1 ? 4.0 : (i == 0 || i == last ? 1.0 : 2.0);
    all.push_back({static_cast<double>(i) / cells - 1.0, of_rule / (6.0 * cells)});
  }
  return all;
}

// α = P y of the elastic element
Eigen::MatrixXd enhanced_by_forms(const ElasticWall& wall) {
  const int enhanced = wall.geometry.options().enhancement.size();
  if (enhanced == 0) return Eigen::MatrixXd::Zero(0, ShellForms::num_strains);
  ShellIntegrals integrals(enhanced);
  visit_volume(
      *wall.layup, 2,
      [&](const material::Layer& layer, double xi, double eta, double zeta, double weight) {
        const ShellGeometry::Point point = wall.geometry.at(xi, eta, zeta, layer.angle);
        integrals.add(point, weight * point.J * modulus(layer));
      });
  return -Eigen::LLT<Eigen::MatrixXd>(integrals.enhanced).solve(integrals.coupling);
}

// Membrane forces and moments of stresses in the axes of a layer, for a share of the thickness.
Mat<8, 3> resultants(double angle, double zeta, double thickness) {
  const double c = std::cos(angle);
  const double s = std::sin(angle);
  Mat3 to_wall;
  to_wall << c * c, s * s, -2.0 * s * c, s * s, c * c, 2.0 * s * c, s * c, -s * c, c * c - s * s;
  Mat<8, 3> result = Mat<8, 3>::Zero();
  result.topRows<3>() = thickness * to_wall;
  result.middleRows<3>(3) = thickness * zeta * to_wall;
  return result;
}

// The entry of model::LayerSource for a height of a layer; -1 if it has none.
int layer_state(int layer, double height) {
  constexpr std::array<double, 3> shown{-1.0, 0.0, 1.0};
  for (std::size_t k = 0; k < shown.size(); ++k) {
    if (std::abs(height - shown[k]) < 1e-12) return 3 * layer + static_cast<int>(k);
  }
  return -1;
}

}  // namespace

bool yields(const material::Layup& layup) {
  return std::any_of(layup.layers.begin(), layup.layers.end(), [](const material::Layer& layer) {
    return layer.material.plasticity.has_value();
  });
}

YieldingShell yielding_shell(int item, const ElasticWall& wall) {
  constexpr double of_surface = 0.25;  // share of a point in means over the element
  const Eigen::MatrixXd P = enhanced_by_forms(wall);
  const material::Layup& layup = *wall.layup;
  YieldingShell yielding;
  yielding.item = item;
  for (int l = 0; l < static_cast<int>(layup.layers.size()); ++l) {
    const material::Layer& layer = layup.layers[static_cast<std::size_t>(l)];
    if (!layer.material.plasticity) continue;
    for (const Height& height : heights(layer.material.plasticity->cells)) {
      const double zeta = layup.bottom(l) + 0.5 * (1.0 + height.at) * layer.thickness;
      const double thickness = height.weight * layer.thickness;
      for (const QuadraturePoint& xi : gauss_legendre(2)) {
        for (const QuadraturePoint& eta : gauss_legendre(2)) {
          const ShellGeometry::Point point = wall.geometry.at(xi.xi, eta.xi, zeta, layer.angle);
          const ShellGeometry::StrainMap strain = point.strain + point.enhanced * P;
          Place place;
          place.map << strain.row(0), strain.row(1), strain.row(5);
          place.weight = xi.weight * eta.weight * thickness * point.J;
          place.law = layer.material.plasticity->law;
          place.resultants = resultants(layer.angle, zeta, of_surface * thickness);
          place.layer_state = layer_state(l, height.at);
          place.share = of_surface;
          yielding.places.front().push_back(place);
        }
      }
    }
  }
  return yielding;
}

void add_yielding_layers(model::ElementBatch<ElasticShell>& batch, const std::vector<int>& items,
                         const std::string& structure, model::Model& model) {
  auto& flow = structure::plastic_flow<material::PlaneStressPlasticity>(model, structure, batch);
  for (int item : items) flow.add(yielding_shell(item, batch.make_element(item).wall()));
}

}  // namespace culm::shell
