/// What plastic flow takes from the stresses of linear elements.
#pragma once

#include <culm/model/booked.hpp>
#include <culm/model/element_batch.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <memory>
#include <span>
#include <string>
#include <utility>
#include <vector>

namespace culm::structure {

/// Some elements of a batch yield.
class YieldingElements {
 public:
  virtual ~YieldingElements() = default;
  /// Whether an element of the batch is one of them.
  virtual bool has(int item) const = 0;
};

/// A place in an element E with a law of its own, fed by its part of the element's strains.
template <class E, class Law>
struct MaterialPoint {
  static constexpr int L = Law::num_strains;

  RowMat<L, E::num_strains> map;  ///< strain here = map times strains of the element
  double weight = 0.0;            ///< volume that the place stands for [m^3]
  Law law;
  /// What its stress adds to the resultants of the element, in the mean over the element's points
  Mat<E::num_resultants, L> resultants;
  /// The entry of model::LayerSource in which its stress is shown, with this share; -1: in none.
  int layer_state = -1;
  double share = 0.0;
};

/// An element that may yield.
template <class E, class Law>
struct YieldingElement {
  int item = 0;  ///< of the batch of elements
  std::array<std::vector<MaterialPoint<E, Law>>, E::num_points> places = {};
};

/// Plastic flow in linear elements: with the elastic stress C e of the element and the relief r of
/// each place,
///   S = C e - int map^T r    W = 1/2 e . C e + int (energy of the law beyond the elastic one),
/// of which the elements have what is elastic, and this batch has the rest. Places remember their
/// flow; a step is tried from what was accepted. Every rank knows the flow of all elements, so that
/// each can show stresses.
template <class E, class Law>
class PlasticBatch final : public model::Batch,
                           public model::AddedStresses,
                           public model::Booked,
                           public YieldingElements {
 public:
  static constexpr int N = E::num_nodes;
  static constexpr int S = E::num_slots;
  static constexpr int M = E::num_strains;
  static constexpr int L = Law::num_strains;
  using Yielding = YieldingElement<E, Law>;

  /// @param elements  outlives this
  PlasticBatch(model::Effect effect, const model::NodeTable& nodes,
               const model::ElementBatch<E>& elements)
      : Booked("plastic heat"), effect_(std::move(effect)), nodes_(nodes), elements_(elements) {}

  void add(Yielding yielding) {
    const auto item = static_cast<std::size_t>(yielding.item);
    if (numbers_.size() <= item) numbers_.resize(item + 1, -1);
    numbers_[item] = size();
    begin_.push_back(flows_.size());
    for (const auto& places : yielding.places) flows_.resize(flows_.size() + places.size());
    yielding_.push_back(std::move(yielding));
  }

  bool has(int item) const override {
    const auto at = static_cast<std::size_t>(item);
    return at < numbers_.size() && numbers_[at] >= 0;
  }

  const model::ElementBatch<E>& elements() const { return elements_; }
  const model::Effect& effect() const override { return effect_; }
  int size() const override { return static_cast<int>(yielding_.size()); }
  bool has_tangent() const override { return true; }
  bool needs_all_nodes() const override { return true; }
  std::vector<int> blocks(int item, const model::UnknownTable& unknowns) const override {
    return elements_.blocks(yielding(item).item, unknowns);
  }

  void place(model::Placement placement, model::Form form) override {
    placement_ = std::move(placement);
    form_ = form;
    prev_.assign(placement_.items.size(), {});
    predicted_ = prev_;
    use_predicted_ = false;
  }

  void prepare(const model::State& state, const Stencil& stencil) override {
    use_predicted_ = false;
    theta_ = stencil.theta;
    for (std::size_t i = 0; i < placement_.items.size(); ++i) {
      prev_[i] = strains(placement_.items[i], state.prev);
    }
  }

  void accept(model::State& state) override {
    for (int item = 0; item < size(); ++item) {
      const Strains prev = strains(item, state.prev);
      const Strains next = strains(item, state.next);
      each_place(item, [&](const Place& place, std::size_t p, std::size_t flow) {
        flows_[flow] =
            place.law.step(place.map * prev[p], place.map * next[p], flows_[flow], theta_).next;
      });
    }
  }

  Verdict assemble(const model::State& state, const Stencil& stencil, Want want,
                   model::Target& target) override;
  void extrapolate(const model::State& state, const Stencil& stencil,
                   const model::Coordinates& increment) override;

  bool depends_on_path() const override { return true; }
  std::size_t memory_size() const override { return flow_size * flows_.size(); }
  void save(model::Items which, std::span<double> memory) const override;
  void restore(std::span<const double> memory) override;

  /// Beyond that of the elastic elements.
  double stored_energy(const model::Coordinates& q) const override;
  model::StepWork step_work(const model::State& state, const Stencil& stencil) const override;
  void add_resultants(int item, std::span<double> resultants) const override;
  void add_layer_states(int item, std::span<model::LayerState> states) const override;

  /// Largest equivalent plastic strain of an item of the batch of elements, as accepted; 0 of one
  /// that does not yield.
  double largest_flow(int item) const;

 private:
  static constexpr int K = slots_of(E::node_kind);
  static constexpr std::size_t flow_size = L + 1;
  using Place = MaterialPoint<E, Law>;
  using Strain = Vec<M>;
  using Strains = std::array<Strain, E::num_points>;
  using Motion = model::ElementMotion<E>;

  // What the places of a point of an element take from its stress, and the derivative by its strain
  // at the end of the step.
  struct Answer {
    Strain relief = Strain::Zero();
    RowMat<M, M> slope = RowMat<M, M>::Zero();
  };

  const Yielding& yielding(int item) const { return yielding_[static_cast<std::size_t>(item)]; }
  // -1 if an item of the batch of elements does not yield
  int find(int item) const {
    const auto i = static_cast<std::size_t>(item);
    return i < numbers_.size() ? numbers_[i] : -1;
  }
  Strains strains(int item, const model::Coordinates& q) const {
    const int of_elements = yielding(item).item;
    const Slots<S> slots = model::gather_slots<K>(elements_.nodes(of_elements), q);
    Strains result;
    for (std::size_t p = 0; p < result.size(); ++p) {
      elements_.element(of_elements).strain(static_cast<int>(p), slots, result[p]);
    }
    return result;
  }
  // Calls action(place, point of the element, number of its flow).
  template <class Action>
  void each_place(int item, Action action) const {
    std::size_t flow = begin_[static_cast<std::size_t>(item)];
    for (std::size_t p = 0; p < E::num_points; ++p) {
      for (const Place& place : yielding(item).places[p]) action(place, p, flow++);
    }
  }
  std::array<Answer, E::num_points> respond(std::size_t i, const Strains& next, double theta) const;
  template <class Space>
  Verdict assemble_item(std::size_t i, const model::State& state, const Stencil& stencil,
                        bool tangent, model::Target& target) const;
  template <class Space>
  static void reduce(const Gradient<S, M>& B, const typename Motion::ItemArms& arms,
                     RowMat<Space::width * N, M>& R) {
    for (int a = 0; a < N; ++a) {
      Space::reduce_rows(B.template middleRows<3 * K>(3 * K * a), arms[static_cast<std::size_t>(a)],
                         R.template middleRows<Space::width>(Space::width * a));
    }
  }

  model::Effect effect_;
  const model::NodeTable& nodes_;
  const model::ElementBatch<E>& elements_;
  std::vector<Yielding> yielding_;
  std::vector<int> numbers_;               // of yielding elements, by item of the batch of elements
  std::vector<std::size_t> begin_;         // of the flows of an item
  std::vector<typename Law::Flow> flows_;  // of all places of all items, as accepted
  model::Placement placement_;
  model::Form form_ = model::Form::null_space;
  std::vector<Strains> prev_;       // of local items at the start of the step
  std::vector<Strains> predicted_;  // reliefs of local items for the geometric tangent
  bool use_predicted_ = false;
  double theta_ = 1.0;  // of the step
};

template <class E, class Law>
auto PlasticBatch<E, Law>::respond(std::size_t i, const Strains& next, double theta) const
    -> std::array<Answer, E::num_points> {
  std::array<Answer, E::num_points> answers;
  each_place(placement_.items[i], [&](const Place& place, std::size_t p, std::size_t flow) {
    const auto step =
        place.law.step(place.map * prev_[i][p], place.map * next[p], flows_[flow], theta);
    Answer& answer = answers[p];
    answer.relief.noalias() += place.weight * place.map.transpose() * step.relief;
    if (step.slope.isZero(0.0)) return;
    const RowMat<L, M> slope = place.weight * step.slope * place.map;
    answer.slope.noalias() += place.map.transpose().lazyProduct(slope);
  });
  return answers;
}

template <class E, class Law>
Verdict PlasticBatch<E, Law>::assemble(const model::State& state, const Stencil& stencil, Want want,
                                       model::Target& target) {
  if (want == Want::mass) return Verdict::ok;
  const bool tangent = want == Want::residual_and_tangent;
  const auto in_space = [&](auto space) {
    Verdict verdict = Verdict::ok;
    for (std::size_t i = 0; i < placement_.items.size(); ++i) {
      verdict = worse(verdict, assemble_item<decltype(space)>(i, state, stencil, tangent, target));
    }
    return verdict;
  };
  // shell nodes have the same six unknowns in both forms
  if constexpr (E::node_kind == NodeKind::node12) {
    if (form_ == model::Form::multipliers) return in_space(model::FullSpace{});
  }
  return in_space(model::NullSpace{});
}

// r = -B(q_theta)^T relief and its derivative
template <class E, class Law>
template <class Space>
Verdict PlasticBatch<E, Law>::assemble_item(std::size_t i, const model::State& state,
                                            const Stencil& stencil, bool tangent,
                                            model::Target& target) const {
  constexpr int W = Space::width * N;
  const int item = placement_.items[i];
  const E& element = elements_.element(yielding(item).item);
  const Motion motion(nodes_, elements_.nodes(yielding(item).item), state, stencil.theta, form_);
  const auto answers = respond(i, strains(item, state.next), stencil.theta);
  model::ElementContribution<Space, E> c(tangent);
  Gradient<S, M> B;
  RowMat<W, M> R;
  for (int p = 0; p < E::num_points; ++p) {
    const auto at = static_cast<std::size_t>(p);
    element.gradient(p, motion.mid, B);
    reduce<Space>(B, motion.arms_mid, R);
    c.residual.noalias() -= R.lazyProduct(answers[at].relief);
    if (!tangent) continue;
    const Strain stress = -(use_predicted_ ? predicted_[i][at] : answers[at].relief);
    Eigen::Map<Vec<3 * S>>(c.slot_force.data()).noalias() += B.lazyProduct(stress);
    SlotMatrix<S> curvature = SlotMatrix<S>::Zero();
    element.add_curvature(p, stress, curvature);
    c.scalars += stencil.theta * curvature;
    if (answers[at].slope.isZero(0.0)) continue;
    RowMat<W, M> RD;
    multiply(R, RowMat<M, M>(-answers[at].slope), RD);
    if (stencil.theta != 1.0) {
      element.gradient(p, motion.next, B);
      reduce<Space>(B, motion.arms_next, R);
    }
    const RowMat<M, W> R_next = R.transpose();
    multiply_add(RD, R_next, c.tangent);
  }
  if (!std::isfinite(c.residual.sum())) return Verdict::not_finite;
  c.scatter(i, motion, stencil.theta, placement_.scatter, target);
  return Verdict::ok;
}

template <class E, class Law>
void PlasticBatch<E, Law>::extrapolate(const model::State& state, const Stencil& stencil,
                                       const model::Coordinates& increment) {
  for (std::size_t i = 0; i < placement_.items.size(); ++i) {
    const int of_elements = yielding(placement_.items[i]).item;
    const E& element = elements_.element(of_elements);
    const Slots<S> q = model::gather_slots<K>(elements_.nodes(of_elements), state.next);
    const Slots<S> du = model::gather_slots<K>(elements_.nodes(of_elements), increment);
    const auto answers = respond(i, strains(placement_.items[i], state.next), stencil.theta);
    Strain ahead, behind;
    for (int p = 0; p < E::num_points; ++p) {
      // central differences of a quadratic form are its derivative
      element.strain(p, q + du, ahead);
      element.strain(p, q - du, behind);
      const Answer& answer = answers[static_cast<std::size_t>(p)];
      predicted_[i][static_cast<std::size_t>(p)] =
          answer.relief + 0.5 * answer.slope * (ahead - behind);
    }
  }
  use_predicted_ = true;
}

template <class E, class Law>
void PlasticBatch<E, Law>::save(model::Items which, std::span<double> memory) const {
  const auto write = [&](int item) {
    each_place(item, [&](const Place&, std::size_t, std::size_t flow) {
      double* numbers = memory.data() + flow_size * flow;
      std::copy_n(flows_[flow].strain.data(), L, numbers);
      numbers[L] = flows_[flow].accumulated;
    });
  };
  if (which == model::Items::local) {
    for (int item = 0; item < size(); ++item) write(item);
    return;
  }
  for (std::size_t i = 0; i < placement_.items.size(); ++i) {
    if (placement_.owned[i]) write(placement_.items[i]);
  }
}

template <class E, class Law>
void PlasticBatch<E, Law>::restore(std::span<const double> memory) {
  for (std::size_t flow = 0; flow < flows_.size(); ++flow) {
    const double* numbers = memory.data() + flow_size * flow;
    std::copy_n(numbers, L, flows_[flow].strain.data());
    flows_[flow].accumulated = numbers[L];
  }
}

template <class E, class Law>
double PlasticBatch<E, Law>::stored_energy(const model::Coordinates& q) const {
  double energy = 0.0;
  for (std::size_t i = 0; i < placement_.items.size(); ++i) {
    if (!placement_.owned[i]) continue;
    const Strains y = strains(placement_.items[i], q);
    each_place(placement_.items[i], [&](const Place& place, std::size_t p, std::size_t flow) {
      energy += place.weight * place.law.energy(place.map * y[p], flows_[flow]);
    });
  }
  return energy;
}

template <class E, class Law>
model::StepWork PlasticBatch<E, Law>::step_work(const model::State& state,
                                                const Stencil& stencil) const {
  model::StepWork work;
  for (std::size_t i = 0; i < placement_.items.size(); ++i) {
    if (!placement_.owned[i]) continue;
    const Strains prev = strains(placement_.items[i], state.prev);
    const Strains next = strains(placement_.items[i], state.next);
    each_place(placement_.items[i], [&](const Place& place, std::size_t p, std::size_t flow) {
      work.damping +=
          place.weight *
          place.law.step(place.map * prev[p], place.map * next[p], flows_[flow], stencil.theta)
              .dissipation;
    });
  }
  return work;
}

template <class E, class Law>
void PlasticBatch<E, Law>::add_resultants(int item, std::span<double> resultants) const {
  const int number = find(item);
  if (number < 0) return;
  Eigen::Map<Vec<E::num_resultants>> sum(resultants.data());
  each_place(number, [&](const Place& place, std::size_t, std::size_t flow) {
    sum -= place.resultants * place.law.relief(flows_[flow]);
  });
}

template <class E, class Law>
void PlasticBatch<E, Law>::add_layer_states(
    [[maybe_unused]] int item, [[maybe_unused]] std::span<model::LayerState> states) const {
  if constexpr (L == 3) {
    const int number = find(item);
    if (number < 0) return;
    each_place(number, [&](const Place& place, std::size_t, std::size_t flow) {
      if (place.layer_state < 0) return;
      Vec6& stress = states[static_cast<std::size_t>(place.layer_state)].stress;
      const Vec3 relief = place.share * place.law.relief(flows_[flow]);
      stress[0] -= relief[0];
      stress[1] -= relief[1];
      stress[5] -= relief[2];
    });
  }
}

template <class E, class Law>
double PlasticBatch<E, Law>::largest_flow(int item) const {
  const int number = find(item);
  double largest = 0.0;
  if (number < 0) return largest;
  each_place(number, [&](const Place&, std::size_t, std::size_t flow) {
    largest = std::max(largest, flows_[flow].accumulated);
  });
  return largest;
}

/// The batch of plastic flow in the elements of a structure, made when it is first asked for.
template <class Law, class E>
PlasticBatch<E, Law>& plastic_flow(model::Model& model, const std::string& structure,
                                   model::ElementBatch<E>& elements) {
  const model::Effect effect("Plasticity", structure);
  for (const auto& batch : model.element_batches()) {
    auto* same = dynamic_cast<PlasticBatch<E, Law>*>(batch.get());
    if (same != nullptr && same->effect() == effect && &same->elements() == &elements) return *same;
  }
  auto batch = std::make_unique<PlasticBatch<E, Law>>(effect, model.nodes(), elements);
  PlasticBatch<E, Law>& result = *batch;
  elements.show_with(result);
  model.add_element_batch(std::move(batch));
  return result;
}

/// Whether an element of a batch yields.
template <class E>
bool yields(const model::ElementBatch<E>& elements, int item) {
  return std::any_of(elements.added_stresses().begin(), elements.added_stresses().end(),
                     [item](const model::AddedStresses* more) {
                       const auto* yielding = dynamic_cast<const YieldingElements*>(more);
                       return yielding != nullptr && yielding->has(item);
                     });
}

}  // namespace culm::structure
