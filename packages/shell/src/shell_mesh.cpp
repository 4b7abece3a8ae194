#include <culm/shell/shell_mesh.hpp>

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <set>
#include <unordered_map>
#include <utility>

namespace culm::shell {

namespace {

double angle_between(const Vec3& a, const Vec3& b) {
  return std::atan2(a.cross(b).norm(), a.dot(b));
}

// Of those that have a length: elements without all edges are refused later.
double shortest_edge(const Facets& facets) {
  double shortest = std::numeric_limits<double>::max();
  for (const auto& quad : facets.quads) {
    for (std::size_t c = 0; c < 4; ++c) {
      const double length =
          (facets.points[index(quad[c])] - facets.points[index(quad[(c + 1) % 4])]).norm();
      if (length > 0.0) shortest = std::min(shortest, length);
    }
  }
  return shortest;
}

// Sets that grow together.
class Union {
 public:
  explicit Union(std::size_t size) : parent_(size) {
    std::iota(parent_.begin(), parent_.end(), std::size_t{0});
  }
  std::size_t find(std::size_t i) {
    while (parent_[i] != i) i = parent_[i] = parent_[parent_[i]];
    return i;
  }
  void join(std::size_t i, std::size_t j) {
    const auto [first, other] = std::minmax({find(i), find(j)});
    parent_[other] = first;
  }

 private:
  std::vector<std::size_t> parent_;
};

// The first of all points within `tolerance` of each point, found by cells of that size.
std::vector<int> join_points(const std::vector<Vec3>& points, double tolerance) {
  using Cell = std::array<double, 3>;  // whole numbers, of any size
  std::map<Cell, std::vector<int>> cells;
  std::vector<int> first(points.size());
  for (std::size_t p = 0; p < points.size(); ++p) {
    Cell home;
    for (int c = 0; c < 3; ++c) {
      home[index(c)] = std::floor(points[p][c] / tolerance);
    }
    first[p] = static_cast<int>(p);
    for (int neighbour = 0; neighbour < 27 && first[p] == static_cast<int>(p); ++neighbour) {
      const Cell cell{home[0] + neighbour % 3 - 1, home[1] + neighbour / 3 % 3 - 1,
                      home[2] + neighbour / 9 - 1};
      const auto found = cells.find(cell);
      if (found == cells.end()) continue;
      for (int other : found->second) {
        if ((points[index(other)] - points[p]).norm() <= tolerance) first[p] = other;
      }
    }
    if (first[p] == static_cast<int>(p)) cells[home].push_back(first[p]);
  }
  return first;
}

// Both ends of an edge, smaller point first.
std::pair<int, int> edge_key(int a, int b) { return {std::min(a, b), std::max(a, b)}; }

}  // namespace

void Facets::append(const Facets& other) {
  const auto first_point = static_cast<int>(points.size());
  const auto first_quad = static_cast<int>(quads.size());
  const int first_parent = parents.empty() ? 0 : 1 + *std::ranges::max_element(parents);
  for (int parent : other.parents) parents.push_back(parent + first_parent);
  points.insert(points.end(), other.points.begin(), other.points.end());
  normals.insert(normals.end(), other.normals.begin(), other.normals.end());
  for (auto quad : other.quads) {
    for (int& point : quad) point += first_point;
    quads.push_back(quad);
  }
  for (const auto& [name, corners] : other.edges) {
    for (const Corner& c : corners) edges[name].push_back({c.quad + first_quad, c.corner});
  }
  for (const auto& [name, part] : other.parts) {
    for (int quad : part) parts[name].push_back(quad + first_quad);
  }
}

ShellForms::Nodes ShellMesh::slots(int quad) const {
  ShellForms::Nodes slots;
  for (int a = 0; a < 4; ++a) {
    const std::size_t node = index(quads[index(quad)][index(a)]);
    slots.col(2 * a) = positions[node];
    slots.col(2 * a + 1) = directors[node];
  }
  return slots;
}

std::array<Vec3, 4> corner_normals(const std::array<Vec3, 4>& points) {
  std::array<Vec3, 4> normals;
  for (std::size_t c = 0; c < 4; ++c) {
    normals[c] = (points[(c + 1) % 4] - points[c]).cross(points[(c + 3) % 4] - points[c]);
    normals[c].normalize();
  }
  return normals;
}

std::vector<int> partners_along(const std::vector<Corner>& edge) {
  constexpr std::size_t furthest = 8;
  const auto share_side = [](const Corner& a, const Corner& b) {
    return a.quad == b.quad && (a.corner - b.corner) % 2 != 0;
  };
  std::vector<int> partners(edge.size(), -1);
  for (std::size_t i = 0; i < edge.size(); ++i) {
    for (std::size_t j = i; j-- > (i > furthest ? i - furthest : 0);) {
      if (partners[j] >= 0 || !share_side(edge[j], edge[i])) continue;
      partners[i] = static_cast<int>(j);
      partners[j] = static_cast<int>(i);
      break;
    }
  }
  return partners;
}

// Between neighbours in a smooth surface, or one and the reverse of the other.
constexpr double flat_cosine = 0.7;

ShellMesh make_mesh(const Facets& facets, double fold_angle) {
  const std::vector<int> point = join_points(facets.points, 1e-6 * shortest_edge(facets));
  const auto at = [&](std::size_t quad, std::size_t corner) {
    return point[index(facets.quads[quad][corner])];
  };

  // Corners of elements that share an edge and are smooth there become one node.
  std::map<std::pair<int, int>, std::vector<std::pair<std::size_t, std::size_t>>> sides;
  for (std::size_t q = 0; q < facets.quads.size(); ++q) {
    for (std::size_t c = 0; c < 4; ++c) {
      sides[edge_key(at(q, c), at(q, (c + 1) % 4))].emplace_back(q, c);
    }
  }
  Union corners(4 * facets.quads.size());
  Union lines(facets.points.size());
  std::set<int> folded;  // points
  double smallest_fold_angle = std::numeric_limits<double>::max();
  const auto corner_at = [&](std::size_t quad, std::size_t side, int end) {
    return at(quad, side) == end ? side : (side + 1) % 4;
  };
  for (const auto& [ends, users] : sides) {
    for (std::size_t i = 0; i < users.size(); ++i) {
      for (std::size_t j = 0; j < i; ++j) {
        for (const int end : {ends.first, ends.second}) {
          const std::size_t a = corner_at(users[i].first, users[i].second, end);
          const std::size_t b = corner_at(users[j].first, users[j].second, end);
          const Vec3& normal_a = facets.normals[users[i].first][a];
          const Vec3& normal_b = facets.normals[users[j].first][b];
          const double angle = angle_between(normal_a, normal_b);
          if (angle <= fold_angle) {
            corners.join(4 * users[i].first + a, 4 * users[j].first + b);
          } else {
            lines.join(index(ends.first), index(ends.second));
            folded.insert(end);
            smallest_fold_angle = std::min(smallest_fold_angle, angle);
          }
        }
      }
    }
  }

  ShellMesh mesh;
  for (const auto& [ends, users] : sides) {
    if (users.size() != 2) continue;
    const auto [first, its] = users[0];
    const auto [second, other] = users[1];
    const Vec3& normal = facets.normals[first][its];
    // walls that meet at a corner may have their outer sides where they like
    const bool is_flat = std::abs(normal.dot(facets.normals[second][other])) > flat_cosine;
    if (at(first, its) == at(second, other) && is_flat) {
      mesh.turned.push_back(static_cast<int>(std::max(first, second)));
    }
  }
  std::ranges::sort(mesh.turned);
  const auto again = std::ranges::unique(mesh.turned);
  mesh.turned.erase(again.begin(), again.end());
  std::unordered_map<std::size_t, int> node_of;
  std::map<int, std::vector<int>> nodes_at;
  for (std::size_t q = 0; q < facets.quads.size(); ++q) {
    std::array<int, 4> quad{};
    for (std::size_t c = 0; c < 4; ++c) {
      const auto [found, is_new] = node_of.try_emplace(corners.find(4 * q + c), mesh.size());
      quad[c] = found->second;
      if (is_new) {
        mesh.positions.push_back(facets.points[index(at(q, c))]);
        mesh.directors.push_back(Vec3::Zero());
        nodes_at[at(q, c)].push_back(quad[c]);
      }
      mesh.directors[index(quad[c])] += facets.normals[q][c];
    }
    mesh.quads.push_back(quad);
  }
  for (Vec3& director : mesh.directors) director.normalize();
  for (auto& [place, nodes] : nodes_at) {
    if (nodes.size() > 1) mesh.folds.push_back(std::move(nodes));
  }
  if (!mesh.folds.empty()) mesh.smallest_fold_angle = smallest_fold_angle;
  std::set<std::size_t> fold_lines;
  for (const auto& [place, nodes] : nodes_at) {
    if (folded.contains(place)) fold_lines.insert(lines.find(index(place)));
  }
  mesh.fold_lines = static_cast<int>(fold_lines.size());
  for (const auto& [name, along] : facets.edges) {
    std::vector<int>& nodes = mesh.edges[name];
    const bool is_points = facets.points_only.contains(name);
    std::set<int> places;
    for (const Corner& c : along) {
      // what acts at a point of a fold acts once, on one of the nodes that are joined there
      if (is_points && !places.insert(at(index(c.quad), index(c.corner))).second) continue;
      const int node = mesh.quads[index(c.quad)][index(c.corner)];
      if (std::find(nodes.begin(), nodes.end(), node) == nodes.end()) nodes.push_back(node);
    }
    if (is_points) continue;
    const std::vector<int> partners = partners_along(along);
    std::set<std::pair<int, int>> known;
    for (std::size_t i = 0; i < along.size(); ++i) {
      if (partners[i] <= static_cast<int>(i)) continue;  // the first of a pair speaks for it
      const Corner &from = along[i], &to = along[index(partners[i])];
      const auto place = [&](const Corner& c) { return at(index(c.quad), index(c.corner)); };
      if (!known.insert(edge_key(place(from), place(to))).second) continue;
      const auto node = [&](const Corner& c) { return mesh.quads[index(c.quad)][index(c.corner)]; };
      mesh.sides[name].push_back({node(from), node(to)});
    }
  }
  mesh.parts = facets.parts;
  return mesh;
}

MeshQuality mesh_quality(const ShellMesh& mesh) {
  MeshQuality quality;
  quality.smallest_angle = std::numeric_limits<double>::max();
  double area = 0.0;
  double missing_area = 0.0;
  for (std::size_t q = 0; q < mesh.quads.size(); ++q) {
    const auto& quad = mesh.quads[q];
    std::array<Vec3, 4> points;
    for (std::size_t c = 0; c < 4; ++c) points[c] = mesh.positions[index(quad[c])];
    const std::array<Vec3, 4> normals = corner_normals(points);
    const Vec3 normal = (points[2] - points[0]).cross(points[3] - points[1]);
    double longest = 0.0;
    double shortest = std::numeric_limits<double>::max();
    for (std::size_t c = 0; c < 4; ++c) {
      const Vec3 ahead = points[(c + 1) % 4] - points[c];
      const Vec3 back = points[(c + 3) % 4] - points[c];
      longest = std::max(longest, ahead.norm());
      shortest = std::min(shortest, ahead.norm());
      double angle = angle_between(ahead, back);
      if (ahead.cross(back).dot(normal) < 0.0) angle = 2.0 * std::acos(-1.0) - angle;
      quality.smallest_angle = std::min(quality.smallest_angle, angle);
      quality.largest_angle = std::max(quality.largest_angle, angle);
      for (std::size_t other = 0; other < c; ++other) {
        quality.largest_warp =
            std::max(quality.largest_warp, angle_between(normals[c], normals[other]));
      }
    }
    quality.largest_aspect = std::max(quality.largest_aspect, longest / shortest);
    const double size = 0.5 * normal.norm();
    area += size;
    for (std::size_t c = 0; c < 4; ++c) {
      if (normals[c].isZero()) continue;  // at a pole
      // 1 - cos x sin x / x is 4/3 (1 - cos x) up to x^4
      const double cosine = std::abs(mesh.directors[index(quad[c])].dot(normals[c]));
      missing_area += 0.25 * size * 4.0 / 3.0 * (1.0 - cosine);
    }
  }
  if (area > 0.0) quality.missing_volume = missing_area / area;
  return quality;
}

}  // namespace culm::shell
