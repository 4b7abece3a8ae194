#include <culm/base/error.hpp>
#include <culm/math/arc_length.hpp>
#include <culm/math/lagrange.hpp>
#include <culm/model/structure.hpp>

#include <algorithm>
#include <numeric>

namespace culm::model {

void LinePoints::push_back(const LinePoint& point) {
  const Marker& marker = point.marker;
  if (empty()) per_point_ = marker.nodes.size();
  internal_check(marker.nodes.size() == per_point_ && marker.offset.isZero(0.0),
                 "points of a line are of one kind, and on its axis");
  nodes_.insert(nodes_.end(), marker.nodes.begin(), marker.nodes.end());
  weights_.insert(weights_.end(), marker.weights.begin(), marker.weights.end());
  lengths_.push_back(point.length);
}

LinePoint LinePoints::operator[](std::size_t i) const {
  const int* const node = nodes_.data() + per_point_ * i;
  const double* const weight = weights_.data() + per_point_ * i;
  return {{{node, node + per_point_}, {weight, weight + per_point_}, Vec3::Zero()}, lengths_[i]};
}

double LinePoints::length() const { return std::accumulate(lengths_.begin(), lengths_.end(), 0.0); }

std::vector<LinePoint> LinePoints::copy(std::size_t first, std::size_t count) const {
  std::vector<LinePoint> points;
  points.reserve(count);
  for (std::size_t i = first; i < first + count; ++i) points.push_back((*this)[i]);
  return points;
}

std::vector<int> Structure::cells_of(int number) const {
  if (deck.cells.empty()) return {number};
  return deck.cells[static_cast<std::size_t>(number)];
}
namespace {

template <int Order>
std::vector<double> shape_values(double xi) {
  const auto N = Lagrange<Order>::values(xi);
  return {N.begin(), N.end()};
}

std::vector<double> shape_values(std::size_t nodes, double xi) {
  if (nodes == 2) return shape_values<1>(xi);
  return nodes == 3 ? shape_values<2>(xi) : shape_values<3>(xi);
}

}  // namespace

std::optional<Marker> marker_at_fraction(const Structure& structure, double fraction) {
  if (structure.line_points.empty()) return {};
  // all elements of a structure are of one kind, hence have as many points
  const std::size_t per_element = structure.line_points.size() / structure.cells.size();
  std::vector<double> end(structure.cells.size(), 0.0);  // length up to the end of each element
  double length = 0.0;
  for (std::size_t k = 0; k < structure.line_points.size(); ++k) {
    length += structure.line_points.length(k);
    end[k / per_element] = length;
  }
  const double wanted = fraction * length;
  const auto last = end.end() - 1;
  const auto cell =
      static_cast<std::size_t>(std::lower_bound(end.begin(), last, wanted) - end.begin());
  const double begin = cell == 0 ? 0.0 : end[cell - 1];
  std::vector<double> shares(per_element);
  for (std::size_t k = 0; k < per_element; ++k) {
    shares[k] = structure.line_points.length(cell * per_element + k);
  }
  const double xi = ArcLength(shares).xi_at(wanted - begin);
  const CellNodes& nodes = structure.cells[cell].nodes;
  for (std::size_t a = 0; a < nodes.size(); ++a) {
    const double at = -1.0 + 2.0 * static_cast<double>(a) / static_cast<double>(nodes.size() - 1);
    if (std::abs(xi - at) < 1e-9) return marker_at(nodes[a]);
  }
  return Marker{{nodes.begin(), nodes.end()}, shape_values(nodes.size(), xi), Vec3::Zero()};
}

}  // namespace culm::model
