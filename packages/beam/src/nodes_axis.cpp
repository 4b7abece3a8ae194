#include "nodes_axis.hpp"

#include <culm/base/error.hpp>
#include <culm/math/lagrange.hpp>
#include <culm/math/rotation.hpp>

#include <Eigen/Geometry>
#include <fmt/format.h>

namespace culm::beam {

namespace {

constexpr double largest_defect = 1e-6;

Vec3 read_position(const Options& options, std::size_t node) {
  return Eigen::Map<const Vec3>(options.numbers("Positions").data() + 3 * node);
}

// d1, d2, d3 lie one behind the other, as the columns of the triad
Mat3 read_triad(const Options& options, std::size_t node) {
  return Eigen::Map<const Mat3>(options.numbers("Directors").data() + 9 * node);
}

void check_nodes(const Options& options, InputIssues& issues) {
  const std::size_t nodes = options.numbers("Positions").size() / 3;
  const std::size_t triads = options.numbers("Directors").size() / 9;
  if (nodes != triads) {
    issues.add(options.where("Directors"),
               fmt::format("must have nine values per node: {} nodes, {} triads", nodes, triads));
    return;
  }
  for (std::size_t i = 0; i < nodes; ++i) {
    const Mat3 triad = read_triad(options, i);
    const double defect = triad_defect(triad);
    if (!(defect <= largest_defect)) {
      issues.add(options.where("Directors"),
                 triad.determinant() < 0.0
                     ? fmt::format("node {}: directors are left-handed", i)
                     : fmt::format("node {}: directors are not orthonormal, |D^T D - 1| is {:.2g} "
                                   "and must be <= {:g}",
                                   i, defect, largest_defect));
    }
    if (i == 0) continue;
    const Vec3 step = read_position(options, i) - read_position(options, i - 1);
    if (step.norm() == 0.0) {
      issues.add(options.where("Positions"),
                 fmt::format("nodes {} and {} are at the same place", i - 1, i));
    } else if (read_triad(options, i - 1).col(2).dot(step) <= 0.0 ||
               triad.col(2).dot(step) <= 0.0) {
      issues.add(options.where("Directors"),
                 fmt::format("between nodes {} and {} d3 points against the axis", i - 1, i));
    }
  }
}

// The axis between the nodes of an element goes forward everywhere, which it does not where inner
// nodes are far from their places.
template <int Order>
bool goes_forward(const AxisNode* element) {
  constexpr int samples = 20;
  for (int i = 0; i <= samples; ++i) {
    const double xi = -1.0 + 2.0 * i / samples;
    const Vec<Order + 1> N = Lagrange<Order>::values(xi);
    const Vec<Order + 1> dN = Lagrange<Order>::derivatives(xi);
    Vec3 tangent = Vec3::Zero();
    Vec3 ahead = Vec3::Zero();
    for (int a = 0; a <= Order; ++a) {
      tangent += dN[a] * element[a].position;
      ahead += N[a] * element[a].triad.col(2);
    }
    if (tangent.dot(ahead) <= 0.0) return false;
  }
  return true;
}

bool goes_forward(int order, const AxisNode* element) {
  if (order == 1) return true;
  return order == 2 ? goes_forward<2>(element) : goes_forward<3>(element);
}

// A node between those of an element: interpolated as the element does, its triad made orthonormal.
template <int Order>
AxisNode between(const AxisNode* element, double xi) {
  const Vec<Order + 1> N = Lagrange<Order>::values(xi);
  AxisNode node{Vec3::Zero(), Mat3::Zero(), 0.0};
  for (int a = 0; a <= Order; ++a) {
    node.position += N[a] * element[a].position;
    node.triad += N[a] * element[a].triad;
    node.span += N[a] * element[a].span;
  }
  node.triad = nearest_rotation(node.triad);
  return node;
}

AxisNode between(int order, const AxisNode* element, double xi) {
  switch (order) {
    case 1:
      return between<1>(element, xi);
    case 2:
      return between<2>(element, xi);
    default:
      return between<3>(element, xi);
  }
}

Chain refine(const Chain& chain, const Density& density) {
  const int intervals = density.intervals();
  Chain refined{chain.front()};
  for (std::size_t first = 0; first + 1 < chain.size();
       first += static_cast<std::size_t>(density.order)) {
    for (int i = 1; i <= intervals; ++i) {
      refined.push_back(i % density.refinement == 0
                            ? chain[first + static_cast<std::size_t>(i / density.refinement)]
                            : between(density.order, &chain[first], -1.0 + 2.0 * i / intervals));
    }
  }
  return refined;
}

}  // namespace

Schema nodes_schema() {
  Schema schema("Nodes", "Nodes one by one, with their directors.");
  schema
      .add(numbers("Positions", "m", "Positions from start to end, three coordinates each.")
               .size_multiple_of(3)
               .min_size(6))
      .add(numbers("Directors", "1",
                   "Triads of the nodes, nine values each: d1, d2, d3; orthonormal, right-handed, "
                   "d3 along the axis.")
               .size_multiple_of(9)
               .min_size(18))
      .check(check_nodes);
  return schema;
}

Axis make_nodes(const Options& options, const Density& density) {
  const int order = density.order;
  const std::size_t count = options.numbers("Positions").size() / 3;
  if ((count - 1) % static_cast<std::size_t>(order) != 0) {
    throw InputError(options.where("Positions"),
                     fmt::format("elements of order {} need 1 more than a multiple of {} nodes, "
                                 "got {}",
                                 order, order, count));
  }
  Chain chain(count);
  for (std::size_t i = 0; i < count; ++i) {
    chain[i].position = read_position(options, i);
    chain[i].triad = nearest_rotation(read_triad(options, i));
    if (i > 0) {
      chain[i].span = chain[i - 1].span + (chain[i].position - chain[i - 1].position).norm();
    }
  }
  for (std::size_t first = 0; first + 1 < count; first += static_cast<std::size_t>(order)) {
    if (goes_forward(order, &chain[first])) continue;
    throw InputError(
        options.where("Positions"),
        fmt::format(
            "between nodes {} and {}, those of one element of order {}, the axis folds back: "
            "space them more evenly, or take 'Order' = 1",
            first, first + static_cast<std::size_t>(order), order));
  }
  const double length = chain.back().span;
  for (AxisNode& node : chain) node.span /= length;
  if (density.refinement > 1) chain = refine(chain, density);
  return {{std::move(chain)}};
}

}  // namespace culm::beam
