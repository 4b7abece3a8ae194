#include <culm/beam/kirchhoff_beam.hpp>
#include <culm/model/element_batch.hpp>

#include "element_chain.hpp"

namespace culm::beam {

template <int Order>
ReferenceState add_kirchhoff(const std::string& effect, const Place& to) {
  using Beam = DirectorBeam<Order>;
  auto& batch = model::elements<KirchhoffBeam<Order>>(to.model, effect, to.damping);
  return add_all<Beam>(
      to.chain, to.nodes, to.sections, to.structure,
      [&](const Beam& element, const Stretch<Beam>& stretch) {
        to.model.add_constraint(
            shear_free(to.structure.name, element, stretch.nodes, stretch.slots));
        return Source{&batch, batch.add(KirchhoffBeam<Order>(element), stretch.nodes)};
      });
}

template ReferenceState add_kirchhoff<1>(const std::string&, const Place&);
template ReferenceState add_kirchhoff<2>(const std::string&, const Place&);
template ReferenceState add_kirchhoff<3>(const std::string&, const Place&);

}  // namespace culm::beam
