/// Directions in which a model moves: mode shapes, buckling shapes.
#pragma once

#include <culm/assembly/system.hpp>

#include <Eigen/Core>

#include <string>
#include <vector>

namespace culm::analysis {

/// A small motion of all nodes about a state: displacement and rotation vector, of a shell node the
/// change of its director [m, rad]. Times a common factor.
struct Shape {
  std::string name;             ///< for pictures and messages
  std::vector<Vec6> real;       ///< per node
  std::vector<Vec6> imaginary;  ///< of (real + i imaginary) exp(i phase); empty if all move at once
};

/// The motion of all nodes that a solution of the linearised equations means.
/// @param unknowns all of them, in global order; state.next up to date on all ranks
std::vector<Vec6> node_motions(const assembly::System& system, const model::State& state,
                               const Eigen::Ref<const Eigen::VectorXd>& unknowns);

/// The same in director coordinates, to first order.
model::Coordinates slot_motions(const model::Model& model, const model::State& state,
                                const std::vector<Vec6>& motions);

/// Moves all nodes of a configuration by factor times the shape, with finite rotations.
/// @param phase [rad] of the harmonic motion; a real shape moves by its cosine
void displace(const model::Model& model, const Shape& shape, double factor, double phase,
              model::Coordinates& q);

/// The factor that makes a shape visible: the largest displacement is a tenth of the model, no node
/// turns by more than 0.6 rad.
double visible_factor(const model::Model& model, const Shape& shape);

}  // namespace culm::analysis
