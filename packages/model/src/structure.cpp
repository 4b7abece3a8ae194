#include <culm/math/lagrange.hpp>
#include <culm/model/structure.hpp>

#include <algorithm>

namespace culm::model {

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
    length += structure.line_points[k].length;
    end[k / per_element] = length;
  }
  const double wanted = fraction * length;
  const auto last = end.end() - 1;
  const auto cell =
      static_cast<std::size_t>(std::lower_bound(end.begin(), last, wanted) - end.begin());
  const double begin = cell == 0 ? 0.0 : end[cell - 1];
  const double xi = 2.0 * (wanted - begin) / (end[cell] - begin) - 1.0;
  const std::vector<int>& nodes = structure.cells[cell].nodes;
  for (std::size_t a = 0; a < nodes.size(); ++a) {
    const double at = -1.0 + 2.0 * static_cast<double>(a) / static_cast<double>(nodes.size() - 1);
    if (std::abs(xi - at) < 1e-9) return marker_at(nodes[a]);
  }
  return Marker{nodes, shape_values(nodes.size(), xi), Vec3::Zero()};
}

}  // namespace culm::model
