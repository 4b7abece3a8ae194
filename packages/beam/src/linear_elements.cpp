#include <culm/beam/linear_beam.hpp>
#include <culm/model/element_batch.hpp>

#include "element_chain.hpp"

namespace culm::beam {

template <int Order>
ReferenceState add_linear(const std::string& effect, const Place& to) {
  using Beam = DirectorBeam<Order>;
  auto& batch = model::elements<LinearBeam<Order>>(to.model, effect, to.damping);
  return add_all<Beam>(
      to.chain, to.nodes, to.sections, to.structure,
      [&](const Beam& element, const Stretch<Beam>& stretch) {
        typename LinearBeam<Order>::Nodes reference;
        reference << to.first_node(), stretch.slots;
        std::array<int, Order + 2> nodes{to.structure.nodes.front()};
        std::copy(stretch.nodes.begin(), stretch.nodes.end(), nodes.begin() + 1);
        return Source{&batch, batch.add(LinearBeam<Order>(element, reference), nodes)};
      });
}

template ReferenceState add_linear<1>(const std::string&, const Place&);
template ReferenceState add_linear<2>(const std::string&, const Place&);
template ReferenceState add_linear<3>(const std::string&, const Place&);

}  // namespace culm::beam
