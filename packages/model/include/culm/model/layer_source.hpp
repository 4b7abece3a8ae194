/// Strains and stresses within the wall of a structure.
#pragma once

#include <culm/math/types.hpp>
#include <culm/model/state.hpp>

#include <array>
#include <vector>

namespace culm::model {

/// Green-Lagrange strain and second Piola-Kirchhoff stress, Voigt order 11, 22, 33, 23, 13, 12 with
/// engineering shears, in the axes of a layer: 3 the normal of the reference, 1 the fibre.
struct LayerState {
  Vec6 strain;
  Vec6 stress;  ///< [N/m^2]
};

/// The heights within a layer at which its state is shown.
inline constexpr std::array<const char*, 3> layer_heights{"bottom", "middle", "top"};

/// Shows strains and stresses of the layers of the cells of a structure.
class LayerSource {
 public:
  virtual ~LayerSource() = default;
  /// How many layers each cell has.
  virtual int layers() const = 0;
  /// Whether this rank counts a cell; exactly one does.
  virtual bool owns(int cell) const = 0;
  /// States at the centre of a cell that is here: layer by layer from the bottom, at the heights
  /// above.
  virtual std::vector<LayerState> states(int cell, const Coordinates& q) const = 0;
};

}  // namespace culm::model
