/// Layered shell for large strains.
#pragma once

#include <culm/material/layup.hpp>
#include <culm/mechanics/internal_variables.hpp>
#include <culm/shell/shell_geometry.hpp>
#include <culm/shell/shell_results.hpp>

#include <memory>
#include <vector>

namespace culm::shell {

/// The four-node shell of ElasticShell with layers of any hyperelastic law. Stresses are integrated
/// over 2 x 2 points and two per layer in every call; the enhanced parameters solve a small
/// nonlinear system there and are the internal variables. In dynamics they make the algorithmic
/// stress orthogonal to the enhanced modes, so that they do no work and energy is exact.
/// @source formulation 1.4.3, 4.4
class HyperelasticShell : public ShellForms {
 public:
  /// As the stress of a step is a discrete derivative of the energy; see StressConserves.
  static constexpr bool stress_conserves = true;
  static constexpr int num_internals = Enhancement::most;
  static constexpr int num_resultants = 8;
  /// The enhanced parameters; those that the element does not have stay zero.
  using Internals = Vec<num_internals>;

  /// @param reference  nodes, stress-free, with directors of length one
  /// @pre shell_mistakes(...) is empty
  HyperelasticShell(const Nodes& reference, std::shared_ptr<const material::Layup> layup,
                    const ShellOptions& options = {});

  /// As ElementWithInternals says. law_out_of_range when a point collapses, or when the enhanced
  /// parameters are not found.
  Verdict respond(int point, const Strain& prev, const Strain& next,
                  const Internals& internals_prev, const Stencil& stencil, Internals& internals,
                  Response<num_strains>& response) const noexcept;
  /// NaN when a point has collapsed
  double energy(int point, const Strain& y, const Internals& internals) const noexcept;
  const SlotMatrix<num_slots>& mass() const noexcept { return mass_; }

  ShellResultants resultants(int point, const Strain& y, const Internals& internals) const noexcept;
  static constexpr const auto& resultant_names() { return shell_resultant_names; }
  /// At the centre of the element, at `height` within a layer: -1 bottom, 0 middle, 1 top.
  LayerState layer_state(int layer, double height, const Strain& y,
                         const Internals& internals) const;
  const material::Layup& layup() const { return *layup_; }

 private:
  struct Point {
    const material::Material::Law* law;
    double weight;  // with the volume
    ShellGeometry::StrainMap strain;
    ShellGeometry::EnhancedModes enhanced;
  };
  struct Step;
  struct EnhancedSystem;

  EnhancedParameters active(const Internals& internals) const {
    return internals.head(geometry_.options().enhancement.size());
  }
  Vec6 strain_at(const Point& point, const Strain& y, const EnhancedParameters& enhanced) const;
  Verdict solve_enhanced(const Step& step, EnhancedParameters& enhanced) const noexcept;

  ShellGeometry geometry_;
  std::shared_ptr<const material::Layup> layup_;
  std::vector<Point> points_;
  SlotMatrix<num_slots> mass_;
};

static_assert(ElementWithInternals<HyperelasticShell>);

}  // namespace culm::shell
