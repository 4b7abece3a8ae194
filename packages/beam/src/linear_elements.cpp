#include <culm/beam/linear_beam.hpp>

#include "director_elements.hpp"
#include "yielding_fibres.hpp"

namespace culm::beam {
namespace {

template <int Order>
double add_linear(const std::string& effect, const Place& to) {
  using Beam = DirectorBeam<Order>;
  auto& batch = model::elements<LinearBeam<Order>>(to.model, effect, to.damping);
  const auto stretches = std::make_shared<const Stretches<Beam>>(to);
  const model::NodeSlots frame = to.first_node();
  model::ElementSeries<LinearBeam<Order>> series;
  for (const auto& nodes : nodes_of_elements<Beam>(to)) {
    auto& all = series.nodes.emplace_back();
    all[0] = to.structure.nodes.front();
    std::ranges::copy(nodes, all.begin() + 1);
  }
  series.make = [stretches, frame](const auto& all, int k) {
    std::array<int, Order + 1> nodes;
    std::copy(all.begin() + 1, all.end(), nodes.begin());
    const Stretch<Beam> stretch = stretches->of(nodes, k);
    typename LinearBeam<Order>::Nodes reference;
    reference << frame, stretch.slots;
    return LinearBeam<Order>(make_element(stretch, stretches->sections()), reference);
  };
  return add_series<Beam>(
      to, *stretches, std::move(series), batch,
      [&](int item, const Stretch<Beam>& stretch) { add_yielding(batch, item, stretch, to); });
}

}  // namespace

void register_linear_elements(ElementFamilies& families) {
  add_director_families(families, {.fidelity = "Linear", .yields = true}, "linear",
                        []<int Order>(std::integral_constant<int, Order>, const std::string& effect,
                                      const Place& to) { return add_linear<Order>(effect, to); });
}

}  // namespace culm::beam
