/// What a mode shape does to the masses of a model.
#pragma once

#include <culm/analysis/shape.hpp>
#include <culm/model/mass_properties.hpp>

namespace culm::analysis {

/// Of a shape with phi^H M phi = 1.
struct ModeProperties {
  double modal_mass = 0.0;  ///< for a largest displacement of 1 m [kg]; 0 if nothing is displaced
  /// phi^H M r for rigid motions r: along x, y, z [kg^1/2] and about them through the centre of
  /// mass [kg^1/2 m]; the absolute value of complex ones. Their squares are effective masses.
  Vec6 participation = Vec6::Zero();
  std::vector<double> energy;  ///< share of each structure in the kinetic energy; sum 1
};

/// Products of shapes with the mass of a model at a state.
class ModeMasses {
 public:
  /// @param state up to date on all ranks; borrowed
  ModeMasses(const model::Model& model, const model::State& state);

  ModeProperties properties(const Shape& shape) const;
  /// Total mass along x, y, z [kg] and inertia about them [kg m^2]: what effective masses of all
  /// modes sum up to, but for masses that supports hold.
  const Vec6& total() const { return total_; }

 private:
  const model::Model& model_;
  const model::State& state_;
  std::vector<model::Coordinates> rigid_;  ///< M r of the six rigid motions
  Vec6 total_ = Vec6::Zero();
};

/// Modal assurance criterion in the metric of the mass, |phi^H M psi|^2 over the two squares: 1 for
/// the same shape, 0 for orthogonal ones.
double modal_assurance(const model::Model& model, const model::State& state, const Shape& one,
                       const Shape& other);

/// "tower 62 %, blade 12 %": structures with the largest shares.
std::string describe_shares(const model::Model& model, const std::vector<double>& shares);

}  // namespace culm::analysis
