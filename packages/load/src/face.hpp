/// Faces of shells that loads per area act on.
#pragma once

#include <culm/model/build_context.hpp>

#include <vector>

namespace culm::load {

/// Parameters "Structure" and "Face" of a load per area.
Schema face_fields();
/// A face with the place of its loaded surface along the directors.
struct LoadedFace {
  std::array<int, 4> nodes;
  double zeta;  ///< [m]
};
/// The faces that the parameters name; none, and an issue, if there are none.
std::vector<LoadedFace> loaded_faces(const Options& options, model::BuildContext& context);

}  // namespace culm::load
