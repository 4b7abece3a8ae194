#include <culm/load/catenary_load.hpp>
#include <culm/load/slot_kernel.hpp>

#include "link_forms.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

namespace culm::load {
namespace {

using CatenaryMotion = model::ItemMotion<max_link_nodes>;

// A fairlead above its anchor has the stiffness lim H / h, which this part of the length gives.
constexpr double least_distance = 1e-8;

/// W of the forms with its derivatives.
struct Potential {
  double value = 0.0;
  Vec<2> gradient = Vec<2>::Zero();
  Mat<2, 2> hessian = Mat<2, 2>::Zero();
};

CatenaryEnds ends_at(const CatenaryLine& line, const Vec<2>& y) {
  const double square = std::max(y[0] - y[1] * y[1], least_distance * least_distance);
  return hang(line, line.length * std::sqrt(square), line.length * y[1]);
}

// By the chain rule with h^2 = L^2 (y1 - y2^2) and z = L y2; c = L^2 H / h.
Potential by_forms(const CatenaryLine& line, const CatenaryEnds& ends, const Vec<2>& y) {
  const double L = line.length;
  const double h = L * std::max(std::sqrt(std::max(y[0] - y[1] * y[1], 0.0)), least_distance);
  const double H = ends.found ? ends.horizontal : std::nan("");
  const double c = L * L * H / h;
  const Vec<2> h_y(0.5 * L * L / h, -L * L * y[1] / h);
  const Vec<2> z_y(0.0, L);
  const Vec<2> V_y = ends.K(1, 0) * h_y + ends.K(1, 1) * z_y;
  const Vec<2> c_y = L * L / h * ((ends.K(0, 0) - H / h) * h_y + ends.K(0, 1) * z_y);
  Potential W;
  W.value = ends.energy;
  W.gradient << 0.5 * c, L * ends.vertical - c * y[1];
  W.hessian.row(0) = 0.5 * c_y.transpose();
  W.hessian.row(1) = (L * V_y - y[1] * c_y - c * Vec<2>::Unit(1)).transpose();
  return W;
}

Potential potential(const CatenaryLine& line, const Vec<2>& y) {
  const CatenaryLine smooth = line.without_friction();
  return by_forms(smooth, ends_at(smooth, y), y);
}

/// What friction on the seabed adds to the gradient, with its derivative.
struct Rubbing {
  Vec<2> value = Vec<2>::Zero();
  Mat<2, 2> derivative = Mat<2, 2>::Zero();
};

Rubbing rubbing(const CatenaryLine& line, const Vec<2>& y) {
  if (line.friction == 0.0) return {};
  const Potential with = by_forms(line, ends_at(line, y), y);
  const Potential without = potential(line, y);
  return {with.gradient - without.gradient, with.hessian - without.hessian};
}

// G(a, b) = g + (DW - g . d) d / |d|^2 with g in the middle and d = b - a, and its derivative by b.
void discrete_gradient(const CatenaryLine& line, const Vec<2>& a, const Vec<2>& b,
                       const Potential& end, Vec<2>& G, Mat<2, 2>& G_b) {
  const Potential middle = potential(line, 0.5 * (a + b));
  const Vec<2> d = b - a;
  const double d2 = d.squaredNorm();
  G = middle.gradient;
  G_b = 0.5 * middle.hessian;
  // DW - g . d is of third order in d; below this it is lost in round-off and does no work
  if (d2 < 1e-10) return;
  const double e = end.value - potential(line, a).value - G.dot(d);
  const Vec<2> e_b = end.gradient - G - G_b * d;
  G += e / d2 * d;
  G_b += d * e_b.transpose() / d2 + e / d2 * (Mat<2, 2>::Identity() - 2.0 * d * d.transpose() / d2);
}

LinkSlots catenary_forces(const LinkGradient& B, const Vec<2>& stress) {
  LinkSlots forces(3, B.rows() / 3);
  Eigen::Map<Eigen::VectorXd>(forces.data(), B.rows()).noalias() = B * stress;
  return forces;
}

}  // namespace

void CatenaryLoad::add(const LinkPoint& fairlead, const Vec3& anchor, const Vec3& up,
                       const CatenaryLine& line) {
  Item item;
  item.line = line;
  item.forms.nodes = {fairlead.node};
  model::SlotSum p = model::attached_point(0, 1, fairlead.offset);
  for (double& factor : p) factor /= line.length;
  const Vec3 origin = -anchor / line.length;
  item.forms.forms = {{p, origin, p, origin}, {p, origin, {}, up}};
  items_.push_back(std::move(item));
}

std::vector<int> CatenaryLoad::blocks(int item, const model::UnknownTable& unknowns) const {
  return blocks_of(items_[static_cast<std::size_t>(item)].forms.nodes, unknowns);
}

// The weight of the new strain adds to the stress as in SpringLaw.
CatenaryLoad::Response CatenaryLoad::respond(const Item& item, const model::State& state,
                                             const Stencil& stencil) const {
  const double end = 2.0 * stencil.theta_strain - 1.0;
  const Vec<2> y = values_of(item.forms, slots_of(item.forms, state.next));
  const Potential W = potential(item.line, y);
  const Rubbing last = rubbing(item.line, y);
  if (end == 1.0) return {W.gradient, last.value, W.hessian + last.derivative};
  const Vec<2> y_prev = values_of(item.forms, slots_of(item.forms, state.prev));
  const Rubbing middle = rubbing(item.line, 0.5 * (y_prev + y));
  Response response;
  discrete_gradient(item.line, y_prev, y, W, response.stress, response.tangent);
  response.stress = (1.0 - end) * response.stress + end * W.gradient;
  response.friction = (1.0 - end) * middle.value + end * last.value;
  response.tangent = (1.0 - end) * (response.tangent + 0.5 * middle.derivative) +
                     end * (W.hessian + last.derivative);
  return response;
}

Verdict CatenaryLoad::assemble(const model::State& state, const Stencil& stencil, Want want,
                               model::Target& target) {
  if (want == Want::mass) return Verdict::ok;
  const bool tangent = want == Want::residual_and_tangent;
  return assemble_items([&](auto space, std::size_t i) {
    return assemble_item<decltype(space)>(i, state, stencil, tangent, target);
  });
}

// K = B_theta D B_next^T + theta sum_k S_k A_k
template <class Space>
Verdict CatenaryLoad::assemble_item(std::size_t i, const model::State& state,
                                    const Stencil& stencil, bool tangent,
                                    model::Target& target) const {
  const Item& item = local(i);
  const CatenaryMotion motion(nodes_, item.forms.nodes, state, stencil.theta);
  const Response response = respond(item, state, stencil);
  const LinkGradient B = gradient_of(item.forms, motion.mid);
  const LinkSlots r = catenary_forces(B, response.sum());
  const Verdict verdict = add_slot_residual<Space>(placement(), i, r, motion.arms_mid, target);
  if (!tangent || verdict != Verdict::ok) return verdict;

  Mat<12, 12> K = B * response.tangent * gradient_of(item.forms, motion.next).transpose();
  const LinkScalars A = stencil.theta * curvature_of(item.forms, response.sum());
  for (int s = 0; s < 4; ++s) {
    for (int t = 0; t < 4; ++t) K.block<3, 3>(3 * s, 3 * t) += A(s, t) * Mat3::Identity();
  }
  add_dense_derivative<Space>(
      placement(), i, r, motion, stencil.theta, [&](int, int) -> const Mat<12, 12>& { return K; },
      target);
  return Verdict::ok;
}

CatenaryEnds CatenaryLoad::ends(int item, const model::Coordinates& q) const {
  const Item& it = items_[static_cast<std::size_t>(item)];
  return ends_at(it.line, values_of(it.forms, slots_of(it.forms, q)));
}

double CatenaryLoad::stored_energy(const model::Coordinates& q) const {
  double energy = 0.0;
  for (std::size_t i = 0; i < placement().items.size(); ++i) {
    if (placement().owned[i]) energy += ends(placement().items[i], q).energy;
  }
  return energy;
}

model::StepWork CatenaryLoad::step_work(const model::State& state, const Stencil& stencil) const {
  model::StepWork work;
  for (std::size_t i = 0; i < placement().items.size(); ++i) {
    if (!placement().owned[i]) continue;
    const Item& item = local(i);
    const CatenaryMotion motion(nodes_, item.forms.nodes, state, stencil.theta);
    const Response response = respond(item, state, stencil);
    add_item_work(LinkSlots(-catenary_forces(gradient_of(item.forms, motion.mid), response.sum())),
                  motion, item.forms.nodes, state, false, work);
    const Vec<2> y = values_of(item.forms, slots_of(item.forms, state.next));
    const Vec<2> y_prev = values_of(item.forms, slots_of(item.forms, state.prev));
    work.external -= response.friction.dot(y - y_prev);
    work.dissipation += response.stress.dot(y - y_prev) - potential(item.line, y).value +
                        potential(item.line, y_prev).value;
  }
  return work;
}

}  // namespace culm::load
