/// Beam elements for tests: curved and twisted, with a fully coupled section.
#pragma once

#include <culm/beam/director_beam.hpp>
#include <culm/beam/held_beam.hpp>
#include <culm/beam/helical_beam.hpp>
#include <culm/beam/linear_beam.hpp>
#include <culm/math/lagrange.hpp>
#include <culm/math/quadrature.hpp>

#include <culm_kit/rigid_motion.hpp>

namespace culm::beam {

inline Mat6 coupled_stiffness(int seed) { return kit::Random(seed).positive_matrix<6>(); }
inline Mat3 coupled_mass(int seed) { return kit::Random(seed).positive_matrix<3>(); }

/// Nodes on a curve in space; triads turn along it, so that all six strains vary.
template <int Nodes>
Slots<4 * Nodes> curved_reference() {
  Slots<4 * Nodes> q;
  for (int a = 0; a < Nodes; ++a) {
    const double s = static_cast<double>(a) / (Nodes - 1);
    q.col(4 * a) = Vec3(0.3 * s * s, 0.2 * s - 0.1 * s * s * s, 1.1 * s);
    q.template middleCols<3>(4 * a + 1) = exp_rotation(Vec3(0.5 * s, 0.4 * s * s, -0.6 * s));
  }
  return q;
}

/// Each node moved and turned by its own random amount.
template <int Nodes>
Slots<4 * Nodes> random_state(int seed) {
  kit::Random random(seed);
  Slots<4 * Nodes> q = curved_reference<Nodes>();
  for (int a = 0; a < Nodes; ++a) {
    q.col(4 * a) += 0.3 * random.vector();
    q.template middleCols<3>(4 * a + 1) =
        random.rotation(0.7) * q.template middleCols<3>(4 * a + 1);
  }
  return q;
}

template <int Order>
struct DirectorBeamCase {
  using Type = DirectorBeam<Order>;
  static Slots<Type::num_slots> reference() { return curved_reference<Type::num_nodes>(); }
  static Slots<Type::num_slots> state(int seed) { return random_state<Type::num_nodes>(seed); }
  static Type make(int section = 0) {
    std::array<Mat6, Order> stiffness;
    for (int g = 0; g < Order; ++g) {
      stiffness[static_cast<std::size_t>(g)] = coupled_stiffness(g + section);
    }
    std::array<Mat3, Order + 1> mass;
    mass.fill(coupled_mass(9 + section));
    return {reference(), stiffness, mass};
  }
  // mass per length times length of the interpolated axis, as the element integrates both
  static double total_mass() {
    const Type element = make();
    double length = 0.0;
    if (Order == 1) return coupled_mass(9)(0, 0) * element.length(0);
    for (const auto& [xi, weight] : gauss_legendre(Order + 1)) {
      const Vec<Order + 1> dN = Lagrange<Order>::derivatives(xi);
      Vec3 tangent = Vec3::Zero();
      for (int a = 0; a <= Order; ++a) tangent += dN[a] * reference().col(4 * a);
      length += weight * tangent.norm();
    }
    return coupled_mass(9)(0, 0) * length;
  }
};

template <class Held>
struct HeldBeamCase : DirectorBeamCase<Held::num_points> {
  using Type = Held;
  static Type make() { return Type(DirectorBeamCase<Held::num_points>::make()); }
};

/// The frame stands apart from the beam and is turned.
template <int Order>
struct LinearBeamCase {
  using Type = LinearBeam<Order>;
  using Base = DirectorBeamCase<Order>;
  static Slots<Type::num_slots> with_frame(const Slots<4>& frame,
                                           const typename Type::Base::Nodes& beam) {
    Slots<Type::num_slots> q;
    q << frame, beam;
    return q;
  }
  static Slots<4> frame() {
    Slots<4> q;
    q << Vec3(0.4, -0.3, 0.2), exp_rotation(Vec3(0.3, -0.8, 0.5));
    return q;
  }
  static Slots<Type::num_slots> reference() { return with_frame(frame(), Base::reference()); }
  static Slots<Type::num_slots> state(int seed) {
    Slots<4> moved = frame();
    moved.rightCols<3>() = kit::Random(seed + 50).rotation(0.7) * moved.rightCols<3>();
    return with_frame(moved, Base::state(seed));
  }
  static Type make() { return {Base::make(), reference()}; }
  static double total_mass() { return Base::total_mass(); }
};

struct HelicalBeamCase {
  using Type = HelicalBeam;
  static Slots<8> reference() { return curved_reference<2>(); }
  static Slots<8> state(int seed) { return random_state<2>(seed); }
  static Type make() {
    return {reference(), coupled_stiffness(1), {coupled_mass(9), coupled_mass(9)}};
  }
  static double total_mass() { return coupled_mass(9)(0, 0) * make().length(); }
  static Slots<8> inverted() {
    Slots<8> q = reference();
    q.middleCols<3>(5) = exp_rotation(Vec3(0.0, 3.1, 0.0)) * q.middleCols<3>(1);
    return q;
  }
};

}  // namespace culm::beam
