#include <culm/model/massless.hpp>

#include <span>

namespace culm::model {

std::vector<bool> slots_with_mass(const Model& model) {
  std::vector<bool> result(4 * static_cast<std::size_t>(model.nodes().size()), false);
  for (const auto& batch : model.element_batches()) {
    const auto* source = dynamic_cast<const MassSource*>(batch.get());
    if (source == nullptr) continue;
    source->visit_masses([&](std::span<const int> nodes, const Eigen::MatrixXd& mass) {
      for (std::size_t a = 0; a < nodes.size(); ++a) {
        for (int s = 0; s < 4; ++s) {
          const auto slot = static_cast<std::size_t>(4 * nodes[a] + s);
          if (!mass.row(static_cast<Eigen::Index>(4 * a) + s).isZero(0.0)) result[slot] = true;
        }
      }
    });
  }
  return result;
}

}  // namespace culm::model
