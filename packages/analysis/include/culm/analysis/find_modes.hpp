/// Small vibrations about a state.
#pragma once

#include <culm/analysis/linearisation.hpp>
#include <culm/analysis/mode_properties.hpp>

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
  std::string solver = "Automatic";  ///< one of solver::eigen_solver_names()
};

/// Motion with exp(lambda t).
struct Mode {
  std::complex<double> eigenvalue;  ///< lambda [1/s]; zero for rigid-body motions and mechanisms
  Shape shape;                      ///< with phi^H M phi = 1
  ModeProperties properties;

  bool is_zero() const { return eigenvalue == 0.0; }
  double frequency() const;  ///< of the motion [Hz]
  double damping() const;    ///< -Re lambda / |lambda|; negative where the motion grows
};

/// The modes about a state by frequency, or by |lambda| where there is damping.
struct ModeSet {
  std::vector<Mode> modes;
  Vec6 total = Vec6::Zero();  ///< mass [kg] and inertia [kg m^2] of the model, see ModeMasses
  bool is_complex = false;
  std::string solver;
  double worst_residual = 0.0;
};

/// Symmetric without damping: real shapes. Otherwise complex ones. Brings the state up to date on
/// all ranks. Throws NumericalError, InputError. Collective.
ModeSet find_modes(Context& context, model::State& state, const ModalSettings& settings);

}  // namespace culm::analysis
