#include <culm/beam/element_batches.hpp>

#include "element_chain.hpp"

#include <fmt/format.h>

namespace culm::beam {

namespace {

template <class Beam>
ReferenceState add_full(const std::string& effect, const Place& to) {
  auto& batch = model::elements<Beam>(to.model, effect, to.damping);
  return add_all<Beam>(to.chain, to.nodes, to.sections, to.structure,
                       [&](const Beam& element, const Stretch<Beam>& stretch) {
                         return Source{&batch, batch.add(element, stretch.nodes)};
                       });
}

// The slots of a node that follows another one, q_s = sum_k t_sk Q_k.
Mat<4, 4> follow(const model::NodeSlots& master, const Slots<4>& slave) {
  const Mat3 triad = master.rightCols<3>();
  Mat<4, 4> t = Mat<4, 4>::Zero();
  t(0, 0) = 1.0;
  t.row(0).tail<3>() = (triad.transpose() * (slave.col(0) - master.col(0))).transpose();
  t.bottomRightCorner<3, 3>() = (triad.transpose() * slave.rightCols<3>()).transpose();
  return t;
}

template <class Beam>
ReferenceState add_rigid(const Place& to) {
  const model::NodeSlots master = to.first_node();
  SlotMatrix<4> mass = SlotMatrix<4>::Zero();
  const auto reference = add_all<Beam>(to.chain, to.nodes, to.sections, to.structure,
                                       [&](const Beam& element, const Stretch<Beam>& stretch) {
                                         Mat<Beam::num_slots, 4> t;
                                         for (int a = 0; a < Beam::num_nodes; ++a) {
                                           t.template middleRows<4>(4 * a) = follow(
                                               master, stretch.slots.template middleCols<4>(4 * a));
                                         }
                                         mass += t.transpose() * element.mass() * t;
                                         return Source{nullptr, 0};
                                       });
  if (mass(0, 0) > 0.0) to.model.masses("Rigid beams").add(to.structure.nodes.front(), mass);
  return reference;
}

template <int Order>
ReferenceState add_director(Fidelity fidelity, bool torsion, const Place& to) {
  const auto effect = [](const char* kind) {
    return fmt::format("Beam, {}, order {}", kind, Order);
  };
  switch (fidelity) {
    case Fidelity::kirchhoff:
      return torsion ? add_kirchhoff<Order>(effect("Kirchhoff"), to)
                     : add_untwisted_kirchhoff<Order>(effect("Kirchhoff without torsion"), to);
    case Fidelity::linear:
      return add_linear<Order>(effect("linear"), to);
    case Fidelity::rigid:
      return add_rigid<DirectorBeam<Order>>(to);
    case Fidelity::full:
      break;
  }
  return torsion ? add_full<DirectorBeam<Order>>(effect("director"), to)
                 : add_untwisted<Order>(effect("director without torsion"), to);
}

}  // namespace

int order_of(ElementKind kind) {
  switch (kind) {
    case ElementKind::director_2:
      return 2;
    case ElementKind::director_3:
      return 3;
    case ElementKind::director_1:
    case ElementKind::helical:
      break;
  }
  return 1;
}

ReferenceState add_elements(const ElementChoice& choice, const Chain& chain,
                            const std::vector<int>& nodes, const SectionTable& sections,
                            model::Model& model, model::Structure& structure) {
  const Place to{chain, nodes, sections, choice.damping, model, structure};
  switch (choice.kind) {
    case ElementKind::director_1:
      return add_director<1>(choice.fidelity, choice.torsion, to);
    case ElementKind::director_2:
      return add_director<2>(choice.fidelity, choice.torsion, to);
    case ElementKind::director_3:
      return add_director<3>(choice.fidelity, choice.torsion, to);
    case ElementKind::helical:
      break;
  }
  return choice.fidelity == Fidelity::rigid ? add_rigid<HelicalBeam>(to)
                                            : add_full<HelicalBeam>("Beam, helical", to);
}

}  // namespace culm::beam
