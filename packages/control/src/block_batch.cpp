#include <culm/base/error.hpp>
#include <culm/control/block_batch.hpp>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <utility>

namespace culm::control {
namespace {

using Square = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::ColMajor,
                             Block::max_unknowns, Block::max_unknowns>;

Block::Inputs values_of(const std::vector<model::Amplitude>& inputs, const model::State& state,
                        double theta) {
  Stencil at;
  at.theta = theta;
  Block::Inputs u(static_cast<Eigen::Index>(inputs.size()));
  for (Eigen::Index k = 0; k < u.size(); ++k) {
    u[k] = inputs[static_cast<std::size_t>(k)].in_step(state, at);
  }
  return u;
}

}  // namespace

model::Signal BlockBatch::add(const std::string& name, std::unique_ptr<Block> block) {
  Item item;
  const int number = model_.add_own_block({name, block->unknowns()});
  const auto count = static_cast<int>(block->unknowns().size());
  internal_check(count <= Block::max_unknowns, "a block has too many unknowns");
  for (int i = 0; i < count; ++i) item.unknowns.push_back(model_.signal(number, i));
  item.block = std::move(block);
  items_.push_back(std::move(item));
  return items_.back().unknowns.front();
}

void BlockBatch::connect(const model::Signal& output, std::vector<model::Amplitude> inputs,
                         std::optional<double> initial) {
  internal_check(inputs.size() <= Block::max_inputs, "a block has too many inputs");
  const auto item = std::ranges::find_if(
      items_, [&](const Item& one) { return one.unknowns.front().index == output.index; });
  internal_check(item != items_.end(), "inputs of a block that is not there");
  item->inputs = std::move(inputs);
  item->initial = initial;
}

void BlockBatch::settle() {
  std::vector<Block::Unknowns> starts(items_.size());
  for (std::size_t pass = 0; pass < items_.size(); ++pass) {
    const model::State state = model_.initial_state();
    bool is_settled = true;
    for (std::size_t i = 0; i < items_.size(); ++i) {
      Block::Unknowns start = start_of(items_[i], state);
      is_settled = is_settled && pass > 0 && start == starts[i];
      starts[i] = std::move(start);
    }
    if (is_settled) return;
    for (std::size_t i = 0; i < items_.size(); ++i) {
      for (Eigen::Index k = 0; k < starts[i].size(); ++k) {
        model_.set_initial(items_[i].unknowns[static_cast<std::size_t>(k)], starts[i][k]);
      }
    }
  }
}

// The state as it is told or at rest with the inputs. An output that is no state starts as the
// state does, that of a controller without an error: what it measures is not known yet.
Block::Unknowns BlockBatch::start_of(const Item& item, const model::State& state) {
  const double start =
      item.initial ? *item.initial : item.block->start(values_of(item.inputs, state, 1.0));
  Block::Unknowns x = Block::Unknowns::Zero(static_cast<Eigen::Index>(item.unknowns.size()));
  // of inputs that are not known before the first state has been found
  x[0] = x[item.block->state()] = std::isfinite(start) ? start : 0.0;
  return x;
}

std::vector<int> BlockBatch::blocks(int item, const model::UnknownTable& unknowns) const {
  const Item& it = items_[static_cast<std::size_t>(item)];
  std::vector<int> result = {unknowns.own_block(it.unknowns.front().block)};
  for (const model::Amplitude& input : it.inputs) {
    if (input.signal() != nullptr) result.push_back(unknowns.own_block(input.signal()->block));
  }
  return result;
}

void BlockBatch::evaluate(const Item& item, const model::State& state, const Stencil& stencil,
                          Block::Values& values) {
  const double theta = place(stencil);
  const auto count = static_cast<Eigen::Index>(item.unknowns.size());
  Block::Unknowns x(count);
  for (Eigen::Index k = 0; k < count; ++k) {
    x[k] = item.unknowns[static_cast<std::size_t>(k)].in_step(state, theta);
  }
  const Block::Inputs u = values_of(item.inputs, state, theta);
  values.f.setZero(count);
  values.by_unknown.setZero(count, count);
  values.by_input.setZero(count, u.size());
  item.block->evaluate(x, u, values);
}

void BlockBatch::prepare(const model::State&, const Stencil& stencil) {
  trial_step_ = stencil.step;
}

void BlockBatch::accept(model::State&) { step_ = trial_step_; }

double BlockBatch::range_used() const {
  double fastest = 0.0;
  for (const Item& item : items_) fastest = std::max(fastest, item.block->fastest());
  constexpr double rounding = 1e-9;  // of steps
  return 0.5 * (1.0 - rounding) * step_ * fastest;
}

std::string BlockBatch::range_warning(double used) const {
  const auto fastest =
      std::ranges::max_element(items_, {}, [](const Item& item) { return item.block->fastest(); });
  const double longest = 2.0 / fastest->block->fastest();
  const auto number = static_cast<std::size_t>(fastest->unknowns.front().block);
  return fmt::format(
      "{} follows within {:.3g} s, and steps have up to {:.3g} s: where its input jumps it does "
      "not settle but swings about it from step to step; take steps of at most {:.3g} s, or its "
      "input "
      "in its place",
      model_.own_blocks()[number].name, 0.5 * longest, used * longest, longest);
}

Verdict BlockBatch::assemble(const model::State& state, const Stencil& stencil, Want want,
                             model::Target& target) {
  Verdict verdict = Verdict::ok;
  for (std::size_t i = 0; i < placement().items.size(); ++i) {
    if (want == Want::mass) {  // no part in inertia
      const Item& item = items_[static_cast<std::size_t>(placement().items[i])];
      const auto count = static_cast<Eigen::Index>(item.unknowns.size());
      placement().scatter.add_tangent(i, 0, 0, Square(Square::Identity(count, count)), target);
      continue;
    }
    verdict = worse(verdict,
                    assemble_item(i, state, stencil, want == Want::residual_and_tangent, target));
  }
  return verdict;
}

void BlockBatch::refuse(const Item& item, const model::State& state, double theta,
                        const char* what) const {
  const auto number = static_cast<std::size_t>(item.unknowns.front().block);
  const Block::Inputs u = values_of(item.inputs, state, theta);
  constexpr const char* hint =
      "\nWhat is measured of velocities is 0 before the first step: a 'Lag' with 'Initial' starts "
      "elsewhere.";
  throw NonFiniteError(fmt::format(
      "{} has {} at time {:.6g}, where its signals are {:.6g}.{}", model_.own_blocks()[number].name,
      what, state.time, fmt::join(u.data(), u.data() + u.size(), ", "), u.all() ? "" : hint));
}

// Rows over the scales of their unknowns; what an equation with a rate is out of balance by makes
// an error of h times as much in its unknown.
Verdict BlockBatch::assemble_item(std::size_t i, const model::State& state, const Stencil& stencil,
                                  bool tangent, model::Target& target) const {
  const Item& item = items_[static_cast<std::size_t>(placement().items[i])];
  const auto count = static_cast<Eigen::Index>(item.unknowns.size());
  const double theta = place(stencil);
  const double h = stencil.step;
  Block::Values values;
  evaluate(item, state, stencil, values);
  if (!std::isfinite(values.f.sum())) refuse(item, state, theta, "no finite value");
  if (tangent && !std::isfinite(values.by_unknown.sum() + values.by_input.sum())) {
    refuse(item, state, theta, "an infinite slope");
  }
  Block::Unknowns residual(count);
  Square K = Square::Zero(count, count);
  for (Eigen::Index k = 0; k < count; ++k) {
    const model::Signal& x = item.unknowns[static_cast<std::size_t>(k)];
    const double next = x.in_step(state, 1.0);
    double error = 0.0;
    if (x.kind != model::UnknownKind::first_order) {
      residual[k] = next - values.f[k];
      K(k, k) = x.scale;
      error = residual[k];
    } else if (h > 0.0) {
      residual[k] = (next - x.in_step(state, 0.0)) / h - values.f[k];
      K(k, k) = x.scale / h;
      error = h * residual[k];
    } else if (stencil.frees_states) {
      residual[k] = -values.f[k];
    } else {
      residual[k] = next - x.in_step(state, 0.0);
      K(k, k) = x.scale;
      values.by_unknown.row(k).setZero();
      values.by_input.row(k).setZero();
      error = residual[k];
    }
    const double size = std::max(x.scale, std::abs(next));
    target.constraint_violation = std::max(target.constraint_violation, std::abs(error) / size);
    for (Eigen::Index j = 0; j < count; ++j) {
      K(k, j) -= values.by_unknown(k, j) * item.unknowns[static_cast<std::size_t>(j)].weight(theta);
    }
    residual[k] /= x.scale;
    K.row(k) /= x.scale;
    values.by_input.row(k) /= x.scale;
  }
  placement().scatter.add_residual(i, 0, residual.data(), target);
  if (!tangent) return Verdict::ok;
  placement().scatter.add_tangent(i, 0, 0, K, target);
  add_inputs(i, values, theta, target);
  return Verdict::ok;
}

void BlockBatch::add_inputs(std::size_t i, const Block::Values& values, double theta,
                            model::Target& target) const {
  const Item& item = items_[static_cast<std::size_t>(placement().items[i])];
  int block = 0;
  for (std::size_t k = 0; k < item.inputs.size(); ++k) {
    const model::Signal* signal = item.inputs[k].signal();
    if (signal == nullptr) continue;
    Eigen::Matrix<double, Eigen::Dynamic, 12, Eigen::ColMajor, Block::max_unknowns, 12> columns;
    columns.setZero(values.f.size(), 12);
    columns.col(signal->place) =
        -signal->weight(theta) * values.by_input.col(static_cast<Eigen::Index>(k));
    placement().scatter.add_tangent(i, 0, ++block, columns, target);
  }
}

}  // namespace culm::control
