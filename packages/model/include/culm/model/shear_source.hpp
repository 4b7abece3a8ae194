/// What straight directors make too stiff.
#pragma once

#include <culm/math/types.hpp>

#include <vector>

namespace culm::model {

/// A wall whose director stays straight, so that shear strains are the same through the thickness
/// although its layers shear by unequal amounts. A LayerSource may be one as well.
class ShearSource {
 public:
  struct Layer {
    double thickness;  ///< [m]
    double angle;      ///< of its axes from those of the wall, about the normal [rad]
  };

  virtual ~ShearSource() = default;
  /// From the bottom upward.
  virtual std::vector<Layer> shear_layers() const = 0;
  /// What is left out of the flexibility in transverse shear along axes 1, 2 of the wall, over what
  /// is there: 1/5 for a uniform wall; 0 with a shear correction.
  virtual Vec<2> left_out() const = 0;
};

}  // namespace culm::model
