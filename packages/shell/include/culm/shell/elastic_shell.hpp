/// Layered shell with stresses proportional to strains.
#pragma once

#include <culm/material/layup.hpp>
#include <culm/math/symmetric.hpp>
#include <culm/shell/shell_geometry.hpp>
#include <culm/shell/shell_results.hpp>

#include <memory>
#include <vector>

namespace culm::shell {

/// What the forms of a shell of linear layers mean for stresses.
struct ElasticWall {
  ShellGeometry geometry;
  std::shared_ptr<const material::Layup> layup;
  /// All enhanced modes vanish at the centre, but for the one linear in ζ alone: its parameter is
  /// this row times the forms.
  ShellForms::Strain thickness_parameter = ShellForms::Strain::Zero();

  ShellResultants resultants(const ShellForms::Strain& y) const noexcept;
  /// At the centre of the element, at `height` within a layer: -1 bottom, 0 middle, 1 top.
  LayerState layer_state(int layer, double height, const ShellForms::Strain& y) const;

 private:
  EnhancedParameters enhanced_at_centre(const ShellForms::Strain& y) const noexcept;
};

/// Four-node solid-degenerate shell of St. Venant-Kirchhoff layers: Green-Lagrange strains with all
/// powers of ζ, assumed transverse shear and thickness strains, enhanced membrane and thickness
/// strains. Enhanced parameters are linear in the forms, hence condensed once and for all: what
/// remains is a constant matrix between the forms, whatever the number of layers.
/// @source formulation 1.4; Dvorkin, Bathe (1984), Betsch, Stein (1995), Simo, Rifai (1990),
///   Büchter, Ramm, Roehl (1994), Bischoff, Ramm (1997)
class ElasticShell : public ShellForms {
 public:
  static constexpr int num_resultants = 8;

  /// @param reference  nodes, stress-free, with directors of length one
  /// @pre layup.is_linear(), shell_mistakes(...) is empty
  ElasticShell(const Nodes& reference, std::shared_ptr<const material::Layup> layup,
               const ShellOptions& options = {});

  /// S = C ((1 - ϑ) y_prev + ϑ y_next); never fails
  Verdict respond(int point, const Strain& prev, const Strain& next, const Stencil& stencil,
                  Response<num_strains>& response) const noexcept;
  double energy(int point, const Strain& y) const noexcept;
  const SlotMatrix<num_slots>& mass() const noexcept { return mass_; }
  /// The constant C of the law: symmetric, stress = C y at rest.
  Stiffness stiffness(int) const noexcept { return stiffness_.full(); }
  /// What the layers' branches of one relaxation time add to it if their springs follow at once, in
  /// the order of Layup::relaxation_times. Enhanced parameters follow the forms as at rest, so
  /// where all layers relax alike it is C times their ratio, and else an upper bound.
  Stiffness branch_stiffness(int, std::size_t branch) const noexcept {
    return branches_[branch].full();
  }

  ShellResultants resultants(int, const Strain& y) const noexcept { return wall_.resultants(y); }
  static constexpr const auto& resultant_names() { return shell_resultant_names; }
  /// At the centre of the element, at `height` within a layer: -1 bottom, 0 middle, 1 top.
  LayerState layer_state(int layer, double height, const Strain& y) const {
    return wall_.layer_state(layer, height, y);
  }
  const material::Layup& layup() const { return *wall_.layup; }
  const ElasticWall& wall() const { return wall_; }

 private:
  ElasticWall wall_;
  Symmetric<num_strains> stiffness_;
  std::vector<Symmetric<num_strains>> branches_;
  SlotMatrix<num_slots> mass_;
};

static_assert(Element<ElasticShell>);
static_assert(HasResultants<ElasticShell>);
static_assert(HasStiffness<ElasticShell> && ActsOnUnknowns<ElasticShell>);

}  // namespace culm::shell
