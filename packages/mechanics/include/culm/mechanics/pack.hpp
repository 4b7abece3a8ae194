/// Several elements of one kind side by side, one in each lane of a vector.
#pragma once

#include <culm/mechanics/element.hpp>

#include <array>
#include <cstddef>

namespace culm {

/// Elements in a pack; lanes beyond the last element repeat it.
inline constexpr int pack_lanes = 8;

/// A number of each element of a pack. What is done with it is done in all lanes at once; functions
/// take it by reference and are inlined, as no convention for calls fits all vector units.
using Pack = double
    __attribute__((vector_size(pack_lanes * sizeof(double)), aligned(pack_lanes * sizeof(double))));

/// An array of numbers of each element; std::array would lose the alignment.
template <int size>
struct Packs {
  Pack numbers[size];

  Pack* data() { return numbers; }
  const Pack* data() const { return numbers; }
  Pack& operator[](std::size_t at) { return numbers[at]; }
  const Pack& operator[](std::size_t at) const { return numbers[at]; }
  /// Those of the element in lane l.
  double& of(int l, int at) { return reinterpret_cast<double*>(numbers + at)[l]; }
  double of(int l, int at) const { return reinterpret_cast<const double*>(numbers + at)[l]; }
};

/// Puts `count` numbers of each element side by side, number c of lane l from rows[l][c].
/// @param count  at least pack_lanes
void to_lanes(const std::array<const double*, pack_lanes>& rows, int count, Pack* numbers);
/// The way back.
void from_lanes(const Pack* numbers, int count, const std::array<double*, pack_lanes>& rows);

/// Where N triads of each element are in a step, by coordinates of their slots.
template <int N>
struct PackMotion {
  Packs<12 * N> prev;  ///< wanted where it counts, see `counts_start`
  Packs<12 * N> next;
  /// State::acceleration_offset, wanted with inertia: M a acts with a = inertia (next - prev) + it.
  Packs<12 * N> acceleration_offset;
};

/// Whether the start of a step has a part in its forces.
constexpr bool counts_start(const Stencil& stencil) {
  return stencil.theta != 1.0 || stencil.theta_strain != 1.0 || stencil.inertia != 0.0;
}

/// Whether a pack tells the energy of what its strains change by, of which physical and numerical
/// damping take a share: where no tangent is wanted, as in the last evaluation of most steps.
constexpr bool tells_change(const Stencil& stencil, bool with_tangent) {
  return !with_tangent && counts_start(stencil) && stencil.theta_strain != 0.5;
}

/// What a pack answers, in six unknowns of each of N triads: dx and dtheta, with dd = dtheta x d
/// for d where forces act in rows and at the end of the step in columns.
template <int N>
struct PackSum {
  Packs<6 * N> residual;
  Packs<36 * N * N> tangent;  ///< by rows
  Packs<3 * N> pull;          ///< forces on positions that the tangent belongs to
  /// 1/2 De . C De with the change De of the strains in the step [J], see `tells_change`.
  Pack change_energy;
};

/// Momentum of each element of a pack. @source formulation 1.2, 4.6
struct PackMomentum {
  Pack kinetic_energy;
  Packs<3> linear;
  Packs<3> angular;  ///< about the origin
};

/// Elements of triads whose law is linear, and that come in packs: E::Pack holds the constants of
/// pack_lanes elements, some perhaps with the pack before; its functions are what ElementBatch does
/// for one of them.
template <class E>
concept ComesInPacks = HasStiffness<E> &&
    requires(const typename E::Pack& pack, const PackMotion<E::num_nodes>& motion,
             const ::culm::Pack* numbers, ::culm::Pack* stress, const Stencil& stencil,
             PackSum<E::num_nodes>& sum, PackMomentum& momentum) {
  // numbers: stress of the tangent, num_points x num_strains, or nullptr for that of the motion;
  // without tangent only the residual is written, and the energy of the change where wanted
  { pack.evaluate(motion, numbers, stencil, true, sum) }
  noexcept->std::same_as<void>;
  // numbers: increments of the slots; stress: of the motion and what they add, to first order
  { pack.extrapolate(motion, numbers, stencil, stress) }
  noexcept->std::same_as<void>;
  // numbers: slots of which the strains store energy, less those of others or nullptr; stress: it
  { pack.strain_energy(numbers, numbers, stress) }
  noexcept->std::same_as<void>;
  // numbers: velocities of the slots; stress: the kinetic energy
  { pack.kinetic_energy(numbers, stress) }
  noexcept->std::same_as<void>;
  // numbers: slots and their velocities
  { pack.find_momentum(numbers, numbers, momentum) }
  noexcept->std::same_as<void>;
  { pack.fetch_shared(pack) } -> std::same_as<void>;
};

}  // namespace culm
