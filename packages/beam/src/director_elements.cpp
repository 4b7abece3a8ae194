#include "director_elements.hpp"

#include <culm/beam/element_batches.hpp>

#include "yielding_fibres.hpp"

namespace culm::beam {
namespace {

template <int Order>
double add_elements(const std::string& effect, const Place& to) {
  using Beam = DirectorBeam<Order>;
  auto& batch = model::elements<Beam>(to.model, effect, to.damping);
  return add_all<Beam>(to, [&](const Beam& element, const Stretch<Beam>& stretch) {
    const int item = batch.add(element, stretch.nodes);
    set_expansion(batch, item, stretch, to.sections);
    add_yielding(batch, item, element, stretch, to);
    return Source{&batch, item};
  });
}

}  // namespace

void register_director_elements(ElementFamilies& families) {
  add_director_families(families, {.fidelity = "Full", .yields = true}, "director",
                        []<int Order>(std::integral_constant<int, Order>, const std::string& effect,
                                      const Place& to) { return add_elements<Order>(effect, to); });
}

}  // namespace culm::beam
