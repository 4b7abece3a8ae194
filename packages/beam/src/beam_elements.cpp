#include <culm/beam/beam_elements.hpp>
#include <culm/beam/director_beam.hpp>
#include <culm/beam/helical_beam.hpp>
#include <culm/beam/kirchhoff_beam.hpp>
#include <culm/beam/linear_beam.hpp>
#include <culm/math/lagrange.hpp>
#include <culm/math/quadrature.hpp>
#include <culm/math/rotation.hpp>
#include <culm/model/element_batch.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <string>
#include <utility>

namespace culm::beam {

namespace {

// The nodes of one element.
template <class Beam>
struct Stretch {
  static constexpr int order = Beam::num_nodes - 1;
  using Shape = Lagrange<order>;

  typename Beam::Nodes slots;
  Vec<Beam::num_nodes> spans;
  std::array<int, Beam::num_nodes> nodes;

  Stretch(const Chain& chain, const std::vector<int>& numbers, std::size_t first) {
    for (int a = 0; a < Beam::num_nodes; ++a) {
      const std::size_t at = first + static_cast<std::size_t>(a);
      slots.template middleCols<4>(4 * a) << chain[at].position, chain[at].triad;
      spans[a] = chain[at].span;
      nodes[static_cast<std::size_t>(a)] = numbers[at];
    }
  }

  material::Section section_at(const SectionTable& sections, double xi) const {
    return sections.at(Shape::values(xi).dot(spans));
  }

  template <std::size_t Points>
  std::array<Mat3, Points> masses(const SectionTable& sections) const {
    std::array<Mat3, Points> result;
    const auto rule = gauss_legendre(Points);
    double sampled = 0.0;
    for (std::size_t g = 0; g < Points; ++g) {
      result[g] = section_at(sections, rule[g].xi).mass;
      sampled += 0.5 * rule[g].weight * result[g](0, 0);
    }
    // Tables that kink or jump within the element: it weighs what they say.
    if (sampled > 0.0) {
      const double factor = sections.mean_mass(spans[0], spans[order]) / sampled;
      for (Mat3& mass : result) mass *= factor;
    }
    return result;
  }

  double turn() const {
    const Mat3 first = slots.template middleCols<3>(1);
    const Mat3 last = slots.template middleCols<3>(4 * order + 1);
    return log_rotation(first.transpose() * last).norm();
  }

  // |dX/dxi| of the interpolated axis
  double jacobian(double xi) const {
    const auto dN = Shape::derivatives(xi);
    Vec3 tangent = Vec3::Zero();
    for (int a = 0; a <= order; ++a) tangent += dN[a] * slots.col(4 * a);
    return tangent.norm();
  }
};

template <int Order>
DirectorBeam<Order> make_element(const Stretch<DirectorBeam<Order>>& stretch,
                                 const SectionTable& sections) {
  std::array<Mat6, Order> stiffness;
  const auto rule = gauss_legendre(Order);
  for (std::size_t g = 0; g < stiffness.size(); ++g) {
    stiffness[g] = stretch.section_at(sections, rule[g].xi).stiffness;
  }
  return {stretch.slots, stiffness, stretch.template masses<Order + 1>(sections)};
}

HelicalBeam make_element(const Stretch<HelicalBeam>& stretch, const SectionTable& sections) {
  return {stretch.slots, stretch.section_at(sections, 0.0).stiffness, stretch.masses<2>(sections)};
}

// Length that one unit of xi stands for: the elements' own measure, so that loads per length and
// mass agree.
template <int Order>
double jacobian(const DirectorBeam<Order>&, const Stretch<DirectorBeam<Order>>& stretch,
                double xi) {
  return stretch.jacobian(xi);
}
double jacobian(const HelicalBeam& element, const Stretch<HelicalBeam>&, double) {
  return 0.5 * element.length();
}

template <class Beam>
void add_line_points(const Beam& element, const Stretch<Beam>& stretch,
                     model::Structure& structure) {
  for (const auto& [xi, weight] : gauss_legendre(Beam::num_nodes)) {
    const auto N = Lagrange<Beam::num_nodes - 1>::values(xi);
    model::LinePoint point;
    point.marker.nodes.assign(stretch.nodes.begin(), stretch.nodes.end());
    point.marker.weights.assign(N.begin(), N.end());
    point.length = weight * jacobian(element, stretch, xi);
    structure.line_points.push_back(std::move(point));
  }
}

// Calls add(element, stretch) for all elements of a chain; what it returns becomes their cell.
template <class Beam, class Add>
ReferenceState add_all(const Chain& chain, const std::vector<int>& nodes,
                       const SectionTable& sections, model::Structure& structure, Add&& add) {
  ReferenceState reference;
  constexpr std::size_t order = Beam::num_nodes - 1;
  for (std::size_t first = 0; first + order < chain.size(); first += order) {
    const Stretch<Beam> stretch(chain, nodes, first);
    const Beam element = make_element(stretch, sections);
    reference.largest_turn = std::max(reference.largest_turn, stretch.turn());
    add_line_points(element, stretch, structure);
    const auto [source, item] = add(element, stretch);
    structure.cells.push_back({{stretch.nodes.begin(), stretch.nodes.end()}, source, item});
  }
  return reference;
}

using Source = std::pair<const model::ResultantSource*, int>;

// Where elements of a chain go.
struct Place {
  const Chain& chain;
  const std::vector<int>& nodes;
  const SectionTable& sections;
  const model::StrainDamping& damping;
  model::Model& model;
  model::Structure& structure;

  model::NodeSlots first_node() const {
    return model::NodeTable::slots(model.nodes().reference(), structure.nodes.front());
  }
};

template <class Beam>
ReferenceState add_full(const std::string& effect, const Place& to) {
  auto& batch = model::elements<Beam>(to.model, effect, to.damping);
  return add_all<Beam>(to.chain, to.nodes, to.sections, to.structure,
                       [&](const Beam& element, const Stretch<Beam>& stretch) {
                         return Source{&batch, batch.add(element, stretch.nodes)};
                       });
}

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
ReferenceState add_director(Fidelity fidelity, const Place& to) {
  const auto effect = [](const char* kind) {
    return fmt::format("Beam, {}, order {}", kind, Order);
  };
  switch (fidelity) {
    case Fidelity::kirchhoff:
      return add_kirchhoff<Order>(effect("Kirchhoff"), to);
    case Fidelity::linear:
      return add_linear<Order>(effect("linear"), to);
    case Fidelity::rigid:
      return add_rigid<DirectorBeam<Order>>(to);
    case Fidelity::full:
      break;
  }
  return add_full<DirectorBeam<Order>>(effect("director"), to);
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
      return add_director<1>(choice.fidelity, to);
    case ElementKind::director_2:
      return add_director<2>(choice.fidelity, to);
    case ElementKind::director_3:
      return add_director<3>(choice.fidelity, to);
    case ElementKind::helical:
      break;
  }
  return choice.fidelity == Fidelity::rigid ? add_rigid<HelicalBeam>(to)
                                            : add_full<HelicalBeam>("Beam, helical", to);
}

}  // namespace culm::beam
