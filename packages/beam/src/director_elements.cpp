#include "director_elements.hpp"

#include <culm/beam/element_batches.hpp>

#include "yielding_fibres.hpp"

namespace culm::beam {
namespace {

template <int Order>
double add_elements(const std::string& effect, const Place& to) {
  using Beam = DirectorBeam<Order>;
  return add_full<Beam>(effect, to, [&](auto& batch, int item, const Stretch<Beam>& stretch) {
    add_yielding(batch, item, stretch, to);
  });
}

}  // namespace

void register_director_elements(ElementFamilies& families) {
  add_director_families(families, {.fidelity = "Full", .yields = true}, "director",
                        []<int Order>(std::integral_constant<int, Order>, const std::string& effect,
                                      const Place& to) { return add_elements<Order>(effect, to); });
}

}  // namespace culm::beam
