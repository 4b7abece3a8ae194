#include <culm/joint/angular_velocity.hpp>
#include <culm/joint/rotation.hpp>
#include <culm/joint/triad_nodes.hpp>
#include <culm/math/rotation.hpp>
#include <culm/model/signal_column.hpp>

#include "supports.hpp"

#include <algorithm>
#include <cmath>
#include <memory>

namespace culm::joint {
namespace {

Mat3 directors(const model::Coordinates& q, int node) {
  return model::NodeTable::slots(q, node).rightCols<3>();
}

}  // namespace

model::Constraint AngularVelocity::constraint(std::string name, const std::string& type,
                                              const model::NodeTable& nodes, int node,
                                              const Vec3& axis) {
  model::Constraint constraint = support_of(Anchor(nodes, node));
  constraint.name = std::move(name);
  constraint.type = type;
  constraint.rows = constraint.velocity_rows = rotation(Anchor(nodes, node), axis, {}).rows;
  return constraint;
}

void AngularVelocity::add(int node, const TurnAxis& axis, const Prescribed& velocity,
                          std::string constraint) {
  const int block = model_.add_own_block(
      {effect().title(), {{"moment", model::UnknownKind::multiplier, 1.0, 0.0}}});
  items_.push_back({node, axis, velocity, std::move(constraint), model_.signal(block, 0)});
}

std::vector<int> AngularVelocity::blocks(int item, const model::UnknownTable& unknowns) const {
  const Item& it = items_[static_cast<std::size_t>(item)];
  std::vector<int> result = {unknowns.node_block(it.node), unknowns.own_block(it.moment.block)};
  if (const model::Signal* signal = it.velocity.function.signal()) {
    result.push_back(unknowns.own_block(signal->block));
  }
  return result;
}

Verdict AngularVelocity::assemble(const model::State& state, const Stencil& stencil, Want want,
                                  model::Target& target) {
  if (want == Want::mass) {
    return assemble_items([&](auto space, std::size_t i) {
      return assemble_border<decltype(space)>(i, state, target);
    });
  }
  if (stencil.step == 0.0) {
    for (std::size_t i = 0; i < placement().items.size(); ++i) {
      assemble_rest(i, state, want, target);
    }
    return Verdict::ok;
  }
  return assemble_items([&](auto space, std::size_t i) {
    return assemble_item<decltype(space)>(i, state, stencil, want, target);
  });
}

// lambda = 0
void AngularVelocity::assemble_rest(std::size_t i, const model::State& state, Want want,
                                    model::Target& target) const {
  const Item& item = items_[static_cast<std::size_t>(placement().items[i])];
  const double lambda = item.moment.in_step(state, 1.0);
  placement().scatter.add_residual(i, 1, &lambda, target);
  if (want == Want::residual) return;
  placement().scatter.add_tangent(i, 1, 1, Mat<1, 1>(target.multiplier_scale), target);
}

// n . omega at the end of the step on both sides, as it borders a mass matrix, and what it is to
// be.
template <class Space>
Verdict AngularVelocity::assemble_border(std::size_t i, const model::State& state,
                                         model::Target& target) const {
  const Item& item = items_[static_cast<std::size_t>(placement().items[i])];
  const Mat3 d = directors(state.next, item.node);
  const AxisTurn<Space> turn(item.axis, d, d, 1.0);
  const double scale = target.multiplier_scale;
  const double row = -scale * item.velocity.in_step(state, 1.0);
  placement().scatter.add_residual(i, 1, &row, target);
  placement().scatter.add_tangent(i, 0, 1, Vec<Space::width>(scale * turn.moment), target);
  const Mat<1, Space::width> gradient = scale * turn.gradient.transpose();
  placement().scatter.add_tangent(i, 1, 0, gradient, target);
  return std::isfinite(row) ? Verdict::ok : Verdict::not_finite;
}

template <class Space>
Verdict AngularVelocity::assemble_item(std::size_t i, const model::State& state,
                                       const Stencil& stencil, Want want,
                                       model::Target& target) const {
  constexpr int W = Space::width;
  const Item& item = items_[static_cast<std::size_t>(placement().items[i])];
  const AxisTurn<Space> turn(item.axis, directors(state.prev, item.node),
                             directors(state.next, item.node), stencil.theta);
  const double lambda = item.moment.in_step(state, 1.0);
  const double half_angle = 0.5 * item.velocity.integral(state, 1.0);
  const double h = turn.turn - 2.0 * std::tan(half_angle);
  const Vec<W> force = lambda * turn.moment;
  if (!std::isfinite(h + force.sum())) return Verdict::not_finite;
  target.force_scale = std::max(target.force_scale, force.template lpNorm<Eigen::Infinity>());
  target.constraint_violation = std::max(target.constraint_violation, std::abs(h));
  const double scale = target.multiplier_scale;
  const double row = scale * h;
  placement().scatter.add_residual(i, 0, force.data(), target);
  placement().scatter.add_residual(i, 1, &row, target);
  if (want == Want::residual) return Verdict::ok;
  placement().scatter.add_tangent(i, 0, 0, RowMat<W, W>(lambda * turn.derivative), target);
  placement().scatter.add_tangent(i, 0, 1, Vec<W>(scale * turn.moment), target);
  const Mat<1, W> gradient = scale * turn.gradient.transpose();
  placement().scatter.add_tangent(i, 1, 0, gradient, target);
  if (const model::Signal* signal = item.velocity.function.signal()) {
    const double cosine = std::cos(half_angle);
    const Vec<1> derivative(-scale * stencil.step * item.velocity.amount / (cosine * cosine));
    model::add_signal_column(placement().scatter, i, 1, 2, *signal, 0.5, derivative, target);
  }
  return Verdict::ok;
}

model::StepWork AngularVelocity::step_work(const model::State& state,
                                           const Stencil& stencil) const {
  model::StepWork work;
  if (stencil.step == 0.0) return work;
  for (std::size_t i = 0; i < placement().items.size(); ++i) {
    if (!placement().owned[i]) continue;
    const Item& item = items_[static_cast<std::size_t>(placement().items[i])];
    const AxisTurn<model::NullSpace> turn(item.axis, directors(state.prev, item.node),
                                          directors(state.next, item.node), stencil.theta);
    work.drives -= item.moment.in_step(state, 1.0) * turn.turn;
  }
  return work;
}

Vec6 AngularVelocity::reaction(int node, const model::State& state,
                               const std::string& constraint) const {
  Vec6 total = Vec6::Zero();
  for (const Item& item : items_) {
    if (item.node != node || (!constraint.empty() && item.constraint != constraint)) continue;
    const Vec3 n = item.axis.follows ? Vec3(directors(state.next, node) * item.axis.components)
                                     : item.axis.components;
    total.tail<3>() -= item.moment.in_step(state, 1.0) * n;
  }
  return total;
}

namespace {

void register_angular_velocity_type(model::BuilderRegistry& registry, const std::string& type,
                                    const std::string& doc, bool follows) {
  Schema schema = directed_schema(type, doc, "Axis", "Axis in the reference, of any length.",
                                  model::node_field());
  add_motion("Angular Velocity", "rad/s", "Angular velocity at function value 1.", schema);
  registry.add(type, schema, [=](const Options& options, model::BuildContext& context) {
    const auto velocity =
        read_motion(options, "Angular Velocity", context, "Function", model::Follows::signals);
    if (!velocity) return;
    model::Model& model = context.model;
    const std::vector<int> nodes = model::select_nodes(options, "Node", context);
    if (!have_triads(nodes, "Node", options, context)) return;
    auto batch = std::make_unique<AngularVelocity>(model::Effect(type, options.name()), model);
    for (int node : nodes) {
      Vec3 axis = read_direction(options, "Axis");
      model::Constraint constraint =
          AngularVelocity::constraint(options.name(), type, model.nodes(), node, axis);
      constraint.where = options.where();
      constraint.turn.emplace().prescribed = [motion = *velocity](const model::State& state,
                                                                  double theta) {
        return motion.integral(state, theta);
      };
      model.add_constraint(std::move(constraint));
      if (follows) axis = directors(model.nodes().reference(), node).transpose() * axis;
      batch->add(node, {axis, follows}, *velocity, options.name());
    }
    model.add_load(std::move(batch));
  });
}

}  // namespace

void register_angular_velocity(model::BuilderRegistry& registry) {
  register_angular_velocity_type(
      registry, "Angular Velocity",
      "Prescribes the angular velocity about an axis fixed in space; not in statics.", false);
  register_angular_velocity_type(
      registry, "Angular Velocity Local",
      "Prescribes the angular velocity about an axis fixed in the node; not in statics.", true);
}

}  // namespace culm::joint
