#include <culm/contact/gripping_batch.hpp>

#include <algorithm>

namespace culm::contact {

void GrippingBatch::save(model::Items items, std::span<double> numbers) const {
  if (!has_grips()) return;
  for (std::size_t i = 0; i < placement().items.size(); ++i) {
    if (items == model::Items::owned && !placement().owned[i]) continue;
    const int item = placement().items[i];
    std::ranges::copy(grip(item), numbers.begin() + 3 * item);
  }
}

void GrippingBatch::restore(std::span<const double> numbers) {
  for (std::size_t i = 0; i < grips_.size(); ++i) grips_[i] = Vec3(numbers.data() + 3 * i);
}

}  // namespace culm::contact
