/// Stresses and stress resultants of the four-node shell, at its centre.
#pragma once

#include <culm/material/layup.hpp>
#include <culm/model/layer_source.hpp>
#include <culm/shell/shell_geometry.hpp>

#include <array>
#include <functional>

namespace culm::shell {

/// Membrane forces [N/m], moments [N] and shear forces [N/m]: integrals over ζ of the second
/// Piola-Kirchhoff stress and of ζ times it. Axes of the reference at the centre of the element: 3
/// the normal, 1 the reference axis projected (ShellOptions), 2 = 3 x 1.
using ShellResultants = Vec<8>;
inline constexpr std::array<const char*, 8> shell_resultant_names{"N11", "N22", "N12", "M11",
                                                                  "M22", "M12", "Q1",  "Q2"};

using LayerState = model::LayerState;

/// A strain of a layer at ζ in its axes, Voigt order 11, 22, 33, 23, 13, 12.
using LayerStrain = std::function<Vec6(const material::Layer& layer, double zeta)>;

/// A layered element that is deformed.
struct DeformedShell {
  const ShellGeometry& geometry;
  const material::Layup& layup;
  const ShellForms::Strain& forms;
  const EnhancedParameters& enhanced;
  const LayerStrain* free = nullptr;  ///< strain without stress; null: none

  ShellResultants resultants() const;
  /// At `height` within a layer: -1 bottom, 0 middle, 1 top.
  LayerState layer_state(int layer, double height) const;

 private:
  LayerState at(const material::Layer& layer, double zeta) const;
};

}  // namespace culm::shell
