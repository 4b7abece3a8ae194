/// What a temperature adds to elements.
#pragma once

#include <culm/model/amplitude.hpp>
#include <culm/model/booked.hpp>
#include <culm/model/element_batch.hpp>

#include <array>
#include <cstddef>
#include <functional>
#include <span>
#include <utility>
#include <vector>

namespace culm::heat {

/// A temperature at a place of an axis or a middle surface, at amplitude 1.
struct Temperature {
  double value = 0.0;                                  ///< above the stress-free state [K]
  Eigen::Vector2d gradient = Eigen::Vector2d::Zero();  ///< by xi1 and xi2, or by zeta [K/m]
};

/// At a place in the reference [m].
using TemperatureAt = std::function<Temperature(const Vec3& place)>;

/// What an element of type E would like to do at the temperature of its load, at amplitude 1.
template <class E>
struct HeatedElement {
  using Strain = Vec<E::num_strains>;

  int item = 0;  ///< of the batch of elements
  /// At each point, C e_T with the weight of the point: what holds the strains at zero.
  std::array<Strain, E::num_points> stress;
  double energy = 0.0;                ///< stored at strains of zero, 1/2 e_T . C e_T [J]
  Vec<E::num_resultants> resultants;  ///< at strains of zero, mean over the points
  /// At strains of zero, in the order of model::LayerSource; none of a beam.
  std::vector<model::LayerState> layer_states = {};
};

/// Heat on linear elements: stress answers the strain less what the temperature makes of a body
/// that is free,
///   S = C (e - a e_T)    W = 1/2 (e - a e_T) . C (e - a e_T)
/// of which the elements have C e and 1/2 e . C e, and this batch has the rest. The amplitude a in
/// a step is that between the values at both ends, so the conserving step does the work
///   S . De = DW - D,   D = (a C e_T . e_T - C e_T . e) Da     at the means of a and e,
/// of which D is the work that heat does on the structure. Heats of several batches add up, so each
/// has with those before it what is stored between them, a_1 a_2 e_1 . C e_2.
template <class E>
class HeatBatch final : public model::Batch, public model::AddedStresses, public model::Booked {
 public:
  static constexpr int N = E::num_nodes;
  static constexpr int S = E::num_slots;
  static constexpr int M = E::num_strains;

  /// @pre amplitude.is_function_of_time(); `elements` outlives this
  HeatBatch(model::Effect effect, const model::NodeTable& nodes, model::Amplitude amplitude,
            const model::ElementBatch<E>& elements, TemperatureAt temperature)
      : Booked("heat"),
        effect_(std::move(effect)),
        nodes_(nodes),
        amplitude_(std::move(amplitude)),
        elements_(elements),
        temperature_(std::move(temperature)) {}

  const model::ElementBatch<E>& elements() const { return elements_; }
  /// What it was made with, at amplitude 1.
  const TemperatureAt& temperature() const { return temperature_; }
  /// What heats an element of `elements`; null if nothing does.
  const HeatedElement<E>* find(int item) const;

  void add(HeatedElement<E> heated) {
    const auto item = static_cast<std::size_t>(heated.item);
    if (numbers_.size() <= item) numbers_.resize(item + 1, -1);
    numbers_[item] = size();
    heated_.push_back(std::move(heated));
  }

  /// Says what is stored between the heat of another batch and this one in each element of this
  /// one, in the order in which they were added, at amplitudes 1 [J]. `other` outlives this.
  void add_between(const HeatBatch& other, std::vector<double> energies) {
    between_.push_back({&other, std::move(energies)});
  }

  const model::Effect& effect() const override { return effect_; }
  int size() const override { return static_cast<int>(heated_.size()); }
  bool has_tangent() const override { return true; }
  bool depends_on_time() const override { return true; }
  std::vector<int> blocks(int item, const model::UnknownTable& unknowns) const override {
    return elements_.blocks(heated(item).item, unknowns);
  }

  void place(model::Placement placement, model::Form form) override {
    placement_ = std::move(placement);
    form_ = form;
  }
  void prepare(const model::State& state, const Stencil&) override {
    present_ = amplitude_.at(state.time);
  }
  void extrapolate(const model::State&, const Stencil&, const model::Coordinates&) override {}

  Verdict assemble(const model::State& state, const Stencil& stencil, Want want,
                   model::Target& target) override;
  double stored_energy(const model::Coordinates& q) const override;
  model::StepWork step_work(const model::State& state, const Stencil& stencil) const override;
  void add_resultants(int item, std::span<double> resultants) const override;
  void add_layer_states(int item, std::span<model::LayerState> states) const override;

 private:
  static constexpr int K = slots_of(E::node_kind);
  using Strain = Vec<M>;
  using Motion = model::ElementMotion<E>;

  const HeatedElement<E>& heated(int item) const { return heated_[static_cast<std::size_t>(item)]; }
  Slots<S> gather(int item, const model::Coordinates& q) const {
    return model::gather_slots<K>(elements_.nodes(item), q);
  }
  // sum over the points of C e_T . e
  double product(const HeatedElement<E>& heated, const model::Coordinates& q) const;
  template <class Space>
  Verdict assemble_item(std::size_t i, const model::State& state, const Stencil& stencil,
                        double amplitude, bool tangent, model::Target& target) const;

  model::Effect effect_;
  const model::NodeTable& nodes_;
  model::Amplitude amplitude_;
  const model::ElementBatch<E>& elements_;
  TemperatureAt temperature_;
  std::vector<HeatedElement<E>> heated_;
  struct Between {
    const HeatBatch* other;
    std::vector<double> energies;  // by number of the heated element
  };
  std::vector<Between> between_;
  std::vector<int>
      numbers_;  // of heated elements, by item of the batch of elements; -1: not heated
  model::Placement placement_;
  model::Form form_ = model::Form::null_space;
  double present_ = 0.0;  // amplitude at the end of the step
};

template <class E>
Verdict HeatBatch<E>::assemble(const model::State& state, const Stencil& stencil, Want want,
                               model::Target& target) {
  if (want == Want::mass) return Verdict::ok;
  const double a = (1.0 - stencil.theta) * amplitude_.at(state.time_prev) +
                   stencil.theta * amplitude_.at(state.time);
  const bool tangent = want == Want::residual_and_tangent;
  const auto in_space = [&](auto space) {
    Verdict verdict = Verdict::ok;
    for (std::size_t i = 0; i < placement_.items.size(); ++i) {
      verdict =
          worse(verdict, assemble_item<decltype(space)>(i, state, stencil, a, tangent, target));
    }
    return verdict;
  };
  // shell nodes have the same six unknowns in both forms
  if constexpr (E::node_kind == NodeKind::node12) {
    if (form_ == model::Form::multipliers) return in_space(model::FullSpace{});
  }
  return in_space(model::NullSpace{});
}

// r = -a B(q_theta)^T C e_T and its derivative
template <class E>
template <class Space>
Verdict HeatBatch<E>::assemble_item(std::size_t i, const model::State& state,
                                    const Stencil& stencil, double amplitude, bool tangent,
                                    model::Target& target) const {
  const HeatedElement<E>& heated = this->heated(placement_.items[i]);
  const E& element = elements_.element(heated.item);
  const Motion motion(nodes_, elements_.nodes(heated.item), state, stencil.theta, form_);
  model::ElementContribution<Space, E> c(tangent);
  Slots<S> force = Slots<S>::Zero();
  Gradient<S, M> B;
  for (int p = 0; p < E::num_points; ++p) {
    const Strain stress = -amplitude * heated.stress[static_cast<std::size_t>(p)];
    element.gradient(p, motion.mid, B);
    Eigen::Map<Vec<3 * S>>(force.data()).noalias() += B.lazyProduct(stress);
    if (tangent) element.add_curvature(p, stencil.theta * stress, c.scalars);
  }
  if (!std::isfinite(force.sum())) return Verdict::not_finite;
  c.add_slot_force(force, motion);
  if (tangent) c.slot_force = force;
  c.scatter(i, motion, stencil.theta, placement_.scatter, target);
  return Verdict::ok;
}

template <class E>
double HeatBatch<E>::product(const HeatedElement<E>& heated, const model::Coordinates& q) const {
  const Slots<S> slots = gather(heated.item, q);
  double sum = 0.0;
  Strain e;
  for (int p = 0; p < E::num_points; ++p) {
    elements_.element(heated.item).strain(p, slots, e);
    sum += heated.stress[static_cast<std::size_t>(p)].dot(e);
  }
  return sum;
}

template <class E>
double HeatBatch<E>::stored_energy(const model::Coordinates& q) const {
  double energy = 0.0;
  for (std::size_t i = 0; i < placement_.items.size(); ++i) {
    if (!placement_.owned[i]) continue;
    const int number = placement_.items[i];
    const HeatedElement<E>& heated = this->heated(number);
    energy += present_ * (present_ * heated.energy - product(heated, q));
    for (const Between& pair : between_) {
      energy += present_ * pair.other->present_ * pair.energies[static_cast<std::size_t>(number)];
    }
  }
  return energy;
}

template <class E>
model::StepWork HeatBatch<E>::step_work(const model::State& state, const Stencil&) const {
  const double before = amplitude_.at(state.time_prev);
  const double after = amplitude_.at(state.time);
  model::StepWork work;
  for (const Between& pair : between_) {
    const model::Amplitude& other = pair.other->amplitude_;
    const double change = after * other.at(state.time) - before * other.at(state.time_prev);
    if (change == 0.0) continue;
    for (std::size_t i = 0; i < placement_.items.size(); ++i) {
      if (!placement_.owned[i]) continue;
      work.drives += change * pair.energies[static_cast<std::size_t>(placement_.items[i])];
    }
  }
  if (before == after) return work;
  for (std::size_t i = 0; i < placement_.items.size(); ++i) {
    if (!placement_.owned[i]) continue;
    const HeatedElement<E>& heated = this->heated(placement_.items[i]);
    const double mean = 0.5 * (product(heated, state.prev) + product(heated, state.next));
    work.drives += ((before + after) * heated.energy - mean) * (after - before);
  }
  return work;
}

template <class E>
const HeatedElement<E>* HeatBatch<E>::find(int item) const {
  const auto i = static_cast<std::size_t>(item);
  return i < numbers_.size() && numbers_[i] >= 0 ? &heated(numbers_[i]) : nullptr;
}

template <class E>
void HeatBatch<E>::add_resultants(int item, std::span<double> resultants) const {
  const HeatedElement<E>* heated = find(item);
  if (heated == nullptr) return;
  for (std::size_t k = 0; k < resultants.size(); ++k) {
    resultants[k] += present_ * heated->resultants[static_cast<Eigen::Index>(k)];
  }
}

template <class E>
void HeatBatch<E>::add_layer_states(int item, std::span<model::LayerState> states) const {
  const HeatedElement<E>* heated = find(item);
  if (heated == nullptr) return;
  for (std::size_t k = 0; k < heated->layer_states.size(); ++k) {
    states[k].strain += present_ * heated->layer_states[k].strain;
    states[k].stress += present_ * heated->layer_states[k].stress;
  }
}

}  // namespace culm::heat
