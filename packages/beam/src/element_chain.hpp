/// What all ways of modelling a beam share: its elements one by one, from the nodes of a chain.
#pragma once

#include <culm/math/lagrange.hpp>
#include <culm/math/quadrature.hpp>
#include <culm/math/rotation.hpp>
#include <culm/model/element_batch.hpp>

#include "element_families.hpp"

#include <algorithm>
#include <array>
#include <string>
#include <utility>

namespace culm::beam {

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

// Tells the batch how much an element grows per kelvin, if it does.
template <class Element, class Beam>
void set_expansion(model::ElementBatch<Element>& batch, int item, const Stretch<Beam>& stretch,
                   const SectionTable& sections) {
  Vec<Element::num_points> expansion;
  const auto rule = gauss_legendre(Element::num_points);
  for (int p = 0; p < Element::num_points; ++p) {
    expansion[p] = stretch.section_at(sections, rule[static_cast<std::size_t>(p)].xi).expansion;
  }
  if (!expansion.isZero(0.0)) batch.set_expansion(item, expansion);
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

using Source = std::pair<const model::ResultantSource*, int>;

// Calls add(element, stretch) for all elements of a chain; what it returns becomes their cell. An
// element has make_element(stretch, sections) and jacobian(element, stretch, xi) beside it, the
// length that one unit of xi stands for: its own measure, so that loads per length and mass agree.
template <class Beam, class Add>
double add_all(const Place& to, Add&& add) {
  double largest_turn = 0.0;
  constexpr std::size_t order = Beam::num_nodes - 1;
  for (std::size_t first = 0; first + order < to.chain.size(); first += order) {
    const Stretch<Beam> stretch(to.chain, to.nodes, first);
    const Beam element = make_element(stretch, to.sections);
    largest_turn = std::max(largest_turn, stretch.turn());
    add_line_points(element, stretch, to.structure);
    const auto [source, item] = add(element, stretch);
    to.structure.cells.push_back({{stretch.nodes.begin(), stretch.nodes.end()}, source, item});
  }
  return largest_turn;
}

// All strains of the element are free.
template <class Beam>
double add_full(const std::string& effect, const Place& to) {
  auto& batch = model::elements<Beam>(to.model, effect, to.damping);
  batch.expect(static_cast<int>((to.chain.size() - 1) / (Beam::num_nodes - 1)));
  return add_all<Beam>(to, [&](const Beam& element, const Stretch<Beam>& stretch) {
    const int item = batch.add(element, stretch.nodes);
    set_expansion(batch, item, stretch, to.sections);
    return Source{&batch, item};
  });
}

// The slots of a node that follows another one, q_s = sum_k t_sk Q_k.
inline Mat<4, 4> follow(const model::NodeSlots& master, const Slots<4>& slave) {
  const Mat3 triad = master.rightCols<3>();
  Mat<4, 4> t = Mat<4, 4>::Zero();
  t(0, 0) = 1.0;
  t.row(0).tail<3>() = (triad.transpose() * (slave.col(0) - master.col(0))).transpose();
  t.bottomRightCorner<3, 3>() = (triad.transpose() * slave.rightCols<3>()).transpose();
  return t;
}

// Only the mass of the elements, at the first node of the structure, which all others follow.
template <class Beam>
double add_rigid(const Place& to) {
  const model::NodeSlots master = to.first_node();
  SlotMatrix<4> mass = SlotMatrix<4>::Zero();
  const double largest_turn =
      add_all<Beam>(to, [&](const Beam& element, const Stretch<Beam>& stretch) {
        Mat<Beam::num_slots, 4> t;
        for (int a = 0; a < Beam::num_nodes; ++a) {
          t.template middleRows<4>(4 * a) =
              follow(master, stretch.slots.template middleCols<4>(4 * a));
        }
        mass += t.transpose() * element.mass() * t;
        return Source{nullptr, 0};
      });
  if (mass(0, 0) > 0.0) to.model.masses("Rigid beams").add(to.structure.nodes.front(), mass);
  return largest_turn;
}

}  // namespace culm::beam
