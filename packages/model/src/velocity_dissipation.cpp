#include <culm/model/massless.hpp>
#include <culm/model/projection.hpp>
#include <culm/model/velocity_dissipation.hpp>

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>

namespace culm::model {
namespace {

// What remains of a column that depends on others is rounding.
constexpr double dependent = 1e-11;
// Pi depends on the mean velocity, which depends on Pi; each iteration gains some digits.
constexpr int most_iterations = 30;
constexpr double settled = 1e-15;

}  // namespace

VelocityDissipation& VelocityDissipation::of(Model& model) {
  for (const auto& load : model.loads()) {
    if (auto* found = dynamic_cast<VelocityDissipation*>(load.get())) return *found;
  }
  auto made = std::make_unique<VelocityDissipation>(model);
  VelocityDissipation& result = *made;
  model.add_load(std::move(made));
  return result;
}

void VelocityDissipation::add_body(std::vector<int> nodes, double chi) {
  for (int i = 0; i < static_cast<int>(nodes.size()); ++i) {
    items_.emplace_back(static_cast<int>(bodies_.size()), i);
  }
  bodies_.emplace_back();
  bodies_.back().nodes = std::move(nodes);
  bodies_.back().chi = chi;
}

std::vector<int> VelocityDissipation::blocks(int item, const UnknownTable& unknowns) const {
  const auto [body, i] = items_[static_cast<std::size_t>(item)];
  const auto& nodes = bodies_[static_cast<std::size_t>(body)].nodes;
  return {unknowns.node_block(nodes[static_cast<std::size_t>(i)])};
}

void VelocityDissipation::place(Placement placement, Form form) {
  placement_ = std::move(placement);
  form_ = form;
  // the owner of its first node counts a body
  for (std::size_t i = 0; i < placement_.items.size(); ++i) {
    const auto [body, node] = items_[static_cast<std::size_t>(placement_.items[i])];
    if (node == 0) bodies_[static_cast<std::size_t>(body)].counted = placement_.owned[i];
  }
  collect_masses();
}

void VelocityDissipation::collect_masses() {
  for (const auto& batch : model_.element_batches()) {
    if (const auto* source = dynamic_cast<const MassSource*>(batch.get())) {
      masses_.push_back(source);
    }
  }
  has_mass_ = slots_with_mass(model_);
  Coordinates ones(model_.nodes().reference().size(), 0.0);
  for (std::size_t i = 0; i < ones.size(); i += 12) ones[i] = 1.0;
  const Coordinates image = model_.mass_times(ones);
  for (Body& body : bodies_) {
    const auto size = static_cast<Eigen::Index>(12 * body.nodes.size());
    body.position_mass.resize(size / 3);
    for (std::size_t a = 0; a < body.nodes.size(); ++a) {
      const auto slots = NodeTable::slots(image, body.nodes[a]);
      body.position_mass.segment<4>(static_cast<Eigen::Index>(4 * a)) = slots.row(0).transpose();
      body.mass += slots(0, 0);
    }
    for (Pair* pair : {&body.velocity, &body.mean, &body.plain, &body.damped, &body.moving}) {
      pair->x.setZero(size);
      pair->mx.setZero(size);
    }
    body.z.setZero(size, 9);
    body.mz.setZero(size, 9);
  }
}

// values of the whole model and their product with the mass, cut into bodies
void VelocityDissipation::take(const Coordinates& values, Pair Body::*pair) {
  product_.assign(values.size(), 0.0);
  for (const MassSource* source : masses_) source->add_mass_times(values, product_);
  for (Body& body : bodies_) {
    for (std::size_t a = 0; a < body.nodes.size(); ++a) {
      const auto at = static_cast<Eigen::Index>(12 * a);
      (body.*pair).x.segment<12>(at) = NodeTable::slots(values, body.nodes[a]).reshaped();
      (body.*pair).mx.segment<12>(at) =
          NodeTable::slots(std::as_const(product_), body.nodes[a]).reshaped();
    }
  }
}

void VelocityDissipation::prepare(const State& state, const Stencil& stencil) {
  step_ = stencil.inertia == 0.0 ? 0.0 : stencil.step;
  if (step_ == 0.0) return;
  take(state.velocity, &Body::velocity);
}

void VelocityDissipation::project_all(const State& state, double h) {
  values_.resize(state.next.size());
  for (std::size_t i = 0; i < values_.size(); ++i) {
    values_[i] = 0.5 * (state.prev[i] + state.next[i]);
  }
  take(values_, &Body::mean);
  for (std::size_t i = 0; i < values_.size(); ++i) {
    values_[i] = 2.0 / h * (state.next[i] - state.prev[i]);
  }
  take(values_, &Body::plain);
  for (Body& body : bodies_) {
    body.plain.x -= 2.0 * body.velocity.x;
    body.plain.mx -= 2.0 * body.velocity.mx;
    project(body);
  }
}

// Takes the mean over the mass from positions, which changes no span and makes sums small.
void VelocityDissipation::centre(const Body& body, Pair& pair) {
  Vec3 mean = Vec3::Zero();
  for (Eigen::Index at = 0; at < pair.x.size(); at += 12) mean += pair.mx.segment<3>(at);
  mean /= body.mass;
  for (Eigen::Index at = 0; at < pair.x.size(); at += 12) pair.x.segment<3>(at) -= mean;
  for (Eigen::Index slot = 0; slot < body.position_mass.size(); ++slot) {
    pair.mx.segment<3>(3 * slot) -= body.position_mass[slot] * mean;
  }
}

// Columns e_i x x_s; the mass matrix consists of scalars, so M (e_i x x) = e_i x (M x).
void VelocityDissipation::set_turns(Body& body, int first, const Pair& pair) {
  for (Eigen::Index at = 0; at < pair.x.size(); at += 3) {
    body.z.block<3, 3>(at, first) = -skew(pair.x.segment<3>(at));
    body.mz.block<3, 3>(at, first) = -skew(pair.mx.segment<3>(at));
  }
}

// Modified Gram-Schmidt in the metric of the mass, twice.
void VelocityDissipation::orthonormalise(Body& body, int first, int last) {
  for (int c = first; c < last; ++c) {
    auto z = body.z.col(c);
    auto mz = body.mz.col(c);
    const double size = std::sqrt(std::max(0.0, z.dot(mz)));
    for (int pass = 0; pass < 2; ++pass) {
      for (int other = 0; other < c; ++other) {
        const double share = body.mz.col(other).dot(z);
        z -= share * body.z.col(other);
        mz -= share * body.mz.col(other);
      }
    }
    const double rest = std::sqrt(std::max(0.0, z.dot(mz)));
    const double factor = rest > dependent * size ? 1.0 / rest : 0.0;
    z *= factor;
    mz *= factor;
  }
}

void VelocityDissipation::project(Body& body) {
  centre(body, body.mean);
  for (Eigen::Index slot = 0; slot < body.position_mass.size(); ++slot) {
    const double here = slot % 4 == 0 ? 1.0 : 0.0;
    body.z.block<3, 3>(3 * slot, 0) = here * Mat3::Identity();
    body.mz.block<3, 3>(3 * slot, 0) = body.position_mass[slot] * Mat3::Identity();
  }
  set_turns(body, 3, body.mean);
  orthonormalise(body, 0, 6);

  const double share = 0.5 * body.chi / (1.0 + body.chi);
  const double size = body.plain.x.norm();
  body.damped.x.setZero();
  body.damped.mx.setZero();
  double before = 0.0;
  for (int i = 0; i < most_iterations; ++i) {
    // v_mean = v_prev + 1/2 Dv
    body.moving.x = body.velocity.x + 0.5 * body.plain.x - share * body.damped.x;
    body.moving.mx = body.velocity.mx + 0.5 * body.plain.mx - share * body.damped.mx;
    centre(body, body.moving);
    set_turns(body, 6, body.moving);
    orthonormalise(body, 6, 9);
    body.last = body.damped.x;
    body.damped = body.plain;
    for (int pass = 0; pass < 2; ++pass) {
      for (int c = 0; c < 9; ++c) {
        const double coefficient = body.mz.col(c).dot(body.damped.x);
        body.damped.x -= coefficient * body.z.col(c);
        body.damped.mx -= coefficient * body.mz.col(c);
      }
    }
    const double change = (body.damped.x - body.last).norm();
    if (change <= settled * size || (i > 2 && change >= before)) break;
    before = change;
  }
}

Verdict VelocityDissipation::assemble(const State& state, const Stencil& stencil, Want want,
                                      Target& target) {
  if (stencil.inertia == 0.0 || want == Want::mass) return Verdict::ok;
  project_all(state, stencil.step);
  for (std::size_t i = 0; i < placement_.items.size(); ++i) {
    const auto [number, a] = items_[static_cast<std::size_t>(placement_.items[i])];
    const Body& body = bodies_[static_cast<std::size_t>(number)];
    const int node = body.nodes[static_cast<std::size_t>(a)];
    // M (Dv - s) / h
    const Vec<12> force =
        -body.chi / ((1.0 + body.chi) * stencil.step) * body.damped.mx.segment<12>(12 * a);
    if (!std::isfinite(force.sum())) return Verdict::not_finite;
    const Arms<4> arms = at_theta(stencil.theta, arms_of(model_.nodes(), node, state.prev),
                                  arms_of(model_.nodes(), node, state.next));
    Vec<12> residual = force;
    if (form_ == Form::null_space) {
      RowMat<NullSpace::width, 1> reduced;
      NullSpace::reduce_rows(force, arms, reduced);
      residual.head<NullSpace::width>() = reduced;
    }
    placement_.scatter.add_residual(i, 0, residual.data(), target);
  }
  return Verdict::ok;
}

void VelocityDissipation::accept(State& state) {
  if (step_ == 0.0) return;
  project_all(state, step_);
  for (const Body& body : bodies_) {
    const double share = body.chi / (1.0 + body.chi);
    for (std::size_t a = 0; a < body.nodes.size(); ++a) {
      const int node = body.nodes[a];
      auto velocity = NodeTable::slots(state.velocity, node);
      for (int s = 0; s < 4; ++s) {
        if (!has_mass_[static_cast<std::size_t>(4 * node + s)]) continue;
        velocity.col(s) -=
            share * body.damped.x.segment<3>(static_cast<Eigen::Index>(12 * a) + 3 * s);
      }
    }
  }
}

// 1/2 chi |(1 - Pi) Dv|^2 with (1 - Pi) Dv = (1 - Pi) s / (1 + chi)
StepWork VelocityDissipation::step_work(const State&, const Stencil&) const {
  StepWork work;
  for (const Body& body : bodies_) {
    if (!body.counted) continue;
    work.dissipation +=
        0.5 * body.chi / ((1.0 + body.chi) * (1.0 + body.chi)) * body.damped.x.dot(body.damped.mx);
  }
  return work;
}

}  // namespace culm::model
