#include <culm/load/link_load.hpp>
#include <culm/load/slot_kernel.hpp>

#include "link_forms.hpp"
#include "measure.hpp"

#include <Eigen/Geometry>

#include <algorithm>
#include <array>
#include <tuple>

namespace culm::load {
namespace {

// B S, forces on slots side by side.
LinkSlots link_forces(const LinkGradient& B, const Vec<2>& stress) {
  LinkSlots forces(3, B.rows() / 3);
  Eigen::Map<Eigen::VectorXd>(forces.data(), B.rows()).noalias() = B * stress;
  return forces;
}

// Whether forms do not change under rigid motion: without vectors fixed in space, and with
// positions of which only differences count.
bool is_internal(const Link& link) {
  const auto moves_along = [](const Vec3& fixed, const model::SlotSum& factors) {
    double positions = 0.0;
    for (std::size_t s = 0; s < factors.size(); s += 4) positions += factors[s];
    return fixed.isZero(0.0) && positions == 0.0;
  };
  return std::ranges::all_of(link.forms, [&](const LinkForm& form) {
    return moves_along(form.p, form.alpha) && moves_along(form.w, form.beta);
  });
}

// A coordinate as laws know it.
double length_of(double z) { return z == no_length ? 0.0 : z; }

}  // namespace

void LinkLoad::add(Link link) {
  Item item;
  item.link = std::move(link);
  item.is_internal = is_internal(item.link);
  const Measure kind = item.link.measure;
  item.prev.y = values_of(item.link, slots_of(item.link, nodes_.reference()));
  // angles are zero in the reference
  item.prev.z = kind == Measure::angle ? 0.0 : measure(kind, item.prev.y, 0.0, item.prev.y);
  item.accepted = item.prev;
  items_.push_back(std::move(item));
}

std::vector<int> LinkLoad::blocks(int item, const model::UnknownTable& unknowns) const {
  std::vector<int> result;
  for (int node : items_[static_cast<std::size_t>(item)].link.nodes) {
    result.push_back(unknowns.node_block(node));
  }
  if (const model::Signal* signal = law_->signal()) {
    result.push_back(unknowns.own_block(signal->block));
  }
  return result;
}

void LinkLoad::place(model::Placement placement, model::Form form) {
  placement_ = std::move(placement);
  form_ = form;
  use_predicted_ = false;
}

LinkLoad::Place LinkLoad::follow(const Item& item, const Place& from, const Vec<2>& y) {
  return {y, measure(item.link.measure, from.y, from.z, y)};
}

void LinkLoad::prepare(const model::State& state, const Stencil&) {
  use_predicted_ = false;
  for (std::size_t i = 0; i < placement_.items.size(); ++i) {
    Item& item = this->item(i);
    const Vec<2> y = values_of(item.link, slots_of(item.link, state.prev));
    item.prev = follow(item, item.accepted, y);
    item.reached.reset();
  }
}

void LinkLoad::accept(model::State& state) {
  for (std::size_t i = 0; i < placement_.items.size(); ++i) {
    Item& item = this->item(i);
    const Vec<2> y = values_of(item.link, slots_of(item.link, state.next));
    item.accepted = item.prev = follow(item, item.prev, y);
    item.reached.reset();
  }
}

LinkLoad::Response LinkLoad::respond(const Item& item, const LinkSlots& next,
                                     const model::State& state, const Stencil& stencil) const {
  const MeasureStep step = measure_step(item.link.measure, item.prev.y, item.prev.z,
                                        values_of(item.link, next), stencil.theta);
  const double from = length_of(item.prev.z), to = length_of(step.next);
  const auto [force, derivative, by_signal] =
      law_->answer(from - item.link.rest, to - item.link.rest, state, stencil);
  if (from == 0.0 && step.next == no_length && force == 0.0) {
    return next_to_no_length(item.link.measure, derivative, step);
  }
  return {force * step.gradient,
          force * step.derivative + derivative * step.gradient * step.slope.transpose(),
          by_signal * step.gradient, force, step.next};
}

// Of a law that is zero there: its slope acts in all directions, by the stress on a square of a
// length, which is the same everywhere, or by its derivative.
LinkLoad::Response LinkLoad::next_to_no_length(Measure measure, double slope,
                                               const MeasureStep& step) {
  const double pull = slope * no_length;
  Response response{pull * step.gradient, Mat<2, 2>::Zero(), Vec<2>::Zero(), 0.0, step.next};
  if (measure == Measure::radius) response.tangent = pull * step.derivative;
  return response;
}

Verdict LinkLoad::assemble(const model::State& state, const Stencil& stencil, Want want,
                           model::Target& target) {
  if (want == Want::mass) return Verdict::ok;
  const bool tangent = want == Want::residual_and_tangent;
  Verdict verdict = Verdict::ok;
  for (std::size_t i = 0; i < placement_.items.size(); ++i) {
    verdict =
        worse(verdict, form_ == model::Form::null_space
                           ? assemble_item<model::NullSpace>(i, state, stencil, tangent, target)
                           : assemble_item<model::FullSpace>(i, state, stencil, tangent, target));
  }
  return verdict;
}

template <class Space>
Verdict LinkLoad::assemble_item(std::size_t i, const model::State& state, const Stencil& stencil,
                                bool tangent, model::Target& target) {
  Item& item = this->item(i);
  const Motion motion(nodes_, item.link.nodes, state, stencil.theta);
  const Response response = respond(item, motion.next, state, stencil);
  item.force = response.force;
  item.reached = response.reached;
  const LinkGradient B = gradient_of(item.link, motion.mid);
  const LinkSlots r = link_forces(B, response.stress);
  const Verdict verdict = add_slot_residual<Space>(placement_, i, r, motion.arms_mid, target);
  if (!tangent || verdict != Verdict::ok) return verdict;
  if (const model::Signal* signal = law_->signal()) {
    add_signal_columns<Space>(placement_, i, link_forces(B, response.by_signal), motion.arms_mid,
                              *signal, stencil.theta, target);
  }
  add_tangent<Space>(i, motion, response, stencil.theta, target);
  return Verdict::ok;
}

// R_theta D R_next^T + theta sum_k S_k A_k, with R = P^T B
template <class Space>
void LinkLoad::add_tangent(std::size_t i, const Motion& motion, const Response& response,
                           double theta, model::Target& target) const {
  constexpr int W = Space::width;
  const Item& item = this->item(i);
  const LinkGradient B_mid = gradient_of(item.link, motion.mid);
  const LinkGradient B_next = gradient_of(item.link, motion.next);
  const Vec<2>& stress = use_predicted_ ? item.predicted_stress : response.stress;
  const LinkScalars A = theta * curvature_of(item.link, stress);
  const auto reduced = [&item](const LinkGradient& B, const Motion::NodeArms& arms) {
    std::array<Eigen::Matrix<double, W, 2>, std::tuple_size_v<Motion::NodeArms>> R;
    for (std::size_t a = 0; a < item.link.nodes.size(); ++a) {
      Space::reduce_rows(B.middleRows<12>(12 * static_cast<int>(a)), arms[a], R[a]);
    }
    return R;
  };
  const auto R_mid = reduced(B_mid, motion.arms_mid);
  const auto R_next = reduced(B_next, motion.arms_next);
  const auto add_block = [&](int a, int b, auto& block) {
    const Eigen::Matrix<double, W, 2> RD =
        R_mid[static_cast<std::size_t>(a)].lazyProduct(response.tangent);
    block = RD.lazyProduct(R_next[static_cast<std::size_t>(b)].transpose());
    Space::add_pairs(A.template block<4, 4>(4 * a, 4 * b),
                     motion.arms_mid[static_cast<std::size_t>(a)],
                     motion.arms_next[static_cast<std::size_t>(b)], block);
  };
  add_slot_derivative<Space>(placement_, i, link_forces(B_mid, stress), motion, theta, add_block,
                             target);
}

void LinkLoad::extrapolate(const model::State& state, const Stencil& stencil,
                           const model::Coordinates& increment) {
  for (std::size_t i = 0; i < placement_.items.size(); ++i) {
    Item& item = this->item(i);
    const LinkSlots q = slots_of(item.link, state.next);
    const LinkSlots du = slots_of(item.link, increment);
    const Response response = respond(item, q, state, stencil);
    const LinkGradient B = gradient_of(item.link, q);
    Vec<2> dy = Vec<2>::Zero();
    for (Eigen::Index s = 0; s < q.cols(); ++s) {
      dy += B.middleRows<3>(3 * s).transpose() * du.col(s);
    }
    item.predicted_stress = response.stress + response.tangent * dy;
  }
  use_predicted_ = true;
}

void LinkLoad::save(model::Items which, std::span<double> memory) const {
  for (std::size_t i = 0; i < placement_.items.size(); ++i) {
    if (which == model::Items::owned && !placement_.owned[i]) continue;
    const auto place = item_memory * static_cast<std::size_t>(placement_.items[i]);
    const Place& accepted = item(i).accepted;
    memory[place] = accepted.y[0];
    memory[place + 1] = accepted.y[1];
    memory[place + 2] = accepted.z;
  }
}

void LinkLoad::restore(std::span<const double> memory) {
  for (std::size_t i = 0; i < items_.size(); ++i) {
    items_[i].accepted = {{memory[item_memory * i], memory[item_memory * i + 1]},
                          memory[item_memory * i + 2]};
    items_[i].prev = items_[i].accepted;
    items_[i].force.reset();  // that of another state
    items_[i].reached.reset();
  }
}

void LinkLoad::forget_evaluation() {
  for (Item& item : items_) {
    item.force.reset();
    item.reached.reset();
  }
}

double LinkLoad::stored_energy(const model::Coordinates& q) const {
  double energy = 0.0;
  for (std::size_t i = 0; i < placement_.items.size(); ++i) {
    if (!placement_.owned[i]) continue;
    const Item& item = this->item(i);
    const double z = follow(item, item.prev, values_of(item.link, slots_of(item.link, q))).z;
    energy += law_->energy(length_of(z) - item.link.rest);
  }
  return energy;
}

LinkLoad::Sample LinkLoad::sample(int item, const model::State& state) const {
  const auto at = std::find(placement_.items.begin(), placement_.items.end(), item);
  if (at == placement_.items.end()) return {};
  const auto i = static_cast<std::size_t>(at - placement_.items.begin());
  if (!placement_.owned[i]) return {};
  const Item& it = this->item(i);
  const double z = follow(it, it.prev, values_of(it.link, slots_of(it.link, state.next))).z;
  const double u = length_of(z) - it.link.rest;
  return {u, it.force ? *it.force : law_->answer(u, u, state, Stencil::statics()).force};
}

model::StepWork LinkLoad::step_work(const model::State& state, const Stencil& stencil) const {
  model::StepWork work;
  for (std::size_t i = 0; i < placement_.items.size(); ++i) {
    if (!placement_.owned[i]) continue;
    const Item& item = this->item(i);
    if (item.is_internal && item.reached) {
      law_->add_work(*item.force, item.prev.z - item.link.rest, *item.reached - item.link.rest,
                     work);
      continue;
    }
    const Motion motion(nodes_, item.link.nodes, state, stencil.theta);
    const Response response = respond(item, motion.next, state, stencil);
    law_->add_work(response.force, item.prev.z - item.link.rest, response.reached - item.link.rest,
                   work);
    const Vec<2>& stress = response.stress;
    const LinkGradient B = gradient_of(item.link, motion.mid);
    for (Eigen::Index s = 0; s < motion.mid.cols(); ++s) {
      const Vec3 force = -B.middleRows<3>(3 * s) * stress;
      if (s % 4 == 0) work.force += force;
      work.moment += Vec3(motion.mid.col(s)).cross(force);
    }
  }
  return work;
}

}  // namespace culm::load
