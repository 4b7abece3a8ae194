#include <culm/base/error.hpp>
#include <culm/port/point_motion.hpp>
#include <culm/port/projection.hpp>

#include "interpolation.hpp"

#include <Eigen/Geometry>
#include <Eigen/LU>

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

namespace culm::port {
namespace {

constexpr double infinite = std::numeric_limits<double>::infinity();
// What lies in a cross-section goes before what lies past an end, and what is nearer by less than
// this is no clear choice.
constexpr double clearly = 1.2;
// How far faces are prolonged past their rim, in natural coordinates.
constexpr double prolonged = 0.5;
constexpr double round_off = 1e-9;

// A cell in the reference, with a ball around its nodes.
struct Patch {
  int structure, cell;
  Shape shape;
  const std::vector<int>* nodes;
  Eigen::Matrix<double, 3, Eigen::Dynamic, Eigen::ColMajor, 3, 16> slots;
  Vec3 centre;
  double radius;

  std::size_t size() const { return nodes->size(); }
};

Patch make_patch(const model::Model& model, int structure, int number) {
  const model::Cell& cell = model.structures()[static_cast<std::size_t>(structure)]
                                .cells[static_cast<std::size_t>(number)];
  const bool is_surface = model.nodes().kind(cell.nodes.front()) == NodeKind::node6;
  Patch patch{structure,
              number,
              cell.nodes.size() == 1 ? Shape::node : (is_surface ? Shape::surface : Shape::line),
              &cell.nodes,
              {},
              Vec3::Zero(),
              0.0};
  const auto count = static_cast<int>(cell.nodes.size());
  patch.slots.resize(3, 4 * count);
  for (int a = 0; a < count; ++a) {
    patch.slots.middleCols<4>(4 * a) =
        model::NodeTable::slots(model.nodes().reference(), cell.nodes[static_cast<std::size_t>(a)]);
    patch.centre += patch.slots.col(4 * a) / count;
  }
  for (int a = 0; a < count; ++a) {
    patch.radius = std::max(patch.radius, (patch.slots.col(4 * a) - patch.centre).norm());
  }
  return patch;
}

// sum_a w_a q_s,a for each slot s
model::NodeSlots weighted(const Patch& patch, const Interpolation::Column& weights) {
  model::NodeSlots sum = model::NodeSlots::Zero();
  for (int a = 0; a < weights.size(); ++a) sum += weights[a] * patch.slots.middleCols<4>(4 * a);
  return sum;
}

Vec3 axis_point(const Patch& patch, const Eigen::Vector2d& natural) {
  return weighted(patch, interpolate(patch.shape, patch.size(), natural).N).col(0);
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
  if (patch.shape == Shape::line) {
    const Vec3 first = patch.slots.col(0), chord = patch.slots.rightCols<4>().col(0) - first;
    const double along = (p - first).dot(chord) / chord.squaredNorm();
    found.natural[0] = std::clamp(2.0 * along - 1.0, -1.0, 1.0);
  }
  const double small = 1e-14 * (p.norm() + patch.centre.norm() + patch.radius);
  for (int i = 0; i < most; ++i) {
    const Interpolation at = interpolate(patch.shape, patch.size(), found.natural);
    const model::NodeSlots slots = weighted(patch, at.N);
    const Vec3 miss = p - at_offset(slots, found.offset);
    Mat3 J;
    J.col(0) = at_offset(weighted(patch, at.N_xi), found.offset);
    J.col(1) = patch.shape == Shape::line ? Vec3(slots.col(1))
                                          : at_offset(weighted(patch, at.N_eta), found.offset);
    J.col(2) = slots.col(patch.shape == Shape::line ? 2 : 1);
    if (miss.norm() <= small) {
      const Vec3 tangent = weighted(patch, at.N_xi).col(0);
      const Vec3 across =
          patch.shape == Shape::line ? Vec3(slots.col(1)) : Vec3(weighted(patch, at.N_eta).col(0));
      found.fibre = J.determinant() / tangent.dot(across.cross(J.col(2)));
      found.foot = slots.col(0);
      found.distance = (p - found.foot).norm();
      return found;
    }
    const Vec3 step = J.partialPivLu().solve(miss);
    if (!step.allFinite() || std::abs(step[0]) > 10.0) return {};
    found.natural[0] += step[0];
    if (patch.shape == Shape::line) {
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
  const int last = static_cast<int>(patch.size()) - 1;
  Candidate first = on_node(patch, 0, p), end = on_node(patch, last, p);
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
  return patch.shape == Shape::line ? on_line(patch, p) : on_surface(patch, p);
}

// Whether two candidates are two different places, so that choosing one means something.
bool differ(const Candidate& a, const Candidate& b, double tolerance) {
  return a.patch->structure != b.patch->structure ||
         (a.foot - b.foot).norm() > std::max(a.distance, b.distance) + tolerance;
}

Place make_place(const model::Model& model, const Candidate& candidate) {
  const Patch& patch = *candidate.patch;
  if (candidate.node >= 0) {
    Place place;
    place.marker = model::marker_at((*patch.nodes)[static_cast<std::size_t>(candidate.node)]);
    place.marker.offset = candidate.offset;
    place.structure = patch.structure;
    place.cell = patch.cell;
    place.natural = candidate.natural;
    return place;
  }
  return place_in_cell(model, patch.structure, patch.cell, candidate.natural, candidate.offset);
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
  const Patch patch = make_patch(model, structure, cell);
  const Interpolation at = interpolate(patch.shape, patch.size(), natural);
  Place place;
  place.marker.nodes = *patch.nodes;
  place.marker.weights.assign(at.N.begin(), at.N.end());
  place.marker.offset = patch.shape == Shape::surface ? Vec3(offset[0], 0.0, 0.0) : offset;
  place.structure = structure;
  place.cell = cell;
  place.natural = natural;
  place.distance = (weighted(patch, at.N).rightCols<3>() * place.marker.offset).norm();
  return place;
}

Projection project(const model::Model& model, std::span<const double> cloud,
                   const std::vector<int>& structures) {
  std::vector<Patch> patches;
  for (const int structure : structures) {
    const auto cells = model.structures()[static_cast<std::size_t>(structure)].cells.size();
    for (std::size_t cell = 0; cell < cells; ++cell) {
      patches.push_back(make_patch(model, structure, static_cast<int>(cell)));
    }
  }
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
    Place place = make_place(model, best);
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
