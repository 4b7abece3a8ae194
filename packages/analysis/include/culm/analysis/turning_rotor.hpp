/// Vibrations of a machine with a rotor that turns steadily, as one problem with constant
/// coefficients.
#pragma once

#include <culm/analysis/linearisation.hpp>
#include <culm/analysis/multi_blade.hpp>
#include <culm/analysis/relaxing_modes.hpp>
#include <culm/base/issue.hpp>

#include <string>
#include <vector>

namespace culm::analysis {

/// What a deck says of the rotor; the rest is said by its rotating frame.
struct RotorSettings {
  std::vector<std::string>
      blades;   ///< structures or node sets, equal but for their azimuth; may be none
  Where where;  ///< of the blades in the deck
};

/// Says which analyses a rotating frame has no meaning for that turns some structures only, if
/// there is one: those that know nothing of a rotor.
void warn_of_turning_part(const model::Model& model, const Log& log);

/// The part of a model that the load "Rotating Frame" turns, in multi-blade coordinates. About a
/// steadily turning state the equations of rotor and stator have periodic coefficients; of a rotor
/// that is the same after each N-th of a turn, N >= 3, they are constant in these coordinates.
class TurningRotor {
 public:
  /// Throws InputError if there is not one rotating frame, or if the blades are not equal at the
  /// state: three or more, evenly spaced, turned into each other about its axis.
  /// @param state up to date on all ranks
  TurningRotor(const assembly::System& system, const model::State& state,
               const RotorSettings& settings);

  /// [rad/s]
  double speed() const { return speed_; }
  /// The same equations in multi-blade coordinates, observed at rest. Throws InputError if the
  /// rotor is not the same after an N-th of a turn. Collective.
  /// @param damping whether dampers count; gyroscopic forces do
  Linearisation transform(const Linearisation& linear, bool damping);
  /// Branches in multi-blade coordinates, with shifts: the patterns cos m psi, sin m psi of blades
  /// are motions lambda + i m Omega and lambda - i m Omega of each. Throws InputError if the rotor
  /// is not the same after an N-th of a turn.
  std::vector<BranchTerm> terms_of(const SparseMatrix& branches, double time,
                                   bool of_velocity) const;
  /// The unknowns of the system at the azimuth of the state.
  Eigen::VectorXd unknowns(const Eigen::Ref<const Eigen::VectorXd>& z) const {
    return map_.L() * z;
  }
  WhirlShares whirl(const Eigen::VectorXcd& z) const;

 private:
  void refuse_asymmetry(const SparseMatrix& matrix, bool of_hub, const char* what) const;

  const assembly::System& system_;
  Where where_;
  double speed_;
  RotorUnknowns rotor_;
  MultiBlade map_;
  SparseMatrix mass_;  // in multi-blade coordinates
};

}  // namespace culm::analysis
