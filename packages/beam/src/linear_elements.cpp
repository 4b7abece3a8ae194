#include <culm/beam/linear_beam.hpp>

#include "director_elements.hpp"
#include "yielding_fibres.hpp"

namespace culm::beam {
namespace {

template <int Order>
double add_linear(const std::string& effect, const Place& to) {
  using Beam = DirectorBeam<Order>;
  auto& batch = model::elements<LinearBeam<Order>>(to.model, effect, to.damping);
  return add_all<Beam>(to, [&](const Beam& element, const Stretch<Beam>& stretch) {
    typename LinearBeam<Order>::Nodes reference;
    reference << to.first_node(), stretch.slots;
    std::array<int, Order + 2> nodes{to.structure.nodes.front()};
    std::copy(stretch.nodes.begin(), stretch.nodes.end(), nodes.begin() + 1);
    const int item = batch.add(LinearBeam<Order>(element, reference), nodes);
    set_expansion(batch, item, stretch, to.sections);
    add_yielding(batch, item, element, stretch, to);
    return Source{&batch, item};
  });
}

}  // namespace

void register_linear_elements(ElementFamilies& families) {
  add_director_families(families, {.fidelity = "Linear", .yields = true}, "linear",
                        []<int Order>(std::integral_constant<int, Order>, const std::string& effect,
                                      const Place& to) { return add_linear<Order>(effect, to); });
}

}  // namespace culm::beam
