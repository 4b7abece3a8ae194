/// What all ways of modelling a beam share: its elements one by one, from the nodes of a chain.
#pragma once

#include <culm/beam/beam_elements.hpp>
#include <culm/beam/director_beam.hpp>
#include <culm/beam/helical_beam.hpp>
#include <culm/math/lagrange.hpp>
#include <culm/math/quadrature.hpp>
#include <culm/math/rotation.hpp>
#include <culm/model/batch.hpp>

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

inline HelicalBeam make_element(const Stretch<HelicalBeam>& stretch, const SectionTable& sections) {
  return {stretch.slots, stretch.section_at(sections, 0.0).stiffness, stretch.masses<2>(sections)};
}

// Length that one unit of xi stands for: the elements' own measure, so that loads per length and
// mass agree.
template <int Order>
double jacobian(const DirectorBeam<Order>&, const Stretch<DirectorBeam<Order>>& stretch,
                double xi) {
  return stretch.jacobian(xi);
}
inline double jacobian(const HelicalBeam& element, const Stretch<HelicalBeam>&, double) {
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

/// In files of their own, because each of these elements has a batch of its own to compile.
/// @param effect  name in the ledger
template <int Order>
ReferenceState add_kirchhoff(const std::string& effect, const Place& to);
template <int Order>
ReferenceState add_untwisted(const std::string& effect, const Place& to);
template <int Order>
ReferenceState add_untwisted_kirchhoff(const std::string& effect, const Place& to);
template <int Order>
ReferenceState add_linear(const std::string& effect, const Place& to);

}  // namespace culm::beam
