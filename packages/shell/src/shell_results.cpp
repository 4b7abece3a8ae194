#include <culm/shell/layer_quadrature.hpp>
#include <culm/shell/shell_results.hpp>

#include <cmath>

namespace culm::shell {

LayerState DeformedShell::at(const material::Layer& layer, double zeta) const {
  const ShellGeometry::Point point = geometry.at(0.0, 0.0, zeta, layer.angle);
  LayerState state;
  state.strain = point.strain * forms + point.enhanced * enhanced;
  const Vec6 stressed = free == nullptr ? state.strain : Vec6(state.strain - (*free)(layer, zeta));
  Mat6 tangent;
  std::visit([&](const auto& law) { law.respond(stressed, state.stress, tangent); },
             layer.material.law);
  return state;
}

ShellResultants DeformedShell::resultants() const {
  ShellResultants sum = ShellResultants::Zero();
  visit_thickness(layup, 2, [&](const material::Layer& layer, double zeta, double weight) {
    const Vec6 S = at(layer, zeta).stress;
    // from the axes of the layer back to those of the element
    const double c = std::cos(layer.angle);
    const double s = std::sin(layer.angle);
    const Vec3 in_plane(c * c * S[0] + s * s * S[1] - 2.0 * s * c * S[5],
                        s * s * S[0] + c * c * S[1] + 2.0 * s * c * S[5],
                        s * c * (S[0] - S[1]) + (c * c - s * s) * S[5]);
    sum.segment<3>(0) += weight * in_plane;
    sum.segment<3>(3) += weight * zeta * in_plane;
    sum.segment<2>(6) += weight * Vec<2>(c * S[4] - s * S[3], s * S[4] + c * S[3]);
  });
  return sum;
}

LayerState DeformedShell::layer_state(int layer, double height) const {
  const material::Layer& ply = layup.layers[static_cast<std::size_t>(layer)];
  return at(ply, layup.bottom(layer) + 0.5 * (1.0 + height) * ply.thickness);
}

}  // namespace culm::shell
