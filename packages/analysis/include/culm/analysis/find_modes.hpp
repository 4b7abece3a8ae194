/// Small vibrations about a state.
#pragma once

#include <culm/analysis/linearisation.hpp>
#include <culm/analysis/mode_properties.hpp>
#include <culm/analysis/turning_rotor.hpp>

#include <complex>
#include <optional>
#include <string>
#include <vector>

namespace culm::analysis {

/// Which modes.
struct ModalSettings {
  int modes = 10;
  std::optional<double> near;  ///< frequency next to which modes are looked for [Hz]; the lowest
  bool damping = false;        ///< whether dampers and gyroscopic forces count
  std::string solver = "Automatic";    ///< one of solver::eigen_solver_names()
  std::optional<RotorSettings> rotor;  ///< a rotor that turns while the rest stands
  bool expects_zero = false;           ///< whether frequencies next to zero are no news
  bool stiffness_sign = false;         ///< whether that of `ModeSet` is found
};

/// Motion with exp(lambda t).
struct Mode {
  std::complex<double> eigenvalue;  ///< lambda [1/s]; zero for rigid-body motions and mechanisms
  Shape shape;                      ///< with phi^H M phi = 1
  ModeProperties properties;
  std::optional<WhirlShares> whirl;  ///< with a turning rotor; shares of phi^H M phi

  bool is_zero() const { return eigenvalue == 0.0; }
  double frequency() const;  ///< of the motion [Hz]
  double damping() const;    ///< -Re lambda / |lambda|; negative where the motion grows
};

/// The modes about a state by frequency, or by |lambda| where there is damping.
struct ModeSet {
  std::vector<Mode> modes;
  Vec6 total = Vec6::Zero();  ///< mass [kg] and inertia [kg m^2] of the model, see ModeMasses
  double rotor_speed = 0.0;   ///< of a rotor that turns while the rest stands [rad/s]
  /// Of the determinant of the stiffness that lasts, which changes where one motion begins to grow
  /// without oscillation; 0 if it is singular or was not asked for.
  int stiffness_sign = 0;
  bool is_complex = false;
  std::string solver;
  double worst_residual = 0.0;
};

/// Symmetric without damping: real shapes. Otherwise complex ones. With a turning rotor frequencies
/// are those of an observer at rest, and shapes those at the azimuth of the state. Brings the state
/// up to date on all ranks. Throws NumericalError, InputError. Collective.
ModeSet find_modes(Context& context, model::State& state, const ModalSettings& settings);

/// "tower 62 %, blade 12 %; forward whirl 31 %": what moves most, and how the blades do.
std::string describe(const Mode& mode, const model::Model& model);

}  // namespace culm::analysis
