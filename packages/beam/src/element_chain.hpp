/// What all ways of modelling a beam share: its elements one by one, from the nodes of a chain.
#pragma once

#include <culm/math/lagrange.hpp>
#include <culm/math/quadrature.hpp>
#include <culm/math/rotation.hpp>
#include <culm/model/element_batch.hpp>

#include "element_families.hpp"

#include <algorithm>
#include <array>
#include <memory>
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

  /// @param spans  of the nodes, see AxisNode
  Stretch(const model::NodeTable& table, const std::array<int, Beam::num_nodes>& numbers,
          const double* spans_of_nodes)
      : spans(Eigen::Map<const Vec<Beam::num_nodes>>(spans_of_nodes)), nodes(numbers) {
    for (int a = 0; a < Beam::num_nodes; ++a) {
      slots.template middleCols<4>(4 * a) =
          model::NodeTable::slots(table.reference(), nodes[index(a)]);
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

// The elements of a chain, for as long as somebody may make them.
template <class Beam>
class Stretches {
 public:
  explicit Stretches(const Place& of) : table_(of.model.nodes()), sections_(of.sections) {
    spans_.reserve(of.chain.size());
    for (const AxisNode& node : of.chain) spans_.push_back(node.span);
  }

  const SectionTable& sections() const { return sections_; }
  Stretch<Beam> of(const std::array<int, Beam::num_nodes>& nodes, int k) const {
    return {table_, nodes, spans_.data() + Stretch<Beam>::order * k};
  }
  Beam element(const std::array<int, Beam::num_nodes>& nodes, int k) const {
    return make_element(of(nodes, k), sections_);
  }

 private:
  const model::NodeTable& table_;
  SectionTable sections_;
  std::vector<double> spans_;  // of the nodes
};

// The nodes of each element of a chain.
template <class Beam>
std::vector<std::array<int, Beam::num_nodes>> nodes_of_elements(const Place& to) {
  constexpr std::size_t order = Beam::num_nodes - 1;
  std::vector<std::array<int, Beam::num_nodes>> all;
  all.reserve((to.nodes.size() - 1) / order);
  for (std::size_t first = 0; first + order < to.nodes.size(); first += order) {
    std::copy_n(to.nodes.begin() + static_cast<std::ptrdiff_t>(first), order + 1,
                all.emplace_back().begin());
  }
  return all;
}

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
void add_line_points(const Stretch<Beam>& stretch, const SectionTable& sections,
                     model::Structure& structure) {
  for (const auto& [xi, weight] : gauss_legendre(Beam::num_nodes)) {
    const auto N = Lagrange<Beam::num_nodes - 1>::values(xi);
    model::LinePoint point;
    point.marker.nodes.assign(stretch.nodes.begin(), stretch.nodes.end());
    point.marker.weights.assign(N.begin(), N.end());
    point.length = weight * jacobian(stretch, sections, xi);
    structure.line_points.push_back(std::move(point));
  }
}

// Adds elements, made of those of the chain, to their batch, and what belongs to each one to the
// structure; more(item, stretch) adds what else there is. A chain's element has
// make_element(stretch, sections) and jacobian(stretch, sections, xi) beside it, the length that
// one unit of xi stands for: its own measure, so that loads per length and mass agree.
// @return largest turn of an element in the reference [rad]
template <class Beam, class Element, class More>
double add_series(const Place& to, const Stretches<Beam>& stretches,
                  model::ElementSeries<Element> series, model::ElementBatch<Element>& batch,
                  More more) {
  const int first = batch.add(std::move(series));
  double largest_turn = 0.0;
  int k = 0;
  // of the only chain, mostly
  model::LinePoints& points = to.structure.line_points;
  if (points.empty()) points.reserve(to.nodes.size() / Stretch<Beam>::order * Beam::num_nodes);
  for (const auto& nodes : nodes_of_elements<Beam>(to)) {
    const Stretch<Beam> stretch = stretches.of(nodes, k);
    const int item = first + k++;
    largest_turn = std::max(largest_turn, stretch.turn());
    add_line_points(stretch, to.sections, to.structure);
    set_expansion(batch, item, stretch, to.sections);
    more(item, stretch);
    to.structure.cells.push_back({{nodes.begin(), nodes.end()}, &batch, item});
  }
  return largest_turn;
}

// All strains of the element are free.
template <class Beam, class More>
double add_full(const std::string& effect, const Place& to, More more) {
  auto& batch = model::elements<Beam>(to.model, effect, to.damping);
  const auto stretches = std::make_shared<const Stretches<Beam>>(to);
  return add_series<Beam, Beam>(
      to, *stretches,
      {nodes_of_elements<Beam>(to),
       [stretches](const auto& nodes, int k) { return stretches->element(nodes, k); }},
      batch, [&](int item, const Stretch<Beam>& stretch) { more(batch, item, stretch); });
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
  const Stretches<Beam> stretches(to);
  SlotMatrix<4> mass = SlotMatrix<4>::Zero();
  double largest_turn = 0.0;
  int k = 0;
  for (const auto& nodes : nodes_of_elements<Beam>(to)) {
    const Stretch<Beam> stretch = stretches.of(nodes, k++);
    largest_turn = std::max(largest_turn, stretch.turn());
    add_line_points(stretch, to.sections, to.structure);
    Mat<Beam::num_slots, 4> t;
    for (int a = 0; a < Beam::num_nodes; ++a) {
      t.template middleRows<4>(4 * a) = follow(master, stretch.slots.template middleCols<4>(4 * a));
    }
    mass += t.transpose() * make_element(stretch, to.sections).mass() * t;
    to.structure.cells.push_back({{nodes.begin(), nodes.end()}, nullptr, 0});
  }
  if (mass(0, 0) > 0.0) to.model.masses("Rigid beams").add(to.structure.nodes.front(), mass);
  return largest_turn;
}

}  // namespace culm::beam
