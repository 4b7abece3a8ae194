#include <culm/model/massless.hpp>

#include <cmath>

namespace culm::model {

// A vector without any structure is mapped to zero in rows that are zero only.
std::vector<bool> slots_with_mass(const Model& model) {
  Coordinates irregular(model.nodes().reference().size());
  for (std::size_t i = 0; i < irregular.size(); ++i) {
    irregular[i] = std::fmod(0.6180339887498949 * static_cast<double>(i + 1), 1.0) + 0.1;
  }
  const Coordinates image = model.mass_times(irregular);
  std::vector<bool> result(image.size() / 3);
  for (std::size_t slot = 0; slot < result.size(); ++slot) result[slot] = image[3 * slot] != 0.0;
  return result;
}

}  // namespace culm::model
