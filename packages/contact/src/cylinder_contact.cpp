#include <culm/contact/cylinder_contact.hpp>
#include <culm/load/slot_kernel.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace culm::contact {
namespace {

/// The nearest place on the axis over a step, from 0 to 1: its mean, and the mean of s c'(s), which
/// is the derivative of the mean by the end.
struct MeanPlace {
  double mean = 0.0;
  double derivative = 0.0;
};

MeanPlace mean_place(double prev, double next, const std::optional<double>& length) {
  if (!length) return {0.5 * (prev + next), 0.5};
  double ends[] = {0.0, 0.0, 0.0, 1.0};  // the place stands still beyond the ends of the axis
  if (next != prev) {
    ends[1] = std::clamp(-prev / (next - prev), 0.0, 1.0);
    ends[2] = std::clamp((*length - prev) / (next - prev), 0.0, 1.0);
    if (ends[1] > ends[2]) std::swap(ends[1], ends[2]);
  }
  MeanPlace place;
  for (int piece = 0; piece < 3; ++piece) {
    const double part = ends[piece + 1] - ends[piece];
    const double middle = 0.5 * (ends[piece] + ends[piece + 1]);
    const double y = prev + middle * (next - prev);
    place.mean += part * std::clamp(y, 0.0, *length);
    if (y > 0.0 && y < *length) place.derivative += part * middle;
  }
  return place;
}

/// The slots of a node, or those that nodes add up to.
struct FourSlots {
  using Slots = Eigen::Matrix<double, 3, 4>;
  Slots mid = Slots::Zero(), next = mid, moved = mid;

  void add(double weight, const Slots& at_theta, const Slots& at_end, const Slots& at_start) {
    mid += weight * at_theta;
    next += weight * at_end;
    moved += weight * (at_end - at_start);
  }
  /// A surface that touches at a place.
  SurfaceCarrier carry(const Vec3& place) const {
    return {moved.col(0), mid.rightCols<3>(), moved.rightCols<3>(), place - mid.col(0)};
  }
};

}  // namespace

/// Stress S of the forms in a step, dS/dy at its end, and what is stored and damped.
struct CylinderContact::Response {
  Vec<2> stress = Vec<2>::Zero();
  Mat<2, 2> tangent = Mat<2, 2>::Zero();
  double elastic_work = 0.0;                ///< of the part that the step stores [J]
  double work = 0.0;                        ///< of all of it [J]
  double normal = 0.0;                      ///< force that presses [N]
  Vec<2> normal_by_forms = Vec<2>::Zero();  ///< its derivative by the forms at the end
};

void CylinderContact::add(const ContactPoint& point) {
  Item item;
  item.nodes = point.centre.nodes;
  item.weights = point.centre.weights;
  item.offset = point.centre.offset;
  item.radius = point.radius;
  item.reach = point.radius + cylinder_.radius;
  item.area = point.area;
  item.length = point.length;
  item.R.setZero();
  item.E.setZero();
  for (std::size_t a = 0; a < item.nodes.size(); ++a) {
    item.R.segment<4>(4 * static_cast<int>(a)) << point.centre.weights[a],
        point.centre.weights[a] * point.centre.offset;
  }
  if (cylinder_.node < 0) {
    item.r0 = -cylinder_.a;
    item.e0 = cylinder_.along;
  } else {
    const int at = 4 * static_cast<int>(item.nodes.size());
    item.R.segment<4>(at) << -1.0, -cylinder_.a;
    item.E.segment<3>(at + 1) = cylinder_.along;
    item.nodes.push_back(cylinder_.node);
  }
  items_.push_back(std::move(item));
  if (friction_.coefficient > 0.0) add_grip();
}

std::vector<int> CylinderContact::blocks(int item, const model::UnknownTable& unknowns) const {
  return blocks_of(items_[static_cast<std::size_t>(item)].nodes, unknowns);
}

Vec<2> CylinderContact::forms(const Item& item, const model::Coordinates& q) const {
  Vec3 r = item.r0;
  Vec3 e = item.e0;
  for (std::size_t a = 0; a < item.nodes.size(); ++a) {
    const auto slots = model::NodeTable::slots(q, item.nodes[a]);
    r += slots * item.R.segment<4>(4 * static_cast<int>(a));
    e += slots * item.E.segment<4>(4 * static_cast<int>(a));
  }
  return {r.squaredNorm(), r.dot(e)};
}

double CylinderContact::distance(const Vec<2>& y) const {
  const double c = cylinder_.length ? std::clamp(y[1], 0.0, *cylinder_.length) : y[1];
  return std::sqrt(std::max(y[0] - 2.0 * c * y[1] + c * c, 0.0));
}

// A step that starts at its end has the gradient there: so statics is the same formula.
CylinderContact::Response CylinderContact::respond(const Item& item, const model::State& state,
                                                   const Stencil& stencil) const {
  const double end = 2.0 * stencil.theta_strain - 1.0;
  const Vec<2> y0 = forms(item, state.prev);
  const Vec<2> y1 = forms(item, state.next);
  const double D0 = distance(y0);
  const double D1 = distance(y1);
  const MeanPlace last = mean_place(y1[1], y1[1], cylinder_.length);
  const Vec<2> D1_y = Vec<2>(0.5, -last.mean) / D1;
  Response response;
  const auto add = [&](double weight, double from, const MeanPlace& place, double share,
                       const PenaltyResponse& law) {
    const double sum = from + D1;
    const Vec<2> G = Vec<2>(1.0, -2.0 * place.mean) / sum;
    // the end of the step moves all of the distance, or of a sum that is twice that
    Mat<2, 2> G_y = -share / sum * G * D1_y.transpose();
    G_y(1, 1) -= 2.0 * place.derivative * share / sum;
    response.stress -= weight * item.area * law.pressure * G;
    response.tangent +=
        weight * item.area * (law.tangent * G * D1_y.transpose() - law.pressure * G_y);
    response.normal += weight * item.area * law.pressure;
    response.normal_by_forms -= weight * item.area * law.tangent * D1_y;
    response.work -= weight * item.area * law.pressure * G.dot(y1 - y0);
    response.elastic_work -= weight * item.area * law.elastic * G.dot(y1 - y0);
  };
  const double depth0 = item.reach - D0;
  const double depth1 = item.reach - D1;
  if (end != 1.0) {
    Stencil mean = stencil;
    mean.theta_strain = 0.5;
    add(1.0 - end, D0, mean_place(y0[1], y1[1], cylinder_.length), 1.0,
        contact::respond(penalty_, depth0, depth1, mean));
  }
  if (end != 0.0) {
    Stencil late = stencil;
    late.theta_strain = 1.0;
    add(end, D1, last, 2.0, contact::respond(penalty_, depth0, depth1, late));
  }
  return response;
}

Vec3 CylinderContact::seen(const Item& item, const model::Coordinates& q) const {
  Vec3 r = item.r0;
  for (std::size_t a = 0; a < item.nodes.size(); ++a) {
    r += model::NodeTable::slots(q, item.nodes[a]) * item.R.segment<4>(4 * static_cast<int>(a));
  }
  if (cylinder_.node < 0) return r;
  return model::NodeTable::slots(q, cylinder_.node).rightCols<3>().transpose() * r;
}

double CylinderContact::distance_of(const Vec3& seen) const {
  return distance({seen.squaredNorm(), seen.dot(cylinder_.along)});
}

// The nearest place is where one of the three parts of the square of the distance is least, or one
// meets the next.
double CylinderContact::least_distance(const Vec3& from, const Vec3& to) const {
  const Vec3& e = cylinder_.along;
  const Vec3 way = to - from;
  const Vec3 across = way - e.dot(way) * e;
  const double along = e.dot(way);
  const double L = cylinder_.length.value_or(0.0);
  const double places[] = {1.0,
                           -from.dot(across) / across.squaredNorm(),
                           -from.dot(way) / way.squaredNorm(),
                           (L * e - from).dot(way) / way.squaredNorm(),
                           -from.dot(e) / along,
                           (L - from.dot(e)) / along};
  double least = distance_of(from);
  for (const double s : places) {
    const double there = distance_of(from + std::clamp(s, 0.0, 1.0) * way);
    if (there < least) least = there;  // not for a quotient by zero
  }
  return least;
}

// The straight way of the point as the bar sees it. What began inside is let out.
bool CylinderContact::passes(const Item& item, const model::State& state) const {
  const double deep = 0.5 * item.reach;
  const Vec3 from = seen(item, state.prev);
  const Vec3 to = seen(item, state.next);
  if (distance_of(from) < deep || distance_of(to) - (to - from).norm() > deep) return false;
  return least_distance(from, to) < deep;
}

// With x = C of the slots of the point, and of those of the bar r = x - A, e = E, all at theta:
//   d = r - c e, c = r . e / e . e between both ends;  p = x - s d, s the share of the radius
Pressed CylinderContact::press(int number, const Motion& motion, const Response& response,
                               const model::State& state, double theta, bool tangent) const {
  const Item& item = item_of(number);
  const auto points = static_cast<int>(item.weights.size());
  FourSlots point;
  FourSlots bar;
  for (int a = 0; a < points; ++a) {
    const auto at = static_cast<std::size_t>(a);
    point.add(item.weights[at], motion.mid.middleCols<4>(4 * a), motion.next.middleCols<4>(4 * a),
              model::NodeTable::slots(state.prev, item.nodes[at]));
  }
  if (cylinder_.node < 0) {
    FourSlots::Slots space;
    space << Vec3::Zero(), Mat3::Identity();
    bar.add(1.0, space, space, space);
  } else {
    bar.add(1.0, motion.mid.middleCols<4>(4 * points), motion.next.middleCols<4>(4 * points),
            model::NodeTable::slots(state.prev, cylinder_.node));
  }
  Vec<4> C;
  Vec<4> A;
  Vec<4> E;
  C << 1.0, item.offset;
  A << 1.0, cylinder_.a;
  E << 0.0, cylinder_.along;
  const Vec3 x = point.mid * C;
  const Vec3 r = x - bar.mid * A;
  const Vec3 e = bar.mid * E;
  const double square = e.squaredNorm();
  const double foot = r.dot(e) / square;
  const double c = cylinder_.length ? std::clamp(foot, 0.0, *cylinder_.length) : foot;
  const double share = item.radius / item.reach;
  const Vec3 d = r - c * e;
  const Vec3 place = x - share * d;
  Pressed pressed;
  pressed.first = bar.carry(place);
  pressed.second = point.carry(place);
  pressed.normal = d.normalized();
  pressed.force = response.normal;
  pressed.stiffness = item.area * penalty_.stiffness;
  pressed.grip = grip(number);
  if (!tangent) return pressed;

  const Vec3 r_next = point.next * C - bar.next * A;
  const Vec3 e_next = bar.next * E;
  const Mat3 turn = (Mat3::Identity() - pressed.normal * pressed.normal.transpose()) / d.norm();
  for (int t = 0; t < 8; ++t) {
    const auto at = static_cast<std::size_t>(t);
    const double x_t = t < 4 ? 0.0 : C[t % 4];
    const double r_t = t < 4 ? -A[t] : x_t;
    const double e_t = t < 4 ? E[t] : 0.0;
    Mat3 d_t = theta * (r_t - c * e_t) * Mat3::Identity();
    if (c == foot) d_t -= theta / square * e * (r_t * e + e_t * (r - 2.0 * c * e)).transpose();
    pressed.place_by_slot[at] = theta * x_t * Mat3::Identity() - share * d_t;
    pressed.normal_by_slot[at] = turn * d_t;
    pressed.force_by_slot[at] = 2.0 * response.normal_by_forms[0] * r_t * r_next +
                                response.normal_by_forms[1] * (r_t * e_next + e_t * r_next);
  }
  return pressed;
}

std::optional<Sliding> CylinderContact::friction_of(int number, const Motion& motion,
                                                    const Response& response,
                                                    const model::State& state,
                                                    const Stencil& stencil, bool tangent) const {
  if (friction_.coefficient == 0.0 || response.normal == 0.0) return {};
  return slide(press(number, motion, response, state, stencil.theta, tangent), friction_, stencil,
               tangent);
}

// As the bar sees it, so that it turns with it.
void CylinderContact::accept(model::State& state) {
  if (!has_grips()) return;
  for (const int number : placement().items) {
    const Item& item = item_of(number);
    const Motion motion(nodes_, item.nodes, state, stencil().theta);
    const std::optional<Sliding> sliding =
        friction_of(number, motion, respond(item, state, stencil()), state, stencil(), false);
    grip(number) = sliding ? sliding->force : Vec3(Vec3::Zero());
    if (cylinder_.node < 0) continue;
    grip(number) = model::NodeTable::slots(state.next, cylinder_.node).rightCols<3>().transpose() *
                   grip(number);
  }
}

Touch CylinderContact::touch(const model::Coordinates& q) const {
  Touch touch;
  touch.depth = -std::numeric_limits<double>::max();
  for (const Item& item : items_) {
    const double depth = item.reach - distance(forms(item, q));
    const double pressure = penalty_.pressure(depth);
    touch.force += item.area * pressure;
    touch.depth = std::max(touch.depth, depth);
    if (pressure > 0.0) touch.area += item.area;
  }
  return touch;
}

// Near the axis the way out is that of a digit, and whoever begins there is shot away by an energy
// that nobody has put in.
std::string CylinderContact::objection(const model::Coordinates& q) const {
  for (const Item& item : items_) {
    const double depth = item.reach - distance(forms(item, q));
    if (depth <= 0.5 * item.reach) continue;
    return fmt::format("lies {:.3g} m deep in the bar, more than half of both radii", depth);
  }
  return {};
}

// Between neighbours on a line, on the straight way.
std::string CylinderContact::overlooked(const model::Coordinates& q) const {
  double most = 0.0;
  double apart = 0.0;
  for (std::size_t i = 1; i < items_.size(); ++i) {
    const Item& one = items_[i - 1];
    const Item& other = items_[i];
    const Vec3 from = seen(one, q);
    const Vec3 to = seen(other, q);
    const double way = (to - from).norm();
    if (way > one.length + other.length) continue;
    const double between = least_distance(from, to);
    const double hidden = std::min(distance_of(from), distance_of(to)) - between;
    if (between >= one.reach || hidden < std::max(0.02 * one.reach, most)) continue;
    most = hidden;
    apart = way;
  }
  if (most == 0.0) return {};
  return fmt::format(
      "has points on its line {:.3g} m apart, and the bar lies {:.3g} m deeper between two of them "
      "than they see: what touches is missed, or comes too late; take more elements there",
      apart, most);
}

Verdict CylinderContact::assemble(const model::State& state, const Stencil& stencil, Want want,
                                  model::Target& target) {
  if (want == Want::mass) return Verdict::ok;
  const bool tangent = want == Want::residual_and_tangent;
  return assemble_items([&](auto space, std::size_t i) {
    return assemble_item<decltype(space)>(i, state, stencil, tangent, target);
  });
}

// dy1 = 2 r . dr, dy2 = e . dr + r . de
template <class Space>
Verdict CylinderContact::assemble_item(std::size_t i, const model::State& state,
                                       const Stencil& stencil, bool tangent,
                                       model::Target& target) const {
  const Item& item = local(i);
  if (passes(item, state)) return Verdict::law_out_of_range;
  const Motion motion(nodes_, item.nodes, state, stencil.theta);
  const Response response = respond(item, state, stencil);
  const std::optional<Sliding> sliding =
      friction_of(placement().items[i], motion, response, state, stencil, tangent);
  const auto vectors = [&](const Motion::Slots& q) {
    const auto n = static_cast<int>(q.cols());
    return std::pair<Vec3, Vec3>(q * item.R.head(n) + item.r0, q * item.E.head(n) + item.e0);
  };
  const auto [r, e] = vectors(motion.mid);
  const Vec<2>& S = response.stress;
  const Vec3 on_r = 2.0 * S[0] * r + S[1] * e;
  const Vec3 on_e = S[1] * r;
  Motion::Slots forces(3, motion.mid.cols());
  for (int s = 0; s < forces.cols(); ++s) forces.col(s) = on_r * item.R[s] + on_e * item.E[s];
  // a node is a part of the point, or the bar
  const auto points = static_cast<int>(item.weights.size());
  const auto weight = [&](int a) {
    return a < points ? item.weights[static_cast<std::size_t>(a)] : 1.0;
  };
  const auto side = [&](int a) { return a < points ? 4 : 0; };
  if (sliding) {
    for (int a = 0; a < static_cast<int>(item.nodes.size()); ++a) {
      forces.middleCols<4>(4 * a) -=
          weight(a) * sliding->force * sliding->factors.segment<4>(side(a)).transpose();
    }
  }
  const Verdict verdict =
      load::add_slot_residual<Space>(placement(), i, forces, motion.arms_mid, target);
  if (!tangent || verdict != Verdict::ok) return verdict;

  const auto [r_next, e_next] = vectors(motion.next);
  using Columns = Eigen::Matrix<double, 3, 2>;
  const auto gradient = [&](int s, const Vec3& at_r, const Vec3& at_e) {
    Columns B;
    B << 2.0 * item.R[s] * at_r, item.R[s] * at_e + item.E[s] * at_r;
    return B;
  };
  const auto by_slots = [&](int a, int b) {
    Mat<12, 12> K;
    for (int s = 0; s < 4; ++s) {
      const int row = 4 * a + s;
      const Columns stiff = gradient(row, r, e) * response.tangent;
      for (int t = 0; t < 4; ++t) {
        const int column = 4 * b + t;
        const double geometric =
            2.0 * S[0] * item.R[row] * item.R[column] +
            S[1] * (item.R[row] * item.E[column] + item.E[row] * item.R[column]);
        K.block<3, 3>(3 * s, 3 * t) = stiff * gradient(column, r_next, e_next).transpose() +
                                      stencil.theta * geometric * Mat3::Identity();
      }
    }
    if (sliding) {
      K += weight(a) * weight(b) * sliding->tangent.block<12, 12>(3 * side(a), 3 * side(b));
    }
    return K;
  };
  load::add_dense_derivative<Space>(placement(), i, forces, motion, stencil.theta, by_slots,
                                    target);
  return Verdict::ok;
}

double CylinderContact::stored_energy(const model::Coordinates& q) const {
  double energy = 0.0;
  for (std::size_t i = 0; i < placement().items.size(); ++i) {
    if (!placement().owned[i]) continue;
    energy += local(i).area * penalty_.energy(local(i).reach - distance(forms(local(i), q)));
  }
  return energy;
}

model::StepWork CylinderContact::step_work(const model::State& state,
                                           const Stencil& stencil) const {
  model::StepWork work;
  for (std::size_t i = 0; i < placement().items.size(); ++i) {
    if (!placement().owned[i]) continue;
    const Item& item = local(i);
    const Response response = respond(item, state, stencil);
    const Motion motion(nodes_, item.nodes, state, stencil.theta);
    const std::optional<Sliding> sliding =
        friction_of(placement().items[i], motion, response, state, stencil, false);
    work.damping += response.work - response.elastic_work;
    if (sliding) work.damping -= sliding->force.dot(sliding->way);
    work.dissipation +=
        response.elastic_work -
        item.area * (penalty_.energy(item.reach - distance(forms(item, state.next))) -
                     penalty_.energy(item.reach - distance(forms(item, state.prev))));
    if (cylinder_.node >= 0) continue;  // between bodies there is no resultant
    const auto n = static_cast<int>(motion.mid.cols());
    const Vec3 r = motion.mid * item.R.head(n) + item.r0;
    const Vec3 f = -2.0 * response.stress[0] * r - response.stress[1] * item.e0;
    Motion::Slots forces(3, n);
    for (int s = 0; s < n; ++s) {
      forces.col(s) = f * item.R[s];
      if (!sliding) continue;
      forces.col(s) += item.weights[static_cast<std::size_t>(s / 4)] * sliding->factors[4 + s % 4] *
                       sliding->force;
    }
    load::add_item_work(forces, motion, item.nodes, state, false, work);
  }
  return work;
}

}  // namespace culm::contact
