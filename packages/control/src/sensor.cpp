#include <culm/control/sensor.hpp>
#include <culm/joint/marker_pair.hpp>
#include <culm/joint/triad_nodes.hpp>

#include "fields.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

namespace culm::control {

model::Signal SensorBatch::add(const std::string& name, Measured measured,
                               std::vector<Place> places, double scale) {
  const int block =
      model_.add_own_block({name, {{"output", model::UnknownKind::algebraic, scale}}});
  const model::Signal signal = model_.signal(block, 0);
  items_.push_back({measured, std::move(places), signal});
  return signal;
}

std::vector<int> SensorBatch::blocks(int item, const model::UnknownTable& unknowns) const {
  const Item& it = items_[static_cast<std::size_t>(item)];
  std::vector<int> result = {unknowns.own_block(it.signal.block)};
  for (const Place& place : it.places) result.push_back(unknowns.node_block(place.node));
  return result;
}

Verdict SensorBatch::assemble(const model::State& state, const Stencil& stencil, Want want,
                              model::Target& target) {
  if (want == Want::mass) {  // no part in inertia
    for (std::size_t i = 0; i < placement().items.size(); ++i) {
      placement().scatter.add_tangent(i, 0, 0, Mat<1, 1>(1.0), target);
    }
    return Verdict::ok;
  }
  return assemble_items([&](auto space, std::size_t i) {
    return assemble_item<decltype(space)>(i, state, stencil, want == Want::residual_and_tangent,
                                          target);
  });
}

template <class Space>
SensorBatch::Reading<Space> SensorBatch::read(Measured measured, const Place& place,
                                              const model::State& state,
                                              const Stencil& stencil) const {
  Reading<Space> reading;
  const double h = stencil.step;
  const auto prev = model::NodeTable::slots(state.prev, place.node);
  const auto next = model::NodeTable::slots(state.next, place.node);
  if (measured == Measured::angular_velocity) {
    if (h == 0.0) return reading;
    const joint::AxisTurn<Space> turn(place.axis, prev.rightCols<3>(), next.rightCols<3>(), 0.5);
    const double half = 0.5 * turn.turn;
    reading.value = 2.0 * std::atan(half) / h;
    reading.gradient = turn.gradient / (h * (1.0 + half * half));
    return reading;
  }
  const Vec3& direction = place.axis.components;
  double by_position = 0.0;
  if (measured == Measured::velocity) {
    if (h == 0.0) return reading;
    reading.value = direction.dot(next.col(0) - prev.col(0)) / h;
    by_position = 1.0 / h;
  } else {
    const double theta = h > 0.0 ? 0.5 : 1.0;
    const Vec3 x = (1.0 - theta) * prev.col(0) + theta * next.col(0);
    const auto reference = model::NodeTable::slots(model_.nodes().reference(), place.node);
    reading.value = direction.dot(x - reference.col(0));
    by_position = theta;
  }
  Vec<12> rows = Vec<12>::Zero();
  rows.head<3>() = by_position * direction;
  Space::reduce_rows(rows, model::arms_of(model_.nodes(), place.node, state.next),
                     reading.gradient);
  return reading;
}

template <class Space>
Verdict SensorBatch::assemble_item(std::size_t i, const model::State& state, const Stencil& stencil,
                                   bool tangent, model::Target& target) const {
  const Item& item = items_[static_cast<std::size_t>(placement().items[i])];
  const double scale = item.signal.scale;
  const double output = item.signal.in_step(state, 1.0);
  double residual = output;
  double sign = 1.0;
  for (std::size_t a = 0; a < item.places.size(); ++a, sign = -1.0) {
    const Reading<Space> reading = read<Space>(item.measured, item.places[a], state, stencil);
    residual -= sign * reading.value;
    if (!tangent) continue;
    const Mat<1, Space::width> gradient = -sign / scale * reading.gradient.transpose();
    placement().scatter.add_tangent(i, 0, static_cast<int>(a) + 1, gradient, target);
  }
  if (!std::isfinite(residual)) return Verdict::not_finite;
  target.constraint_violation =
      std::max(target.constraint_violation, std::abs(residual) / std::max(scale, std::abs(output)));
  residual /= scale;
  placement().scatter.add_residual(i, 0, &residual, target);
  if (tangent) placement().scatter.add_tangent(i, 0, 0, Mat<1, 1>(1.0), target);
  return Verdict::ok;
}

namespace {

constexpr const char* against = "Relative To";

// The only node that a parameter names; -1, and an issue, if there is none.
int find_node(const Options& options, const std::string& parameter, ControlContext& context) {
  const std::vector<int> nodes = model::select_nodes(options, parameter, context.build());
  if (nodes.size() > 1) {
    context.build().issues.add(options.where(parameter), "names " + std::to_string(nodes.size()) +
                                                             " nodes, but one is measured");
  }
  return nodes.size() == 1 ? nodes.front() : -1;
}

void register_type(SignalRegistry& registry, Schema schema, const std::string& direction,
                   const std::string& direction_doc, Measured measured, bool follows) {
  const std::string type = schema.name();
  schema.add(model::node_field("Node", "The node that is measured."))
      .add(text(against, "Another node, whose value is subtracted.").optional());
  joint::add_direction(direction, direction_doc, schema);
  add_scale(schema);
  registry.add(type, schema, [=](const Options& options, ControlContext& context) {
    std::vector<std::string> parameters = {"Node"};
    if (options.has(against)) parameters.emplace_back(against);
    const Vec3 axis = model::vector(options, direction).normalized();
    std::vector<SensorBatch::Place> places;
    for (const std::string& parameter : parameters) {
      const int node = find_node(options, parameter, context);
      if (node < 0) return;
      if (measured == Measured::angular_velocity &&
          !joint::have_triads({node}, parameter, options, context.build())) {
        return;
      }
      const auto& reference = context.build().model.nodes().reference();
      const Mat3 triad = model::NodeTable::slots(reference, node).rightCols<3>();
      places.push_back({node, {follows ? Vec3(triad.transpose() * axis) : axis, follows}});
    }
    context.publish(options, context.sensors().add(type + " '" + options.name() + "'", measured,
                                                   std::move(places), options.number("Scale")));
  });
}

}  // namespace

void register_sensors(SignalRegistry& registry) {
  const std::string axis = "Axis in the reference, of any length.";
  register_type(registry,
                Schema("Angular Velocity",
                       "Angular velocity of a node about an axis fixed in space, in rad/s."),
                "Axis", axis, Measured::angular_velocity, false);
  register_type(registry,
                Schema("Angular Velocity Local",
                       "Angular velocity of a node about an axis fixed in it, in rad/s."),
                "Axis", axis, Measured::angular_velocity, true);
  register_type(registry, Schema("Velocity", "Velocity of a node along a direction, in m/s."),
                "Direction", "Direction in space, of any length.", Measured::velocity, false);
  register_type(
      registry,
      Schema("Displacement", "Displacement of a node from the reference along a direction, in m."),
      "Direction", "Direction in space, of any length.", Measured::displacement, false);
}

}  // namespace culm::control
