#include <culm/contact/plane_contact.hpp>
#include <culm/load/slot_kernel.hpp>

#include <algorithm>
#include <limits>

namespace culm::contact {
namespace {

using PlaneContactMotion = model::ItemMotion<PlaneContact::max_nodes>;
using Factors = Eigen::Matrix<double, 4 * PlaneContact::max_nodes, 1>;

// T_s of all slots
Factors factors_of(const model::Marker& point) {
  Factors T = Factors::Zero();
  for (std::size_t a = 0; a < point.nodes.size(); ++a) {
    T.segment<4>(4 * static_cast<int>(a)) << point.weights[a], point.weights[a] * point.offset;
  }
  return T;
}

}  // namespace

/// A point in a step.
struct PlaneContact::Evaluation {
  PlaneContactMotion motion;
  PenaltyResponse law;
  Factors T = {}, U = {};     ///< of its centre, and of the material point that touches
  Mat3 moved = Mat3::Zero();  ///< by which the directors at the centre change
  Vec3 way = Vec3::Zero();    ///< of that point in the plane [m]
  Rubbing friction = {};      ///< on it
  double normal = 0.0;        ///< normal force [N]

  // forces on the slots
  PlaneContactMotion::Slots forces(const Vec3& n) const {
    PlaneContactMotion::Slots f(3, motion.mid.cols());
    for (int s = 0; s < f.cols(); ++s) f.col(s) = T[s] * normal * n + U[s] * friction.force;
    return f;
  }
};

double PlaneContact::depth(const ContactPoint& point, const model::Coordinates& q) const {
  return point.radius - plane_.normal.dot(place_of(point.centre, q) - plane_.point);
}

Touch PlaneContact::touch(const model::Coordinates& q) const {
  Touch touch;
  touch.depth = -std::numeric_limits<double>::max();
  for (const ContactPoint& point : points_) {
    const double inside = depth(point, q);
    const double pressure = penalty_.pressure(inside);
    touch.force += point.area * pressure;
    touch.depth = std::max(touch.depth, inside);
    if (pressure > 0.0) touch.area += point.area;
  }
  return touch;
}

std::vector<int> PlaneContact::blocks(int item, const model::UnknownTable& unknowns) const {
  return blocks_of(points_[static_cast<std::size_t>(item)].centre.nodes, unknowns);
}

PlaneContact::Evaluation PlaneContact::evaluate(int item, const model::State& state,
                                                const Stencil& stencil) const {
  const auto& [centre, radius, area, length] = point(item);
  Evaluation found{
      PlaneContactMotion(nodes_, centre.nodes, state, stencil.theta),
      respond(penalty_, depth(point(item), state.prev), depth(point(item), state.next), stencil)};
  found.T = factors_of(centre);
  found.U = found.T;
  found.normal = area * found.law.pressure;
  if (friction_.coefficient == 0.0 || found.normal == 0.0) return found;

  Mat3 directors = Mat3::Zero();
  for (std::size_t a = 0; a < centre.nodes.size(); ++a) {
    const auto at = 4 * static_cast<int>(a);
    const auto prev = model::NodeTable::slots(state.prev, centre.nodes[a]);
    directors += centre.weights[a] * found.motion.mid.middleCols<3>(at + 1);
    found.moved +=
        centre.weights[a] * (found.motion.next.middleCols<3>(at + 1) - prev.rightCols<3>());
  }
  const Vec3 xi = -radius * directors.transpose() * plane_.normal;
  const Vec3 way = place_of(centre, state.next) - place_of(centre, state.prev) + found.moved * xi;
  found.way = way - plane_.normal * plane_.normal.dot(way);
  for (std::size_t a = 0; a < centre.nodes.size(); ++a) {
    found.U.segment<3>(4 * static_cast<int>(a) + 1) += centre.weights[a] * xi;
  }
  const double k = area * penalty_.stiffness;
  found.friction = stencil.step > 0.0
                       ? rub(friction_, found.normal, found.way, stencil.step)
                       : stick(friction_, found.normal, k, found.way - grip(item) / k);
  return found;
}

void PlaneContact::accept(model::State& state) {
  if (!has_grips()) return;
  for (const int item : placement().items) {
    grip(item) = evaluate(item, state, stencil()).friction.force;
  }
}

Verdict PlaneContact::assemble(const model::State& state, const Stencil& stencil, Want want,
                               model::Target& target) {
  if (want == Want::mass) return Verdict::ok;
  const bool tangent = want == Want::residual_and_tangent;
  return assemble_items([&](auto space, std::size_t i) {
    return assemble_item<decltype(space)>(i, state, stencil, tangent, target);
  });
}

// With the normal force N and the friction F, r_s = -T_s N n - U_s F, where
//   dN/dq_t = -N' T_t n^T,   dU_s/dq_t = -r theta N_a N_b n^T   for the same director of two nodes,
//   dway/dq_t = U_t 1 - r theta N_b Dd_i n^T                    in the plane
template <class Space>
Verdict PlaneContact::assemble_item(std::size_t i, const model::State& state,
                                    const Stencil& stencil, bool tangent,
                                    model::Target& target) const {
  const int item = placement().items[i];
  const auto& [centre, radius, area, length] = point(item);
  const Evaluation found = evaluate(item, state, stencil);
  const Vec3& n = plane_.normal;
  const PlaneContactMotion::Slots r = -found.forces(n);
  const Verdict verdict =
      load::add_slot_residual<Space>(placement(), i, r, found.motion.arms_mid, target);
  if (!tangent || verdict != Verdict::ok) return verdict;

  const Mat3 by_depth = area * found.law.tangent * n * n.transpose();
  const Mat3 friction_by_depth =
      area * found.law.tangent * found.friction.by_normal * n.transpose();
  const Mat3 by_way = found.friction.by_way * (Mat3::Identity() - n * n.transpose());
  const auto& weights = centre.weights;
  const auto by_slots = [&](int a, int b) {
    Mat<12, 12> K;
    const double N_a = weights[static_cast<std::size_t>(a)];
    const double lever = radius * stencil.theta * weights[static_cast<std::size_t>(b)];
    for (int t = 0; t < 4; ++t) {
      const int column = 4 * b + t;
      Mat3 slide = found.U[column] * by_way - found.T[column] * friction_by_depth;
      if (t > 0) slide -= lever * by_way * found.moved.col(t - 1) * n.transpose();
      for (int s = 0; s < 4; ++s) {
        const int row = 4 * a + s;
        Mat3 block = found.T[row] * found.T[column] * by_depth - found.U[row] * slide;
        if (s == t && t > 0) block += N_a * lever * found.friction.force * n.transpose();
        K.block<3, 3>(3 * s, 3 * t) = block;
      }
    }
    return K;
  };
  load::add_dense_derivative<Space>(placement(), i, r, found.motion, stencil.theta, by_slots,
                                    target);
  return Verdict::ok;
}

double PlaneContact::stored_energy(const model::Coordinates& q) const {
  double energy = 0.0;
  for (std::size_t i = 0; i < placement().items.size(); ++i) {
    if (!placement().owned[i]) continue;
    const ContactPoint& one = point(placement().items[i]);
    energy += one.area * penalty_.energy(depth(one, q));
  }
  return energy;
}

model::StepWork PlaneContact::step_work(const model::State& state, const Stencil& stencil) const {
  model::StepWork work;
  for (std::size_t i = 0; i < placement().items.size(); ++i) {
    if (!placement().owned[i]) continue;
    const int item = placement().items[i];
    const ContactPoint& one = point(item);
    const Evaluation found = evaluate(item, state, stencil);
    load::add_item_work(found.forces(plane_.normal), found.motion, one.centre.nodes, state, false,
                        work);
    const double prev = depth(one, state.prev);
    const double next = depth(one, state.next);
    const double stored = penalty_.energy(next) - penalty_.energy(prev);
    work.damping += one.area * (found.law.pressure - found.law.elastic) * (next - prev) -
                    found.friction.force.dot(found.way);
    work.dissipation += one.area * (found.law.elastic * (next - prev) - stored);
  }
  return work;
}

}  // namespace culm::contact
