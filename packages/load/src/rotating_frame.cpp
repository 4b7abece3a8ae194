#include <culm/base/error.hpp>
#include <culm/load/rotating_frame.hpp>
#include <culm/load/slot_kernel.hpp>
#include <culm/model/item_motion.hpp>

#include "both_frames.hpp"
#include "types.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <memory>

namespace culm::load {
namespace {

using FrameMotion = model::ItemMotion<RotatingFrame::max_nodes>;

// Acceleration of the slots of an item in the frame at rest.
FrameMotion::Slots accelerations(const FrameMotion& motion, const std::vector<int>& nodes,
                                 const model::State& state, const Stencil& stencil,
                                 const RotatingFrame::Turning& turning, const Vec3& point) {
  FrameMotion::Slots a = motion.mid;
  for (int s = 0; s < a.cols(); s += 4) a.col(s) -= point;
  const Mat3& turn = turning.turn;
  a = (turning.by_place() * a).eval();
  if (stencil.step > 0.0) {
    for (int s = 0; s < a.cols(); ++s) {
      const auto prev = model::NodeTable::slots(state.prev, nodes[static_cast<std::size_t>(s / 4)]);
      a.col(s) += 2.0 / stencil.step * turn * (motion.next.col(s) - prev.col(s % 4));
    }
  }
  return a;
}

// The nodes of the structures that a deck names; false, with an issue, if one does not exist.
bool select_structures(const Options& options, model::BuildContext& context,
                       std::vector<int>& nodes) {
  bool found = true;
  for (const std::string& name : options.texts("Structures")) {
    const model::Structure* structure = context.model.find_structure(name);
    if (structure == nullptr) {
      std::vector<std::string> names;
      for (const auto& one : context.model.structures()) names.push_back(one.name);
      context.issues.add(
          options.where("Structures"),
          fmt::format("no structure '{}' (there are: {})", name, fmt::join(names, ", ")));
      found = false;
      continue;
    }
    nodes.insert(nodes.end(), structure->nodes.begin(), structure->nodes.end());
    if (structure->body) nodes.push_back(*structure->body);
  }
  return found;
}

// The mass of an item if all nodes turn that have a share of it; others, such as the frame of a
// linear shell, only say where it is.
void add_mass(std::span<const int> nodes, const Eigen::MatrixXd& mass, RotatingFrame& load) {
  std::vector<int> heavy;
  std::vector<Eigen::Index> slots;
  for (std::size_t a = 0; a < nodes.size(); ++a) {
    const auto first = static_cast<Eigen::Index>(4 * a);
    if (mass.middleRows<4>(first).isZero(0.0)) continue;
    if (!load.turns(nodes[a])) return;
    heavy.push_back(nodes[a]);
    for (Eigen::Index s = 0; s < 4; ++s) slots.push_back(first + s);
  }
  if (!heavy.empty()) load.add(heavy, mass(slots, slots));
}

void build_rotating_frame(const Options& options, model::BuildContext& context) {
  const auto function = model::find_function(options, context);
  if (!function) return;
  const Vec3 axis = model::vector(options, "Axis");
  if (axis.norm() == 0.0) {
    context.issues.add(options.where("Axis"), "must not be zero");
    return;
  }
  if (context.model.mass() == 0.0) {
    context.issues.add(options.where(), "acts on nothing: no structure has mass");
    return;
  }
  auto load = std::make_unique<RotatingFrame>(
      effect_of("Rotating Frame", options), context.model.nodes(), *function, axis.normalized(),
      options.number("Speed"), model::vector(options, "Point"));
  if (options.has("Structures")) {
    std::vector<int> nodes;
    if (!select_structures(options, context, nodes)) return;
    load->turn_only(nodes);
  }
  for (const auto& batch : context.model.element_batches()) {
    if (const auto* source = dynamic_cast<const model::MassSource*>(batch.get())) {
      source->visit_masses([&](std::span<const int> nodes, const Eigen::MatrixXd& mass) {
        add_mass(nodes, mass, *load);
      });
    }
  }
  if (load->size() == 0) {
    context.issues.add(options.where("Structures"), "acts on nothing: no such structure has mass");
    return;
  }
  context.model.add_load(std::move(load));
}

}  // namespace

void RotatingFrame::turn_only(const std::vector<int>& nodes) {
  turning_.assign(static_cast<std::size_t>(nodes_.size()), false);
  for (int node : nodes) turning_[static_cast<std::size_t>(node)] = true;
}

double RotatingFrame::speed(const model::State& state, const Stencil& stencil) const {
  return amplitude_.in_step(state, stencil) * speed_;
}

RotatingFrame::Turning RotatingFrame::turning_in(const model::State& state,
                                                 const Stencil& stencil) const {
  double rate = 0.0;
  if (stencil.step > 0.0) {
    Stencil begin = stencil;
    Stencil end = stencil;
    begin.theta = 0.0;
    end.theta = 1.0;
    rate = (speed(state, end) - speed(state, begin)) / stencil.step;
  }
  return {skew(speed(state, stencil) * axis_), skew(rate * axis_)};
}

void RotatingFrame::add(std::span<const int> nodes, const Eigen::MatrixXd& mass) {
  internal_check(nodes.size() <= max_nodes, "a mass couples more nodes than RotatingFrame allows");
  items_.push_back({{nodes.begin(), nodes.end()}, mass});
}

std::vector<int> RotatingFrame::blocks(int item, const model::UnknownTable& unknowns) const {
  return blocks_of(items_[static_cast<std::size_t>(item)].nodes, unknowns);
}

Verdict RotatingFrame::assemble(const model::State& state, const Stencil& stencil, Want want,
                                model::Target& target) {
  if (want == Want::mass) return Verdict::ok;
  const bool tangent = want == Want::residual_and_tangent;
  const Turning turning = turning_in(state, stencil);
  return assemble_items([&](auto space, std::size_t i) {
    return assemble_item<decltype(space)>(i, state, stencil, turning, tangent, target);
  });
}

template <class Space>
Verdict RotatingFrame::assemble_item(std::size_t i, const model::State& state,
                                     const Stencil& stencil, const Turning& turning, bool tangent,
                                     model::Target& target) const {
  const Item& item = items_[static_cast<std::size_t>(placement().items[i])];
  const FrameMotion motion(nodes_, item.nodes, state, stencil.theta);
  const FrameMotion::Slots r =
      accelerations(motion, item.nodes, state, stencil, turning, point_).lazyProduct(item.mass);
  const Verdict verdict = add_slot_residual<Space>(placement(), i, r, motion.arms_mid, target);
  if (!tangent || verdict != Verdict::ok) return verdict;

  Mat3 derivative = stencil.theta * turning.by_place();
  if (stencil.step > 0.0) derivative += 2.0 / stencil.step * turning.turn;
  const auto by_slots = [&](int a, int b) {
    Mat<12, 12> K;
    for (int s = 0; s < 4; ++s) {
      for (int t = 0; t < 4; ++t) {
        K.block<3, 3>(3 * s, 3 * t) = item.mass(4 * a + s, 4 * b + t) * derivative;
      }
    }
    return K;
  };
  add_dense_derivative<Space>(placement(), i, r, motion, stencil.theta, by_slots, target);
  return Verdict::ok;
}

model::StepWork RotatingFrame::step_work(const model::State& state, const Stencil& stencil) const {
  model::StepWork work;
  const Turning turning = turning_in(state, stencil);
  for (std::size_t i = 0; i < placement().items.size(); ++i) {
    if (!placement().owned[i]) continue;
    const Item& item = items_[static_cast<std::size_t>(placement().items[i])];
    const FrameMotion motion(nodes_, item.nodes, state, stencil.theta);
    const FrameMotion::Slots f =
        -accelerations(motion, item.nodes, state, stencil, turning, point_).lazyProduct(item.mass);
    add_item_work(f, motion, item.nodes, state, true, work);
  }
  return work;
}

void register_rotating_frame(model::BuilderRegistry& registry) {
  Schema schema(
      "Rotating Frame",
      "Centrifugal and Coriolis forces on all masses, or on those of some structures, and in "
      "motions that of a speed that changes: they are described in a frame that turns.");
  schema
      .add(model::vector_field("Axis", "1",
                               "Direction of the axis; the frame turns about it by "
                               "the right-hand rule."))
      .add(model::vector_field("Point", "m", "A point of the axis.").optional({0.0, 0.0, 0.0}))
      .add(number("Speed", "rad/s", "Angular velocity at function value 1."))
      .add(texts("Structures",
                 "What turns; everything if absent. With parts that stand still the frame serves "
                 "static analyses and modes of the whole machine ('Rotor' of Modal and Campbell).")
               .optional())
      .add(model::function_field("Ramp"));
  registry.add("Rotating Frame", schema, build_rotating_frame);
}

}  // namespace culm::load
