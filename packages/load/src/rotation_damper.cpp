#include <culm/joint/triad_nodes.hpp>
#include <culm/load/rotation_damper.hpp>

#include "both_frames.hpp"
#include "link_type.hpp"
#include "types.hpp"

#include <algorithm>
#include <cmath>
#include <memory>

namespace culm::load {

std::vector<int> RotationDamper::blocks(int item, const model::UnknownTable& unknowns) const {
  return {unknowns.node_block(items_[static_cast<std::size_t>(item)].node)};
}

template <class Space>
joint::AxisTurn<Space> RotationDamper::turn_of(std::size_t i, const model::State& state,
                                               const Stencil& stencil) const {
  const Item& item = items_[static_cast<std::size_t>(placement().items[i])];
  const Mat3 prev = model::NodeTable::slots(state.prev, item.node).rightCols<3>();
  const Mat3 next = model::NodeTable::slots(state.next, item.node).rightCols<3>();
  return {item.axis, prev, next, stencil.theta};
}

Verdict RotationDamper::assemble(const model::State& state, const Stencil& stencil, Want want,
                                 model::Target& target) {
  if (want == Want::mass || stencil.step == 0.0) return Verdict::ok;
  const bool tangent = want == Want::residual_and_tangent;
  return assemble_items([&](auto space, std::size_t i) {
    return assemble_item<decltype(space)>(i, state, stencil, tangent, target);
  });
}

template <class Space>
Verdict RotationDamper::assemble_item(std::size_t i, const model::State& state,
                                      const Stencil& stencil, bool tangent,
                                      model::Target& target) const {
  constexpr int W = Space::width;
  const joint::AxisTurn<Space> turn = turn_of<Space>(i, state, stencil);
  const double rate = turn.turn / stencil.step;
  const Vec<W> residual = moment_.value(rate) * turn.moment;
  if (!std::isfinite(residual.sum())) return Verdict::not_finite;
  target.force_scale = std::max(target.force_scale, residual.template lpNorm<Eigen::Infinity>());
  placement().scatter.add_residual(i, 0, residual.data(), target);
  if (!tangent) return Verdict::ok;
  const double slope = moment_.slope(rate) / stencil.step;
  const RowMat<W, W> block =
      moment_.value(rate) * turn.derivative + slope * turn.moment * turn.gradient.transpose();
  placement().scatter.add_tangent(i, 0, 0, block, target);
  return Verdict::ok;
}

model::StepWork RotationDamper::step_work(const model::State& state, const Stencil& stencil) const {
  model::StepWork work;
  if (stencil.step == 0.0) return work;
  for (std::size_t i = 0; i < placement().items.size(); ++i) {
    if (!placement().owned[i]) continue;
    const auto turn = turn_of<model::NullSpace>(i, state, stencil);
    const double moment = moment_.value(turn.turn / stencil.step);
    work.damping += moment * turn.turn;
    work.moment -= moment * turn.axis;
  }
  return work;
}

namespace {

void register_type(model::BuilderRegistry& registry, const std::string& type,
                   const std::string& doc, bool follows) {
  Schema schema(type, doc);
  schema.add(model::node_field());
  joint::add_direction("Axis", "Axis in the reference, of any length.", schema);
  add_damper_fields(LinkUnits::angles(), schema);
  registry.add(type, schema, [=](const Options& options, model::BuildContext& context) {
    const model::NodeTable& nodes = context.model.nodes();
    auto damper = std::make_unique<RotationDamper>(effect_of(type, options), nodes,
                                                   read_damper(options, LinkUnits::angles()));
    const auto selected = model::select_loaded_nodes(options, "Node", context);
    if (!joint::have_triads(selected, "Node", options, context)) return;
    for (int node : selected) {
      const Mat3 triad = model::NodeTable::slots(nodes.reference(), node).rightCols<3>();
      const Vec3 axis = model::vector(options, "Axis").normalized();
      damper->add(node, {follows ? Vec3(triad.transpose() * axis) : axis, follows});
    }
    context.model.add_load(std::move(damper));
  });
}

}  // namespace

void register_rotation_damper(model::BuilderRegistry& registry) {
  register_type(registry, "Rotation Damper",
                "Resists the angular velocity of a node about an axis fixed in space.", false);
  register_type(registry, "Rotation Damper Local",
                "Resists the angular velocity of a node about an axis fixed in it.", true);
}

}  // namespace culm::load
