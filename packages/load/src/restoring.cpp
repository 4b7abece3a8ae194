#include <culm/joint/triad_nodes.hpp>
#include <culm/load/restoring.hpp>
#include <culm/load/slot_kernel.hpp>

#include "both_frames.hpp"
#include "types.hpp"

#include <Eigen/Eigenvalues>
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <memory>

namespace culm::load {

namespace {

using RestoringMotion = model::ItemMotion<1>;

constexpr double small_turn = 0.1;  // [rad]; sines and angles differ by 0.2 %

}  // namespace

std::vector<int> RestoringLoad::blocks(int item, const model::UnknownTable& unknowns) const {
  return blocks_of(items_[static_cast<std::size_t>(item)].nodes(), unknowns);
}

RestoringLoad::Evaluation RestoringLoad::evaluate(const SmallMotion& motion,
                                                  const model::State& state,
                                                  const Stencil& stencil) const {
  Evaluation result;
  const Vec6 prev = motion.motion(state.prev), next = motion.motion(state.next);
  const double theta = stencil.theta;
  if (stencil.step > 0.0) {
    const double h = stencil.step;
    const Vec6 rate = (next - prev) / h;
    const Vec6 size = rate.cwiseAbs();
    result.damping = -values_.damping * rate - values_.quadratic * size.cwiseProduct(rate);
    result.derivative = -(values_.damping + 2.0 * values_.quadratic * size.asDiagonal()) / h;
  }
  result.force =
      values_.preload - values_.stiffness * ((1.0 - theta) * prev + theta * next) + result.damping;
  result.derivative -= theta * values_.stiffness;
  return result;
}

Verdict RestoringLoad::assemble(const model::State& state, const Stencil& stencil, Want want,
                                model::Target& target) {
  if (want == Want::mass) return Verdict::ok;
  return assemble_items([&](auto space, std::size_t i) {
    return assemble_item<decltype(space)>(i, state, stencil, want, target);
  });
}

template <class Space>
Verdict RestoringLoad::assemble_item(std::size_t i, const model::State& state,
                                     const Stencil& stencil, Want want,
                                     model::Target& target) const {
  const SmallMotion& small = local(i);
  const Evaluation found = evaluate(small, state, stencil);
  const RestoringMotion motion(nodes_, small.nodes(), state, stencil.theta);
  const RestoringMotion::Slots r = -small.slot_forces(found.force);
  const Verdict verdict = add_slot_residual<Space>(placement(), i, r, motion.arms_mid, target);
  if (verdict != Verdict::ok || want == Want::residual) return verdict;
  const Mat<12, 12> K = -small.slot_derivative(found.derivative);
  add_dense_derivative<Space>(
      placement(), i, r, motion, stencil.theta, [&K](int, int) { return K; }, target);
  return Verdict::ok;
}

void RestoringLoad::accept(model::State& state) {
  largest_turn_ = 0.0;
  for (std::size_t i = 0; i < placement().items.size(); ++i) {
    if (!placement().owned[i]) continue;
    largest_turn_ = std::max(largest_turn_, local(i).motion(state.next).tail<3>().norm());
  }
}

double RestoringLoad::stored_energy(const model::Coordinates& q) const {
  double energy = 0.0;
  for (std::size_t i = 0; i < placement().items.size(); ++i) {
    if (!placement().owned[i]) continue;
    const Vec6 x = local(i).motion(q);
    energy += 0.5 * x.dot(values_.stiffness * x) - values_.preload.dot(x);
  }
  return energy;
}

model::StepWork RestoringLoad::step_work(const model::State& state, const Stencil& stencil) const {
  model::StepWork work;
  for (std::size_t i = 0; i < placement().items.size(); ++i) {
    if (!placement().owned[i]) continue;
    const SmallMotion& small = local(i);
    const Evaluation found = evaluate(small, state, stencil);
    const RestoringMotion motion(nodes_, small.nodes(), state, stencil.theta);
    add_item_work(small.slot_forces(found.force), motion, small.nodes(), state, false, work);
    work.damping -= found.damping.dot(small.motion(state.next) - small.motion(state.prev));
  }
  return work;
}

double RestoringLoad::range_used() const { return largest_turn_ / small_turn; }

std::string RestoringLoad::range_warning(double used) const {
  return fmt::format(
      "{}: the node turns by {:.3g} rad, but the forces are those of small motions; they are good "
      "up to {:g} rad",
      effect().quoted(), used * small_turn, small_turn);
}

namespace {

Field matrix(const std::string& name, const std::string& doc) {
  return numbers(name, "",
                 doc + ": 36 values by rows, or the 21 of the upper triangle by rows; SI units.")
      .min_size(21)
      .optional();
}

// None if it is not given.
Mat6 read_matrix(const Options& options, const std::string& name) {
  Mat6 C = Mat6::Zero();
  if (!options.has(name)) return C;
  const auto& values = options.numbers(name);
  std::size_t next = 0;
  for (int i = 0; i < 6; ++i) {
    for (int j = values.size() == 36 ? 0 : i; j < 6; ++j) {
      C(i, j) = values[next++];
      if (values.size() == 21) C(j, i) = C(i, j);
    }
  }
  return C;
}

void check(const Options& options, InputIssues& issues) {
  constexpr std::array matrices = {"Stiffness", "Damping", "Quadratic Damping"};
  if (!options.given("Preload") &&
      std::ranges::none_of(matrices, [&](const char* name) { return options.has(name); })) {
    issues.add(options.where(),
               "resists nothing: give 'Stiffness', 'Damping', 'Quadratic Damping' or 'Preload'");
  }
  for (const char* name : matrices) {
    if (!options.has(name)) continue;
    const std::size_t count = options.numbers(name).size();
    if (count != 36 && count != 21) {
      issues.add(
          options.where(name),
          fmt::format("must have 36 values (rows) or 21 values (upper triangle by rows), got {}",
                      count));
      return;
    }
  }
  const Mat6 C = read_matrix(options, "Stiffness");
  if ((C - C.transpose()).norm() > 1e-9 * C.norm()) {
    issues.add(options.where("Stiffness"), "must be symmetric, or it would make energy");
  }
  const Mat6 B = read_matrix(options, "Damping");
  const Eigen::SelfAdjointEigenSolver<Mat6> taken(B + B.transpose());
  if (taken.eigenvalues().minCoeff() < -1e-9 * B.norm()) {
    issues.add(options.where("Damping"), "must take energy from any motion, but gives some");
  }
}

Schema restoring_schema() {
  Schema fields("Restoring",
                "Forces and moments on a node that are linear in its motion from the reference, as "
                "of a platform, a foundation or a machine on mounts; for small rotations.");
  fields.add(model::node_field())
      .add(numbers("Preload", "", "Force and moment in the reference, in space [N, N m].")
               .size(6)
               .optional({0.0, 0.0, 0.0, 0.0, 0.0, 0.0}))
      .add(matrix("Stiffness",
                  "Against displacements along x, y, z and rotations about them, in space"))
      .add(matrix("Damping", "Against their rates"))
      .add(matrix("Quadratic Damping", "Against each rate times its size"))
      .check(check);
  return fields;
}

void build_restoring(const Options& options, model::BuildContext& context) {
  const auto selected = model::select_loaded_nodes(options, "Node", context);
  if (!joint::have_triads(selected, "Node", options, context)) return;
  RestoringLoad::Values values;
  values.preload = Eigen::Map<const Vec6>(options.numbers("Preload").data());
  const Mat6 C = read_matrix(options, "Stiffness");
  values.stiffness = 0.5 * (C + C.transpose());
  values.damping = read_matrix(options, "Damping");
  values.quadratic = read_matrix(options, "Quadratic Damping");
  auto load = std::make_unique<RestoringLoad>(effect_of("Restoring", options),
                                              context.model.nodes(), values);
  for (int node : selected) load->add(node);
  context.model.add_load(std::move(load));
}

}  // namespace

void register_restoring(model::BuilderRegistry& registry) {
  registry.add("Restoring", restoring_schema(), build_restoring);
}

}  // namespace culm::load
