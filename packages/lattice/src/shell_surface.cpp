#include <culm/base/nearest.hpp>

#include "surfaces.hpp"

#include <algorithm>
#include <limits>

namespace culm::lattice {
namespace {

// An edge in the reference: a line through its nodes in their order.
class Edge {
 public:
  Edge(const std::vector<int>& nodes, const model::NodeTable& table) {
    for (const int node : nodes) {
      const Vec3 place = model::NodeTable::slots(table.reference(), node).col(0);
      lengths_.push_back(places_.empty() ? 0.0 : lengths_.back() + (place - places_.back()).norm());
      places_.push_back(place);
    }
  }
  Vec3 first() const { return places_.front(); }
  Vec3 last() const { return places_.back(); }
  void turn() {
    std::ranges::reverse(places_);
    const double whole = lengths_.back();
    for (double& length : lengths_) length = whole - length;
    std::ranges::reverse(lengths_);
  }
  /// At a fraction of its length.
  Vec3 at(double fraction) const {
    const double wanted = fraction * lengths_.back();
    const auto above = std::upper_bound(lengths_.begin() + 1, lengths_.end() - 1, wanted);
    const auto k = static_cast<std::size_t>(above - lengths_.begin());
    const double share = (wanted - lengths_[k - 1]) / (lengths_[k] - lengths_[k - 1]);
    return places_[k - 1] + share * (places_[k] - places_[k - 1]);
  }

 private:
  std::vector<Vec3> places_;
  std::vector<double> lengths_;
};

std::optional<Edge> find_edge(const char* parameter, const Options& options,
                              const model::Structure& shell, model::BuildContext& context) {
  if (!options.has(parameter)) {
    context.issues.add(options.where(), "a surface on a shell needs '" + std::string(parameter) +
                                            "', the name of an edge");
    return {};
  }
  const std::string& name = options.text(parameter);
  std::vector<std::string> names;
  for (const auto& [edge, points] : shell.edges) names.push_back(edge);
  const auto found = shell.sets.find(name);
  if (!shell.edges.contains(name) || found == shell.sets.end()) {
    context.issues.add(options.where(parameter), "structure '" + shell.name + "' has no edge '" +
                                                     name + "'" + did_you_mean(name, names));
    return {};
  }
  return Edge(found->second, context.model.nodes());
}

// The point of a bilinear face that is nearest to a place.
struct Projection {
  double distance = std::numeric_limits<double>::infinity();
  Vec<4> weights = Vec<4>::Zero();
};

Vec<4> bilinear(double a, double b) {
  return 0.25 * Vec<4>((1 - a) * (1 - b), (1 + a) * (1 - b), (1 + a) * (1 + b), (1 - a) * (1 + b));
}

Projection project(const Vec3& place, const Mat<3, 4>& corners) {
  constexpr int iterations = 12;  // faces are nearly flat: a few suffice
  Eigen::Vector2d xi = Eigen::Vector2d::Zero();
  for (int k = 0; k < iterations; ++k) {
    const double a = xi.x(), b = xi.y();
    Mat<3, 2> tangents;
    tangents.col(0) = corners * (0.25 * Vec<4>(b - 1, 1 - b, 1 + b, -1 - b));
    tangents.col(1) = corners * (0.25 * Vec<4>(a - 1, -1 - a, 1 + a, 1 - a));
    const Vec3 miss = place - corners * bilinear(a, b);
    const Eigen::Matrix2d normal = tangents.transpose() * tangents;
    xi += normal.inverse() * (tangents.transpose() * miss);
    xi = xi.cwiseMax(-1.0).cwiseMin(1.0);
  }
  const Vec<4> weights = bilinear(xi.x(), xi.y());
  return {(place - corners * weights).norm(), weights};
}

model::Marker nearest_point(const Vec3& place, const model::Structure& shell,
                            const model::NodeTable& table) {
  Projection best;
  const model::Face* nearest = nullptr;
  for (const model::Face& face : shell.faces) {
    Mat<3, 4> corners;
    for (int a = 0; a < 4; ++a) {
      corners.col(a) =
          model::NodeTable::slots(table.reference(), face.nodes[static_cast<std::size_t>(a)])
              .col(0);
    }
    const Vec3 centre = corners.rowwise().mean();
    const double reach = (corners.colwise() - centre).colwise().norm().maxCoeff();
    if ((place - centre).norm() - reach > best.distance) continue;
    const Projection found = project(place, corners);
    if (found.distance >= best.distance) continue;
    best = found;
    nearest = &face;
  }
  return {{nearest->nodes.begin(), nearest->nodes.end()},
          {best.weights.begin(), best.weights.end()},
          Vec3::Zero()};
}

}  // namespace

std::optional<SurfaceGrid> shell_surface(const Options& options, const model::Structure& shell,
                                         const std::vector<double>& stations,
                                         model::BuildContext& context) {
  for (const char* of_beams : {"Chord", "Chords", "Positions", "Nose", "Axis At", "Camber"}) {
    if (!options.given(of_beams)) continue;
    context.issues.add(options.where(of_beams),
                       "structure '" + shell.name + "' is a shell: its shape says that");
    return {};
  }
  auto leading = find_edge("Leading Edge", options, shell, context);
  const auto trailing = find_edge("Trailing Edge", options, shell, context);
  if (!leading || !trailing) return {};
  const double straight =
      (leading->first() - trailing->first()).norm() + (leading->last() - trailing->last()).norm();
  const double crossed =
      (leading->first() - trailing->last()).norm() + (leading->last() - trailing->first()).norm();
  if (crossed < straight) leading->turn();
  SurfaceGrid grid{panels_of(options), {}};
  for (int i = 0; i <= grid.panels.chord; ++i) {
    const double xi = static_cast<double>(i) / grid.panels.chord;
    for (const double station : stations) {
      const Vec3 place = (1.0 - xi) * leading->at(station) + xi * trailing->at(station);
      grid.points.push_back(nearest_point(place, shell, context.model.nodes()));
    }
  }
  return grid;
}

}  // namespace culm::lattice
