#include <culm/contact/line_element.hpp>
#include <culm/math/lagrange.hpp>
#include <culm/model/node_table.hpp>

#include <algorithm>
#include <cmath>

namespace culm::contact {
namespace {

template <int Order>
Vec<4> shape_of(double xi) {
  Vec<4> shape = Vec<4>::Zero();
  shape.head<Order + 1>() = Lagrange<Order>::values(xi);
  return shape;
}

// N_a of an element with 2 to 4 nodes.
Vec<4> shape_of(std::size_t nodes, double xi) {
  if (nodes == 2) return shape_of<1>(xi);
  return nodes == 3 ? shape_of<2>(xi) : shape_of<3>(xi);
}

}  // namespace

Vec3 place_on(const LineElement& element, const Vec<4>& shape, const model::Coordinates& q) {
  Vec3 x = Vec3::Zero();
  for (std::size_t a = 0; a < element.nodes.size(); ++a) {
    x += shape[static_cast<int>(a)] * model::NodeTable::slots(q, element.nodes[a]).col(0);
  }
  return x;
}

std::vector<LineElement> divide(const std::vector<model::LinePoint>& points,
                                const model::Coordinates& reference, double spacing) {
  std::vector<LineElement> elements;
  std::vector<double> lengths;
  for (const model::LinePoint& point : points) {
    if (elements.empty() || elements.back().nodes != point.marker.nodes) {
      elements.push_back({point.marker.nodes, {}, {}});
      lengths.push_back(0.0);
    }
    lengths.back() += point.length;
  }
  for (std::size_t e = 0; e < elements.size(); ++e) {
    LineElement& element = elements[e];
    const auto place = [&](double xi) {
      return place_on(element, shape_of(element.nodes.size(), xi), reference);
    };
    const int count = std::max(1, static_cast<int>(std::ceil(lengths[e] / spacing)));
    for (int k = 0; k < count; ++k) {
      element.shapes.push_back(shape_of(element.nodes.size(), (2.0 * k + 1.0) / count - 1.0));
      element.lengths.push_back(
          (place(2.0 * (k + 1) / count - 1.0) - place(2.0 * k / count - 1.0)).norm());
    }
  }
  return elements;
}

// No point is further from the mean of the nodes than the furthest node times the largest sum of
// all |N_a|, Lebesgue's constant.
Ball ball_about(const LineElement& element, const model::Coordinates& q) {
  constexpr double lebesgue[] = {1.0, 1.25, 1.64};
  Ball ball;
  for (const int node : element.nodes) ball.centre += model::NodeTable::slots(q, node).col(0);
  ball.centre /= static_cast<double>(element.nodes.size());
  for (const int node : element.nodes) {
    ball.radius =
        std::max(ball.radius, (model::NodeTable::slots(q, node).col(0) - ball.centre).norm());
  }
  ball.radius *= lebesgue[element.nodes.size() - 2];
  return ball;
}

}  // namespace culm::contact
