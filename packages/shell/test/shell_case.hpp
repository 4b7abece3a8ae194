/// Shell elements for tests: warped and tapered, of layers in all directions.
#pragma once

#include <culm/material/isotropic.hpp>
#include <culm/material/orthotropic.hpp>
#include <culm/shell/linear_shell.hpp>

#include <culm_kit/dense_assembly.hpp>
#include <culm_kit/rigid_motion.hpp>

namespace culm::shell {

using Nodes = ShellForms::Nodes;

/// Four nodes that lie in no plane, directors of length one that are not parallel.
inline Nodes warped_reference() {
  Nodes q;
  q.col(0) = Vec3(-0.5, -0.4, 0.05);
  q.col(2) = Vec3(0.55, -0.45, -0.03);
  q.col(4) = Vec3(0.4, 0.5, 0.08);
  q.col(6) = Vec3(-0.45, 0.35, -0.06);
  q.col(1) = Vec3(-0.2, -0.1, 1.0).normalized();
  q.col(3) = Vec3(0.25, -0.15, 1.0).normalized();
  q.col(5) = Vec3(0.2, 0.2, 1.0).normalized();
  q.col(7) = Vec3(-0.1, 0.15, 1.0).normalized();
  return q;
}

/// Each node moved and its director turned and stretched by its own random amount.
inline Nodes random_state(int seed) {
  kit::Random random(seed);
  Nodes q = warped_reference();
  for (int a = 0; a < 4; ++a) {
    q.col(2 * a) += 0.2 * random.vector();
    q.col(2 * a + 1) = (1.0 + 0.2 * random.number()) * (random.rotation(0.5) * q.col(2 * a + 1));
  }
  return q;
}

/// Two orthotropic plies of different angle on an isotropic one.
inline std::shared_ptr<const material::Layup> mixed_layup() {
  const material::Material ply{
      material::OrthotropicMaterial::law({10.0, 1.0, 1.2, 0.3, 0.25, 0.2, 0.6, 0.5, 0.4}), 1.5};
  const material::Material core{material::IsotropicMaterial::law(3.0, 0.3), 2.5};
  return std::make_shared<material::Layup>(
      material::Layup{{{core, 0.06, 0.0}, {ply, 0.05, 0.5}, {ply, 0.04, -1.1}}});
}

/// Mass by the volume of each layer, as its faces enclose it.
inline double volume_mass(const Nodes& reference, const material::Layup& layup) {
  const ShellGeometry geometry(reference, layup.thickness(), {});
  double mass = 0.0;
  for (std::size_t l = 0; l < layup.layers.size(); ++l) {
    const material::Layer& layer = layup.layers[l];
    const double bottom = layup.bottom(static_cast<int>(l));
    // the volume is a polynomial of degree two in each direction: Simpson's rule is exact
    for (int i = 0; i < 27; ++i) {
      const double weight[] = {1.0 / 3.0, 4.0 / 3.0, 1.0 / 3.0};
      const int a = i % 3;
      const int b = i / 3 % 3;
      const int c = i / 9;
      mass += layer.material.density * weight[a] * weight[b] * weight[c] * 0.5 * layer.thickness *
              geometry.jacobian(a - 1.0, b - 1.0, bottom + 0.5 * c * layer.thickness);
    }
  }
  return mass;
}

struct ElasticShellCase {
  using Type = ElasticShell;
  static Nodes reference() { return warped_reference(); }
  static Nodes state(int seed) { return random_state(seed); }
  static Type make() {
    return {reference(), mixed_layup(), {.reference_axis = Vec3(1.0, 0.3, 0.1)}};
  }
  static double total_mass() { return volume_mass(reference(), *mixed_layup()); }
};

/// The same without any remedy against locking.
struct PlainShellCase : ElasticShellCase {
  static Type make() {
    return {reference(),
            mixed_layup(),
            {.assumed_shear = false, .assumed_thickness = false, .enhancement = {0, 0}}};
  }
};

/// With all enhanced modes there are.
struct FullyEnhancedShellCase : ElasticShellCase {
  static Type make() { return {reference(), mixed_layup(), {.enhancement = {7, 4}}}; }
};

/// A frame node, and the nodes of a shell with two empty slots each.
inline LinearShell::Nodes with_frame(const Slots<4>& frame, const Nodes& shell) {
  LinearShell::Nodes q = LinearShell::Nodes::Zero();
  q.leftCols<4>() = frame;
  for (int a = 0; a < 4; ++a) q.middleCols<2>(4 * (a + 1)) = shell.middleCols<2>(2 * a);
  return q;
}

/// To first order, seen from a frame.
struct LinearShellCase {
  using Type = LinearShell;
  static Slots<20> reference() { return with_frame(kit::random_node(30), warped_reference()); }
  static Slots<20> state(int seed) {
    return with_frame(kit::random_node(31 + seed), random_state(seed));
  }
  static Type make() { return {ElasticShellCase::make(), reference()}; }
  static double total_mass() { return ElasticShellCase::total_mass(); }
};

}  // namespace culm::shell
