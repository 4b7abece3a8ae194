#include <culm/contact/beam_contact.hpp>
#include <culm/load/slot_kernel.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace culm::contact {
namespace {

using BeamContactMotion = model::ItemMotion<BeamContact::max_nodes>;

/// The least of |r|^2 on the straight way from one r to another.
double least_square(const Vec3& from, const Vec3& to) {
  const Vec3 way = to - from;
  const double square = way.squaredNorm();
  const double s = square > 0.0 ? std::clamp(-from.dot(way) / square, 0.0, 1.0) : 0.0;
  return (from + s * way).squaredNorm();
}

/// What the pairs of an item add up to: forces on all slots, and their derivatives.
struct Sums {
  BeamContactMotion::Slots forces;
  Eigen::Matrix<double, 12 * BeamContact::max_nodes, 12 * BeamContact::max_nodes> tangent;
};

/// A point of a line with its directors.
SurfaceCarrier carrier(const LineElement& element, const Vec<4>& shape, const model::State& state,
                       double theta, const Vec3& arm) {
  SurfaceCarrier point;
  for (std::size_t a = 0; a < element.nodes.size(); ++a) {
    const double N = shape[static_cast<int>(a)];
    const auto prev = model::NodeTable::slots(state.prev, element.nodes[a]);
    const auto next = model::NodeTable::slots(state.next, element.nodes[a]);
    point.way += N * (next.col(0) - prev.col(0));
    point.moved += N * (next.rightCols<3>() - prev.rightCols<3>());
    point.directors += N * ((1.0 - theta) * prev.rightCols<3>() + theta * next.rightCols<3>());
  }
  point.arm = arm;
  return point;
}

}  // namespace

/// Two points in a step, r from that of the first line to that of the second.
struct BeamContact::Pair {
  std::size_t g = 0, h = 0;  ///< numbers in their elements
  Vec3 prev, next;           ///< r
  double weight = 0.0;       ///< product of their lengths [m^2]
};

BeamContact::BeamContact(model::Effect effect, const model::NodeTable& nodes, const Repulsion& law,
                         const Friction& friction, double width, std::vector<LineElement> first,
                         std::vector<LineElement> second)
    : MemorylessBatch(std::move(effect)),
      Booked("contact"),
      nodes_(nodes),
      law_(law),
      friction_(friction),
      width_(width),
      first_(std::move(first)),
      second_(std::move(second)) {
  std::size_t most = 0;
  for (const LineElement& element : second_) most = std::max(most, element.shapes.size());
  for (int item = 0; item < size(); ++item) {
    std::vector<int> all = first_of(item).nodes;
    all.insert(all.end(), second_of(item).nodes.begin(), second_of(item).nodes.end());
    nodes_of_.push_back(std::move(all));
  }
  places_.resize(most);
}

std::vector<int> BeamContact::blocks(int item, const model::UnknownTable& unknowns) const {
  return blocks_of(nodes_of_[static_cast<std::size_t>(item)], unknowns);
}

bool BeamContact::is_apart(int item, const model::Coordinates& prev,
                           const model::Coordinates& next) const {
  const Ball first[] = {ball_about(first_of(item), prev), ball_about(first_of(item), next)};
  const Ball second[] = {ball_about(second_of(item), prev), ball_about(second_of(item), next)};
  const double reach = law_.reach + std::max(first[0].radius, first[1].radius) +
                       std::max(second[0].radius, second[1].radius);
  return least_square(second[0].centre - first[0].centre, second[1].centre - first[1].centre) >
         reach * reach;
}

// Calls act for all pairs that may be within reach in the step. Where both ends are beyond it, only
// a way longer than the reach could lead through the axis of the other.
template <class Act>
Verdict BeamContact::visit_pairs(int item, const model::Coordinates& prev,
                                 const model::Coordinates& next, Act act) const {
  if (is_apart(item, prev, next)) return Verdict::ok;
  const LineElement& first = first_of(item);
  const LineElement& second = second_of(item);
  for (std::size_t h = 0; h < second.shapes.size(); ++h) {
    places_[h] = {place_on(second, second.shapes[h], prev),
                  place_on(second, second.shapes[h], next)};
  }
  const double square = law_.reach * law_.reach;
  Verdict verdict = Verdict::ok;
  for (std::size_t g = 0; g < first.shapes.size(); ++g) {
    const Vec3 at_prev = place_on(first, first.shapes[g], prev);
    const Vec3 at_next = place_on(first, first.shapes[g], next);
    for (std::size_t h = 0; h < second.shapes.size(); ++h) {
      const Vec3 r0 = places_[h].first - at_prev;
      const Vec3 r1 = places_[h].second - at_next;
      const bool outside = std::min(r0.squaredNorm(), r1.squaredNorm()) >= square;
      if (outside && (r1 - r0).squaredNorm() < square) continue;
      if (least_square(r0, r1) < 0.25 * square) verdict = Verdict::law_out_of_range;
      if (!outside) act(Pair{g, h, r0, r1, first.lengths[g] * second.lengths[h]});
    }
  }
  return verdict;
}

Touch BeamContact::touch(const model::Coordinates& q) const {
  Touch touch;
  double nearest = std::numeric_limits<double>::max();  // square of the least distance
  for (const LineElement& first : first_) {
    const Ball about_first = ball_about(first, q);
    std::vector<bool> pressed(first.shapes.size(), false);
    std::vector<Vec3> from;
    for (const Vec<4>& shape : first.shapes) from.push_back(place_on(first, shape, q));
    for (const LineElement& second : second_) {
      const Ball about_second = ball_about(second, q);
      const double apart = (about_second.centre - about_first.centre).norm() - about_first.radius -
                           about_second.radius;
      if (apart > std::max(std::sqrt(nearest), law_.reach)) continue;
      Vec3 force = Vec3::Zero();
      for (std::size_t h = 0; h < second.shapes.size(); ++h) {
        const Vec3 to = place_on(second, second.shapes[h], q);
        for (std::size_t g = 0; g < first.shapes.size(); ++g) {
          const Vec3 r = to - from[g];
          const double y = r.squaredNorm();
          nearest = std::min(nearest, y);
          if (y >= law_.reach * law_.reach) continue;
          pressed[g] = true;
          force += first.lengths[g] * second.lengths[h] * 2.0 *
                   respond(law_, y, y, Stencil::statics()).elastic * r;
        }
      }
      touch.force += force.norm();
    }
    for (std::size_t g = 0; g < pressed.size(); ++g) {
      if (pressed[g]) touch.area += width_ * first.lengths[g];
    }
  }
  touch.depth = law_.reach - std::sqrt(nearest);
  return touch;
}

std::string BeamContact::objection(const model::Coordinates& q) const {
  const double depth = touch(q).depth;
  if (depth <= 0.5 * law_.reach) return {};
  return fmt::format("lies {:.3g} m deep in the other beam, more than half of both radii", depth);
}

std::string BeamContact::left_out_at_rest() const {
  if (friction_.coefficient == 0.0) return {};
  return "rubs in dynamics only: nothing sticks to a beam at rest";
}

Verdict BeamContact::assemble(const model::State& state, const Stencil& stencil, Want want,
                              model::Target& target) {
  if (want == Want::mass) return Verdict::ok;
  const bool tangent = want == Want::residual_and_tangent;
  return assemble_items([&](auto space, std::size_t i) {
    return assemble_item<decltype(space)>(i, state, stencil, tangent, target);
  });
}

std::optional<Sliding> BeamContact::friction_of(int item, const Pair& pair,
                                                const RepulsionResponse& response,
                                                const model::State& state, const Stencil& stencil,
                                                bool tangent) const {
  if (friction_.coefficient == 0.0 || stencil.step == 0.0 || response.stress == 0.0) return {};
  const double theta = stencil.theta;
  const double share = 0.5 * width_ / law_.reach;  // of r, up to where both surfaces meet
  const Vec3 r = (1.0 - theta) * pair.prev + theta * pair.next;
  const double distance = r.norm();
  Pressed pressed;
  pressed.first = carrier(first_of(item), first_of(item).shapes[pair.g], state, theta, share * r);
  pressed.second =
      carrier(second_of(item), second_of(item).shapes[pair.h], state, theta, (share - 1.0) * r);
  pressed.normal = r / distance;
  pressed.force = -2.0 * pair.weight * response.stress * distance;
  if (tangent) {
    const Mat3 turn =
        theta / distance * (Mat3::Identity() - pressed.normal * pressed.normal.transpose());
    const Vec3 by_r =
        -2.0 * pair.weight *
        (2.0 * response.tangent * distance * pair.next + theta * response.stress / distance * r);
    pressed.place_by_slot.fill(Mat3::Zero());
    pressed.normal_by_slot.fill(Mat3::Zero());
    pressed.force_by_slot.fill(Vec3::Zero());
    pressed.place_by_slot[0] = theta * (1.0 - share) * Mat3::Identity();
    pressed.place_by_slot[4] = theta * share * Mat3::Identity();
    pressed.normal_by_slot[0] = -turn;
    pressed.normal_by_slot[4] = turn;
    pressed.force_by_slot[0] = -by_r;
    pressed.force_by_slot[4] = by_r;
  }
  return slide(pressed, friction_, stencil, tangent);
}

// d(2 S r_theta) = 2 (theta S 1 + 2 S' r_theta r_next^T) dr_next
template <class Space>
Verdict BeamContact::assemble_item(std::size_t i, const model::State& state, const Stencil& stencil,
                                   bool tangent, model::Target& target) {
  const int item = placement().items[i];
  const LineElement& first = first_of(item);
  const LineElement& second = second_of(item);
  const std::vector<int>& nodes = nodes_of_[static_cast<std::size_t>(item)];
  const auto n = static_cast<int>(first.nodes.size());
  const auto count = static_cast<int>(nodes.size());
  Sums sums;
  bool touches = false;
  const Verdict verdict = visit_pairs(item, state.prev, state.next, [&](const Pair& pair) {
    const RepulsionResponse response =
        respond(law_, pair.prev.squaredNorm(), pair.next.squaredNorm(), stencil);
    const Vec3 r = (1.0 - stencil.theta) * pair.prev + stencil.theta * pair.next;
    Vec<max_nodes> N = Vec<max_nodes>::Zero();
    N.head(n) = first.shapes[pair.g].head(n);
    N.segment(n, count - n) = second.shapes[pair.h].head(count - n);
    const auto sign = [n](int a) { return a < n ? -1.0 : 1.0; };
    if (!touches) {
      sums.forces.setZero(3, 4 * count);
      if (tangent) sums.tangent.setZero();
      touches = true;
    }
    const Vec3 force = 2.0 * pair.weight * response.stress * r;
    for (int a = 0; a < count; ++a) sums.forces.col(4 * a) += sign(a) * N[a] * force;
    const std::optional<Sliding> sliding =
        friction_of(item, pair, response, state, stencil, tangent);
    if (sliding) {
      for (int a = 0; a < count; ++a) {
        sums.forces.middleCols<4>(4 * a) -=
            N[a] * sliding->force * sliding->factors.segment<4>(a < n ? 0 : 4).transpose();
      }
    }
    if (!tangent) return;
    const Mat3 K = 2.0 * pair.weight *
                   (stencil.theta * response.stress * Mat3::Identity() +
                    2.0 * response.tangent * r * pair.next.transpose());
    for (int a = 0; a < count; ++a) {
      for (int b = 0; b < count; ++b) {
        sums.tangent.block<3, 3>(12 * a, 12 * b) += sign(a) * sign(b) * N[a] * N[b] * K;
        if (!sliding) continue;
        sums.tangent.block<12, 12>(12 * a, 12 * b) +=
            N[a] * N[b] * sliding->tangent.block<12, 12>(a < n ? 0 : 12, b < n ? 0 : 12);
      }
    }
  });
  if (verdict != Verdict::ok || !touches) return verdict;

  const BeamContactMotion motion(nodes_, nodes, state, stencil.theta);
  const Verdict added =
      load::add_slot_residual<Space>(placement(), i, sums.forces, motion.arms_mid, target);
  if (!tangent || added != Verdict::ok) return added;
  load::add_dense_derivative<Space>(
      placement(), i, sums.forces, motion, stencil.theta,
      [&](int a, int b) { return Mat<12, 12>(sums.tangent.block<12, 12>(12 * a, 12 * b)); },
      target);
  return Verdict::ok;
}

double BeamContact::stored_energy(const model::Coordinates& q) const {
  double energy = 0.0;
  for (std::size_t i = 0; i < placement().items.size(); ++i) {
    if (!placement().owned[i]) continue;
    visit_pairs(placement().items[i], q, q, [&](const Pair& pair) {
      energy += pair.weight * law_.energy(pair.next.squaredNorm());
    });
  }
  return energy;
}

// Between beams there is no resultant.
model::StepWork BeamContact::step_work(const model::State& state, const Stencil& stencil) const {
  model::StepWork work;
  for (std::size_t i = 0; i < placement().items.size(); ++i) {
    if (!placement().owned[i]) continue;
    visit_pairs(placement().items[i], state.prev, state.next, [&](const Pair& pair) {
      const double prev = pair.prev.squaredNorm();
      const double next = pair.next.squaredNorm();
      const RepulsionResponse response = respond(law_, prev, next, stencil);
      work.damping += pair.weight * (response.stress - response.elastic) * (next - prev);
      work.dissipation +=
          pair.weight * (response.elastic * (next - prev) - law_.energy(next) + law_.energy(prev));
      const std::optional<Sliding> sliding =
          friction_of(placement().items[i], pair, response, state, stencil, false);
      if (sliding) work.damping -= sliding->force.dot(sliding->way);
    });
  }
  return work;
}

}  // namespace culm::contact
