#include <culm/base/error.hpp>
#include <culm/port/point_motion.hpp>
#include <culm/port/projection.hpp>

#include "interpolation.hpp"

#include <Eigen/Geometry>
#include <Eigen/LU>

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <map>
#include <optional>
#include <utility>

namespace culm::port {
namespace {

constexpr double infinite = std::numeric_limits<double>::infinity();
// What lies in a cross-section goes before what lies past an end, and what is nearer by less than
// this is no clear choice.
constexpr double clearly = 1.2;
// How far faces are prolonged past their rim, in natural coordinates.
constexpr double prolonged = 0.5;
constexpr double round_off = 1e-9;

// A cell, or a segment of one, in the reference, with a ball around its nodes.
struct Patch {
  int structure = -1, cell = -1;
  Shape shape = Shape::node;
  std::vector<int> nodes;
  Spacing spacing = {};     // of a segment
  int first = 0, last = 0;  // of a line or segment: its ends among the nodes
  Eigen::Matrix<double, 3, Eigen::Dynamic, Eigen::ColMajor, 3, 16> slots = {};
  Vec3 centre = Vec3::Zero();
  double radius = 0.0;

  bool is_line() const { return shape == Shape::line || shape == Shape::segment; }
  Interpolation at(const Eigen::Vector2d& natural) const {
    return shape == Shape::segment ? interpolate(spacing, natural[0])
                                   : interpolate(shape, nodes.size(), natural);
  }
};

// Fills in what follows from shape and nodes.
Patch complete(Patch patch, const model::Model& model) {
  const auto count = static_cast<int>(patch.nodes.size());
  patch.slots.resize(3, 4 * count);
  for (int a = 0; a < count; ++a) {
    patch.slots.middleCols<4>(4 * a) = model::NodeTable::slots(
        model.nodes().reference(), patch.nodes[static_cast<std::size_t>(a)]);
  }
  for (int a = patch.first; a <= patch.last; ++a) {
    patch.centre += patch.slots.col(4 * a) / (patch.last - patch.first + 1);
  }
  for (int a = patch.first; a <= patch.last; ++a) {
    patch.radius = std::max(patch.radius, (patch.slots.col(4 * a) - patch.centre).norm());
  }
  return patch;
}

Patch make_patch(const model::Model& model, int structure, int number) {
  Patch patch;
  patch.structure = structure;
  patch.cell = number;
  const CellNodes& nodes = model.structures()[static_cast<std::size_t>(structure)]
                               .cells[static_cast<std::size_t>(number)]
                               .nodes;
  patch.nodes.assign(nodes.begin(), nodes.end());
  if (patch.nodes.size() > 1) {
    const bool is_surface = model.nodes().kind(patch.nodes.front()) == NodeKind::node6;
    patch.shape = is_surface ? Shape::surface : Shape::line;
  }
  patch.last = static_cast<int>(patch.nodes.size()) - 1;
  return complete(std::move(patch), model);
}

// The neighbours of the nodes of a line; at a fork the last one that was seen.
struct Neighbours {
  explicit Neighbours(const model::Structure& structure) {
    for (const model::Cell& cell : structure.cells) {
      for (std::size_t a = 0; a + 1 < cell.nodes.size(); ++a) {
        after[cell.nodes[a]] = cell.nodes[a + 1];
        before[cell.nodes[a + 1]] = cell.nodes[a];
      }
    }
  }
  std::map<int, int> before, after;
};

// The parts of a cell between neighbouring nodes, with the nodes beside them.
void add_segments(const model::Model& model, const Patch& cell, const Neighbours& neighbours,
                  std::vector<Patch>& patches) {
  const auto distance = [&](int a, int b) {
    const model::Coordinates& q = model.nodes().reference();
    return (model::NodeTable::slots(q, b).col(0) - model::NodeTable::slots(q, a).col(0)).norm();
  };
  for (std::size_t a = 0; a + 1 < cell.nodes.size(); ++a) {
    const int from = cell.nodes[a], to = cell.nodes[a + 1];
    Patch patch;
    patch.structure = cell.structure;
    patch.cell = cell.cell;
    patch.shape = Shape::segment;
    patch.nodes = {from, to};
    patch.spacing.within = distance(from, to);
    if (const auto found = neighbours.before.find(from); found != neighbours.before.end()) {
      patch.nodes.insert(patch.nodes.begin(), found->second);
      patch.spacing.before = distance(found->second, from);
      patch.first = 1;
    }
    patch.last = patch.first + 1;
    if (const auto found = neighbours.after.find(to); found != neighbours.after.end()) {
      patch.nodes.push_back(found->second);
      patch.spacing.after = distance(to, found->second);
    }
    patches.push_back(complete(std::move(patch), model));
  }
}

std::vector<Patch> make_patches(const model::Model& model, const std::vector<int>& structures,
                                Weights weights) {
  std::vector<Patch> patches;
  for (const int number : structures) {
    const model::Structure& structure = model.structures()[static_cast<std::size_t>(number)];
    const Neighbours neighbours(structure);
    for (std::size_t cell = 0; cell < structure.cells.size(); ++cell) {
      Patch patch = make_patch(model, number, static_cast<int>(cell));
      if (patch.shape == Shape::line && weights == Weights::smooth) {
        add_segments(model, patch, neighbours, patches);
      } else {
        patches.push_back(std::move(patch));
      }
    }
  }
  return patches;
}

// sum_a w_a q_s,a for each slot s
model::NodeSlots weighted(const Patch& patch, const Interpolation::Column& weights) {
  model::NodeSlots sum = model::NodeSlots::Zero();
  for (int a = 0; a < weights.size(); ++a) sum += weights[a] * patch.slots.middleCols<4>(4 * a);
  return sum;
}

Vec3 axis_point(const Patch& patch, const Eigen::Vector2d& natural) {
  return weighted(patch, patch.at(natural).N).col(0);
}

// x + theta_k d_k
Vec3 at_offset(const model::NodeSlots& slots, const Vec3& offset) {
  return slots.col(0) + slots.rightCols<3>() * offset;
}

// A place of a patch that a point may belong to.
struct Candidate {
  const Patch* patch = nullptr;
  Eigen::Vector2d natural = Eigen::Vector2d::Zero();
  Vec3 offset = Vec3::Zero();
  int node = -1;             // of the patch, if the offset is in its triad
  Vec3 foot = Vec3::Zero();  // on the axis or surface
  double distance = infinite;
  double beyond = 0.0;
  double fibre = 1.0;

  double cost() const { return beyond > 0.0 ? clearly * distance : distance; }
};

// X(xi, theta1, theta2) = p of a line, X(xi, eta, zeta) = p of a surface, by Newton's method; at
// most some steps, for it is quadratic where a place is of use.
std::optional<Candidate> solve(const Patch& patch, const Vec3& p) {
  constexpr int most = 20;
  Candidate found;
  found.patch = &patch;
  if (patch.is_line()) {
    const Vec3 first = patch.slots.col(4 * patch.first);
    const Vec3 chord = patch.slots.col(4 * patch.last) - first;
    const double along = (p - first).dot(chord) / chord.squaredNorm();
    found.natural[0] = std::clamp(2.0 * along - 1.0, -1.0, 1.0);
  }
  const double small = 1e-14 * (p.norm() + patch.centre.norm() + patch.radius);
  for (int i = 0; i < most; ++i) {
    const Interpolation at = patch.at(found.natural);
    const model::NodeSlots slots = weighted(patch, at.N);
    const Vec3 miss = p - at_offset(slots, found.offset);
    Mat3 J;
    J.col(0) = at_offset(weighted(patch, at.N_xi), found.offset);
    J.col(1) =
        patch.is_line() ? Vec3(slots.col(1)) : at_offset(weighted(patch, at.N_eta), found.offset);
    J.col(2) = slots.col(patch.is_line() ? 2 : 1);
    if (miss.norm() <= small) {
      const Vec3 tangent = weighted(patch, at.N_xi).col(0);
      const Vec3 across =
          patch.is_line() ? Vec3(slots.col(1)) : Vec3(weighted(patch, at.N_eta).col(0));
      found.fibre = J.determinant() / tangent.dot(across.cross(J.col(2)));
      found.foot = slots.col(0);
      found.distance = (p - found.foot).norm();
      return found;
    }
    const Vec3 step = J.partialPivLu().solve(miss);
    if (!step.allFinite() || std::abs(step[0]) > 10.0) return {};
    found.natural[0] += step[0];
    if (patch.is_line()) {
      found.offset.head<2>() += step.tail<2>();
    } else {
      found.natural[1] += step[1];
      found.offset[0] += step[2];
    }
  }
  return {};
}

// A point in the triad of a node of a patch.
Candidate on_node(const Patch& patch, int node, const Vec3& p) {
  Candidate found;
  found.patch = &patch;
  found.node = node;
  const auto slots = patch.slots.middleCols<4>(4 * node);
  found.foot = slots.col(0);
  found.offset = slots.rightCols<3>().transpose() * (p - found.foot);
  found.distance = (p - found.foot).norm();
  return found;
}

std::optional<Candidate> on_line(const Patch& patch, const Vec3& p) {
  if (auto inside = solve(patch, p);
      inside && std::abs(inside->natural[0]) <= 1.0 + round_off && inside->fibre > 0.0) {
    return inside;
  }
  Candidate first = on_node(patch, patch.first, p), end = on_node(patch, patch.last, p);
  first.natural[0] = -1.0;
  end.natural[0] = 1.0;
  Candidate nearer = first.distance <= end.distance ? first : end;
  nearer.beyond = std::abs(nearer.offset[2]);
  return nearer;
}

std::optional<Candidate> on_surface(const Patch& patch, const Vec3& p) {
  auto found = solve(patch, p);
  if (!found || found->fibre <= 0.0) return {};
  const double past = found->natural.lpNorm<Eigen::Infinity>() - 1.0;
  if (past > prolonged) return {};
  if (past <= round_off) return found;
  const Eigen::Vector2d rim = found->natural.cwiseMax(-1.0).cwiseMin(1.0);
  const Vec3 foot = found->foot;
  found->foot = axis_point(patch, rim);
  found->beyond = (foot - found->foot).norm();
  found->distance = (p - found->foot).norm();
  return found;
}

std::optional<Candidate> find_in(const Patch& patch, const Vec3& p) {
  if (patch.shape == Shape::node) return on_node(patch, 0, p);
  return patch.is_line() ? on_line(patch, p) : on_surface(patch, p);
}

// Whether two candidates are two different places, so that choosing one means something.
bool differ(const Candidate& a, const Candidate& b, double tolerance) {
  return a.patch->structure != b.patch->structure ||
         (a.foot - b.foot).norm() > std::max(a.distance, b.distance) + tolerance;
}

Place make_place(const Patch& patch, const Eigen::Vector2d& natural, const Vec3& offset) {
  const Interpolation at = patch.at(natural);
  Place place;
  place.marker.nodes = patch.nodes;
  place.marker.weights.assign(at.N.begin(), at.N.end());
  place.marker.offset = patch.shape == Shape::surface ? Vec3(offset[0], 0.0, 0.0) : offset;
  place.structure = patch.structure;
  place.cell = patch.cell;
  place.natural = natural;
  place.distance = (weighted(patch, at.N).rightCols<3>() * place.marker.offset).norm();
  return place;
}

Place make_place(const Candidate& candidate) {
  const Patch& patch = *candidate.patch;
  if (candidate.node < 0) return make_place(patch, candidate.natural, candidate.offset);
  Place place;
  place.marker = model::marker_at(patch.nodes[static_cast<std::size_t>(candidate.node)]);
  place.marker.offset = candidate.offset;
  place.structure = patch.structure;
  place.cell = patch.cell;
  place.natural = candidate.natural;
  return place;
}

// Patches in the order of what they may at best have for a point.
class Nearest {
 public:
  explicit Nearest(const std::vector<Patch>& patches) : patches_(patches) {}

  // Calls visit(patch) for all patches that may hold a place nearer than limit().
  template <class Visit, class Limit>
  void visit(const Vec3& p, Visit visit, Limit limit) {
    bounds_.clear();
    for (std::size_t i = 0; i < patches_.size(); ++i) {
      const Patch& patch = patches_[i];
      // the axis may bulge out of the ball around its nodes a little
      bounds_.emplace_back((p - patch.centre).norm() - clearly * patch.radius, i);
    }
    const auto later = std::greater<>();
    std::make_heap(bounds_.begin(), bounds_.end(), later);
    while (!bounds_.empty() && bounds_.front().first <= limit()) {
      visit(patches_[bounds_.front().second]);
      std::pop_heap(bounds_.begin(), bounds_.end(), later);
      bounds_.pop_back();
    }
  }

 private:
  const std::vector<Patch>& patches_;
  std::vector<std::pair<double, std::size_t>> bounds_;
};

}  // namespace

Place place_in_cell(const model::Model& model, int structure, int cell,
                    const Eigen::Vector2d& natural, const Vec3& offset) {
  return make_place(make_patch(model, structure, cell), natural, offset);
}

Projection project(const model::Model& model, std::span<const double> cloud,
                   const std::vector<int>& structures, Weights weights) {
  const std::vector<Patch> patches = make_patches(model, structures, weights);
  Nearest nearest(patches);
  const double tolerance = round_off * model.length();
  Projection projection;
  for (std::size_t k = 0; k < cloud.size() / 3; ++k) {
    const Vec3 p = Eigen::Map<const Vec3>(cloud.data() + 3 * k);
    Candidate best;
    std::vector<Candidate> others;
    const auto limit = [&] { return clearly * best.cost() + tolerance; };
    nearest.visit(
        p,
        [&](const Patch& patch) {
          auto found = find_in(patch, p);
          if (!found) return;
          if (found->cost() < best.cost()) std::swap(*found, best);
          if (found->patch != nullptr) others.push_back(*found);
        },
        limit);
    if (best.patch == nullptr) {
      projection.lost.push_back(k);
      projection.places.emplace_back();
      continue;
    }
    Place place = make_place(best);
    internal_check((position(place.marker, model.nodes().reference()) - p).norm() <=
                       1e-10 * model.length() + 1e-12 * p.norm(),
                   "a point of a port was attached elsewhere");
    place.distance = best.distance;
    place.beyond = best.beyond > tolerance ? best.beyond : 0.0;
    place.fibre = best.fibre;
    for (const Candidate& other : others) {
      if (other.cost() > limit() || !differ(best, other, tolerance)) continue;
      place.rival = other.patch->structure;
      break;
    }
    projection.places.push_back(place);
  }
  return projection;
}

}  // namespace culm::port
