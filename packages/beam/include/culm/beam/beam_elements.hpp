/// Elements along an axis.
#pragma once

#include <culm/beam/axis.hpp>
#include <culm/beam/section_table.hpp>
#include <culm/model/model.hpp>
#include <culm/model/strain_damping.hpp>

#include <vector>

namespace culm::beam {

/// The kinds of beam elements a deck can choose from.
enum class ElementKind { director_1, director_2, director_3, helical };

/// Polynomial order: nodes per element minus one.
int order_of(ElementKind kind);

/// How much of the mechanics of a beam is modelled.
enum class Fidelity {
  full,
  kirchhoff,  ///< no shear and no extension, see HeldBeam
  linear,     ///< small displacements from its first node, see LinearBeam
  rigid       ///< no elements; all nodes follow the first one
};

/// What a beam is made of.
struct ElementChoice {
  ElementKind kind = ElementKind::director_1;
  Fidelity fidelity = Fidelity::full;
  model::StrainDamping damping;
  bool torsion = true;  ///< false: twist is held, see HeldBeam
};

/// What the elements of a beam look like before it is loaded.
struct ReferenceState {
  double largest_turn = 0.0;  ///< largest relative rotation of the ends of an element [rad]
};

/// Adds the elements of one chain to the model, their cells and line points to the structure. Of a
/// rigid beam only its mass is added, to the first node of the structure.
/// @pre helical elements are full or rigid; those without torsion full or Kirchhoff ones
/// @param nodes  numbers of the chain's nodes in the model; order * elements + 1 of them
ReferenceState add_elements(const ElementChoice& choice, const Chain& chain,
                            const std::vector<int>& nodes, const SectionTable& sections,
                            model::Model& model, model::Structure& structure);

}  // namespace culm::beam
