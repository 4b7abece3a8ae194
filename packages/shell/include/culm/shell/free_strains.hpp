/// Layers of a shell that are strained when they are free of stress, as by heat.
#pragma once

#include <culm/model/layer_source.hpp>
#include <culm/shell/elastic_shell.hpp>
#include <culm/shell/shell_results.hpp>

#include <vector>

namespace culm::shell {

/// What free strains e_0 of the layers add to an element of linear layers whose enhanced
/// parameters are condensed: with E = L y + M α and W = 1/2 int (E - e_0) . C (E - e_0), of which
/// the element has what does not depend on e_0,
///   W = W_element - stress . y + energy.
struct FreeStrains {
  ShellForms::Strain stress;             ///< that holds the forms at zero, with a sign reversed
  double energy = 0.0;                   ///< left where the forms are zero [J]
  ShellResultants resultants;            ///< at forms of zero
  std::vector<LayerState> layer_states;  ///< likewise, in the order of model::LayerSource

  /// @param free  e_0 in the axes of the layer
  FreeStrains(const ElasticWall& wall, const LayerStrain& free);
};

}  // namespace culm::shell
