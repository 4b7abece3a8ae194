#include <culm/shell/subdivision.hpp>

#include <Eigen/Geometry>

#include <algorithm>
#include <array>
#include <map>
#include <set>
#include <utility>

namespace culm::shell {
namespace {

// The cubic edge from a corner to the next one, by its control points.
struct Edge {
  std::array<Vec3, 4> points;

  Vec3 at(double t) const {
    const double s = 1.0 - t;
    return s * s * s * points[0] + 3.0 * s * s * t * points[1] + 3.0 * s * t * t * points[2] +
           t * t * t * points[3];
  }
};

// A surface within four edges.
class Patch {
 public:
  explicit Patch(std::array<Edge, 4> edges) : edges_(std::move(edges)) {}

  Vec3 at(double u, double v) const {
    const auto corner = [&](std::size_t c) { return edges_[c].points[0]; };
    const Vec3 across = (1.0 - v) * edges_[0].at(u) + v * edges_[2].at(1.0 - u);
    const Vec3 up = (1.0 - u) * edges_[3].at(1.0 - v) + u * edges_[1].at(v);
    const Vec3 corners = (1.0 - u) * (1.0 - v) * corner(0) + u * (1.0 - v) * corner(1) +
                         u * v * corner(2) + (1.0 - u) * v * corner(3);
    return across + up - corners;
  }

  Vec3 normal(double u, double v) const {
    constexpr double h = 1e-4;  // of cubic polynomials: exact to 1e-8
    return (at(u + h, v) - at(u - h, v)).cross(at(u, v + h) - at(u, v - h)).normalized();
  }

 private:
  std::array<Edge, 4> edges_;
};

// Draws patches through the corners of a mesh.
class Patches {
 public:
  Patches(const Facets& facets, const ShellMesh& mesh) : facets_(facets), mesh_(mesh) {
    for (std::size_t q = 0; q < facets.quads.size(); ++q) {
      for (std::size_t c = 0; c < 4; ++c) {
        nodes_[side(q, c)].insert(mesh.quads[q][c]);
        nodes_[{side(q, c).second, side(q, c).first}].insert(mesh.quads[q][(c + 1) % 4]);
      }
    }
  }

  Patch of(std::size_t quad) const {
    return Patch({edge(quad, 0), edge(quad, 1), edge(quad, 2), edge(quad, 3)});
  }

 private:
  using Side = std::pair<int, int>;  // points

  Side side(std::size_t quad, std::size_t corner) const {
    const auto& points = facets_.quads[quad];
    return {points[corner], points[(corner + 1) % 4]};
  }

  // The control point near an end: a third of the way, in the plane normal to the director.
  Vec3 near(int from, int to, int node) const {
    const Vec3& p = facets_.points[index(from)];
    const Vec3 way = facets_.points[index(to)] - p;
    const bool is_folded = nodes_.at({from, to}).size() > 1;
    if (is_folded) return p + way / 3.0;
    const Vec3& n = mesh_.directors[index(node)];
    return p + (way - way.dot(n) * n) / 3.0;
  }

  Edge edge(std::size_t quad, std::size_t corner) const {
    const auto [from, to] = side(quad, corner);
    const auto& nodes = mesh_.quads[quad];
    return {{facets_.points[index(from)], near(from, to, nodes[corner]),
             near(to, from, nodes[(corner + 1) % 4]), facets_.points[index(to)]}};
  }

  const Facets& facets_;
  const ShellMesh& mesh_;
  std::map<Side, std::set<int>> nodes_;  // at the first point of a side, of all its quadrilaterals
};

// Numbers of the parts of a quadrilateral: n x n of them, row by row.
class Parts {
 public:
  explicit Parts(int n) : n_(n) {}

  int quad(int parent, int i, int j) const { return (parent * n_ + j) * n_ + i; }

  // The part in a corner of its parent, where it has the same corner.
  Corner at_corner(const Corner& c) const {
    const int i = c.corner == 1 || c.corner == 2 ? n_ - 1 : 0;
    const int j = c.corner >= 2 ? n_ - 1 : 0;
    return {quad(c.quad, i, j), c.corner};
  }

  // Both ends of each of the n pieces of the side from a corner to the next one.
  std::vector<Corner> along_side(const Corner& from) const {
    std::vector<Corner> ends;
    for (int k = 0; k < n_; ++k) {
      const int back = n_ - 1 - k;
      const std::array<std::pair<int, int>, 4> places = {
          {{k, 0}, {n_ - 1, k}, {back, n_ - 1}, {0, back}}};
      const auto [i, j] = places[index(from.corner)];
      const int piece = quad(from.quad, i, j);
      ends.push_back({piece, from.corner});
      ends.push_back({piece, (from.corner + 1) % 4});
    }
    return ends;
  }

  // The same from a corner to the one before it.
  std::vector<Corner> against_side(const Corner& from) const {
    std::vector<Corner> ends = along_side({from.quad, (from.corner + 3) % 4});
    std::ranges::reverse(ends);
    return ends;
  }

 private:
  int n_;
};

// Between the ends of a side are those of its parts.
std::vector<Corner> divide_line(const std::vector<Corner>& edge, const Parts& parts) {
  const std::vector<int> partners = partners_along(edge);
  std::vector<Corner> fine;
  for (std::size_t i = 0; i < edge.size(); ++i) {
    std::vector<Corner> next;
    if (partners[i] < 0) {
      next = {parts.at_corner(edge[i])};
    } else if (partners[i] > static_cast<int>(i)) {
      const bool is_ahead = (edge[i].corner + 1) % 4 == edge[index(partners[i])].corner;
      next = is_ahead ? parts.along_side(edge[i]) : parts.against_side(edge[i]);
    }
    fine.insert(fine.end(), next.begin(), next.end());
  }
  return fine;
}

std::vector<Corner> keep_points(const std::vector<Corner>& points, const Parts& parts) {
  std::vector<Corner> fine;
  for (const Corner& corner : points) fine.push_back(parts.at_corner(corner));
  return fine;
}

}  // namespace

Facets subdivide(const Facets& coarse, const ShellMesh& mesh, int refinement) {
  const int n = refinement;
  const Parts numbers(n);
  const Patches patches(coarse, mesh);
  Facets fine;
  for (std::size_t q = 0; q < coarse.quads.size(); ++q) {
    const Patch patch = patches.of(q);
    const auto first = static_cast<int>(fine.points.size());
    const auto point = [&](int i, int j) { return first + j * (n + 1) + i; };
    const auto share = [&](int i) { return static_cast<double>(i) / n; };
    const auto normal = [&](int i, int j) { return patch.normal(share(i), share(j)); };
    for (int j = 0; j <= n; ++j) {
      for (int i = 0; i <= n; ++i) fine.points.push_back(patch.at(share(i), share(j)));
    }
    for (int j = 0; j < n; ++j) {
      for (int i = 0; i < n; ++i) {
        fine.quads.push_back({point(i, j), point(i + 1, j), point(i + 1, j + 1), point(i, j + 1)});
        fine.normals.push_back(
            {normal(i, j), normal(i + 1, j), normal(i + 1, j + 1), normal(i, j + 1)});
        fine.parents.push_back(static_cast<int>(q));
      }
    }
  }
  for (const auto& [name, edge] : coarse.edges) {
    const bool is_line = !coarse.points_only.contains(name);
    fine.edges[name] = is_line ? divide_line(edge, numbers) : keep_points(edge, numbers);
  }
  fine.points_only = coarse.points_only;
  for (const auto& [name, part] : coarse.parts) {
    for (int q : part) {
      for (int k = 0; k < n * n; ++k) fine.parts[name].push_back(q * n * n + k);
    }
  }
  return fine;
}

}  // namespace culm::shell
