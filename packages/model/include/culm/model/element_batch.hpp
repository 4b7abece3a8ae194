/// All elements of one type: the mechanics every element shares, written once.
#pragma once

#include <culm/model/batch.hpp>
#include <culm/model/element_contribution.hpp>
#include <culm/model/element_forces.hpp>
#include <culm/model/element_motion.hpp>
#include <culm/model/element_packs.hpp>
#include <culm/model/element_store.hpp>
#include <culm/model/inertia.hpp>
#include <culm/model/layer_source.hpp>
#include <culm/model/model.hpp>
#include <culm/model/point_laws.hpp>
#include <culm/model/projection.hpp>
#include <culm/model/turn_source.hpp>

#include <algorithm>
#include <cmath>
#include <memory>
#include <optional>
#include <type_traits>
#include <utility>

namespace culm::model {

/// Adds to the stresses that the strains of elements make, as heat does.
class AddedStresses {
 public:
  virtual ~AddedStresses() = default;
  /// @param item  of the batch of elements @param resultants  in the order of its names
  virtual void add_resultants(int item, std::span<double> resultants) const = 0;
  /// @param states  of the layers of a wall, in the order of LayerSource
  virtual void add_layer_states(int item, std::span<LayerState> states) const = 0;
};

/// Elements as plain values. Forces, tangents, stress extrapolation, energy and inertia follow from
/// the quadratic forms that the element states. @source formulation 0.3, 5.2, 6.7
template <BatchElement E>
class ElementBatch final : public Batch,
                           public MassSource,
                           public ResultantSource,
                           public TurnSource {
 public:
  static constexpr int N = E::num_nodes;
  static constexpr int S = E::num_slots;
  static constexpr int M = E::num_strains;
  using ItemSlots = Slots<S>;
  using Strain = Vec<M>;

  ElementBatch(Effect effect, const NodeTable& nodes, const StrainDamping& damping = {})
      : effect_(std::move(effect)), nodes_(nodes), laws_(damping) {}

  /// Adds elements that follow each other. @return item number of the first
  int add(ElementSeries<E> series) { return items_.add(std::move(series)); }
  /// Adds one element that is there. @return item number
  int add(E element, const std::array<int, N>& nodes) {
    return add({{nodes}, [one = std::move(element)](const auto&, int) { return one; }});
  }

  /// What was made where it is evaluated, or else what is made when it is asked for.
  const E& element(int item) const { return items_[item]; }
  /// Made for the one who asks: before anybody knows where it is evaluated.
  E make_element(int item) const { return items_.make(item); }
  const std::array<int, N>& nodes(int item) const { return items_.nodes(item); }

  /// Notes how much an element grows per kelvin, for those who heat it: by point [1/K].
  void set_expansion(int item, const Vec<E::num_points>& expansion) {
    expansions_.resize(static_cast<std::size_t>(size()), Vec<E::num_points>::Zero());
    expansions_[static_cast<std::size_t>(item)] = expansion;
  }
  /// Zero where nobody said.
  Vec<E::num_points> expansion(int item) const {
    const auto i = static_cast<std::size_t>(item);
    return i < expansions_.size() ? expansions_[i] : Vec<E::num_points>(Vec<E::num_points>::Zero());
  }
  /// Stresses are from now on shown with what `more` adds, which must live as long as they are
  /// asked for.
  void show_with(const AddedStresses& more) { added_.push_back(&more); }
  const std::vector<const AddedStresses*>& added_stresses() const { return added_; }

  const StrainDamping& damping() const { return laws_.damping(); }
  const Effect& effect() const override { return effect_; }
  int size() const override { return items_.size(); }
  bool has_tangent() const override { return true; }
  std::vector<int> blocks(int item, const UnknownTable& unknowns) const override {
    std::vector<int> result;
    for (int node : nodes(item)) result.push_back(unknowns.node_block(node));
    return result;
  }

  void place(Placement placement, Form form) override {
    placement_ = std::move(placement);
    form_ = form;
    items_.place(placement_.items);
    const std::size_t points = placement_.items.size() * E::num_points;
    laws_.resize(points);
    predicted_stress_.clear();
    use_predicted_ = false;
    if constexpr (ComesInPacks<E>) {
      packs_.make(
          form == Form::null_space ? placement_.items.size() : 0,
          [&](std::size_t i) -> const auto& { return local(i); });
    }
  }
  void forget_others() override { items_.forget_others(); }
  bool owns(int item) const override {
    const auto found = std::ranges::lower_bound(placement_.items, item);
    return found != placement_.items.end() && *found == item &&
           placement_.owned[static_cast<std::size_t>(found - placement_.items.begin())];
  }

  void prepare(const State& state, const Stencil& stencil) override {
    use_predicted_ = false;
    taken_.reset();
    if constexpr (ComesInPacks<E>) packs_.forget_extrapolation();
    const bool wants_strains = laws_.prepare(stencil);
    const Stencil damped = laws_.damped(stencil);
    const bool in_packs = comes_in_packs(damped);
    if (stencil.inertia != 0.0 && masses_.empty() && !in_packs) {
      masses_.reserve(placement_.items.size());
      for (std::size_t i = 0; i < placement_.items.size(); ++i) {
        masses_.push_back(local(i).element.mass());
      }
    }
    // packs find the strains of the start themselves
    if (!wants_strains || in_packs) return;
    for (std::size_t i = 0; i < placement_.items.size(); ++i) {
      const ItemSlots q = gather(i, state.prev);
      const E& element = local(i).element;
      for (int p = 0; p < E::num_points; ++p) {
        element.strain(p, q, laws_.prev(at(i, p)));
      }
    }
  }

  std::vector<double> relaxation_times() const override { return laws_.branches().times(); }

  Verdict assemble_branches(const State& state, double time, Target& target) override {
    const std::vector<double>& times = laws_.branches().times();
    Verdict verdict = Verdict::ok;
    for (std::size_t k = 0; k < times.size(); ++k) {
      if (times[k] != time) continue;
      for (std::size_t i = 0; i < placement_.items.size(); ++i) {
        verdict = worse(verdict, in_space([&](auto space) {
                          return assemble_branch<decltype(space)>(i, k, state, target);
                        }));
      }
    }
    return verdict;
  }

  void accept(State& state) override {
    taken_.reset();
    laws_.accept();
    if (laws_.branches().empty()) return;
    Strain y;
    for (std::size_t i = 0; i < placement_.items.size(); ++i) {
      const ItemSlots q = gather(i, state.next);
      for (int p = 0; p < E::num_points; ++p) {
        local(i).element.strain(p, q, y);
        laws_.accept(at(i, p), y);
      }
    }
  }

  std::size_t memory_size() const override {
    return static_cast<std::size_t>(size()) * item_memory();
  }

  void save(Items which, std::span<double> memory) const override {
    if (!laws_.remembers()) return;
    for (std::size_t i = 0; i < placement_.items.size(); ++i) {
      if (which == Items::owned && !placement_.owned[i]) continue;
      for (int p = 0; p < E::num_points; ++p) {
        laws_.save(at(i, p), memory.subspan(memory_place(i, p)));
      }
    }
  }

  void restore(std::span<const double> memory) override {
    if (!laws_.remembers()) return;
    for (std::size_t i = 0; i < placement_.items.size(); ++i) {
      for (int p = 0; p < E::num_points; ++p) {
        laws_.restore(at(i, p), memory.subspan(memory_place(i, p)));
      }
    }
  }

  Verdict assemble(const State& state, const Stencil& stencil, Want want, Target& target) override {
    const Stencil damped = laws_.damped(stencil);
    taken_.reset();
    if constexpr (ComesInPacks<E>) {
      if (want != Want::mass && comes_in_packs(damped))
        return assemble_packs(state, damped, want, target);
    }
    return in_space(
        [&](auto space) { return assemble_as<decltype(space)>(state, damped, want, target); });
  }

  void extrapolate(const State& state, const Stencil& stencil,
                   const Coordinates& increment) override {
    const Stencil damped = laws_.damped(stencil);
    if constexpr (ComesInPacks<E>) {
      if (comes_in_packs(damped)) {
        packs_.extrapolate(state, damped, increment);
        return;
      }
    }
    predicted_stress_.resize(placement_.items.size() * E::num_points);
    Response<M> response;
    Strain y, ahead, behind;
    for (std::size_t i = 0; i < placement_.items.size(); ++i) {
      const ItemSlots q = gather(i, state.next);
      const ItemSlots du = gather(i, increment);
      const E& element = local(i).element;
      for (int p = 0; p < E::num_points; ++p) {
        element.strain(p, q, y);
        // central differences of a quadratic form are its derivative, B^T du
        element.strain(p, q + du, ahead);
        element.strain(p, q - du, behind);
        const Strain dy = 0.5 * (ahead - behind);
        laws_.respond(element, p, at(i, p), y, damped, response, &dy);
        predicted_stress_[at(i, p)] = response.stress;
      }
    }
    use_predicted_ = true;
  }

  double stored_energy(const Coordinates& q) const override {
    double energy = 0.0;
    if constexpr (ComesInPacks<E>) {
      if (!packs_.empty() && laws_.branches().empty()) return energy_of_packs(q, nullptr);
    }
    Strain y;
    for (std::size_t i = 0; i < placement_.items.size(); ++i) {
      if (!placement_.owned[i]) continue;
      const ItemSlots slots = gather(i, q);
      const E& element = local(i).element;
      for (int p = 0; p < E::num_points; ++p) {
        element.strain(p, slots, y);
        energy += laws_.energy(element, p, at(i, p), y);
      }
    }
    return energy;
  }

  void add_mass_times(const Coordinates& acceleration, Coordinates& force) const override {
    items_.for_masses([&](const auto& nodes, const SlotMatrix<S>& mass) {
      const ItemSlots f = gather_slots<K>(nodes, acceleration) * mass;  // is symmetric
      for (int a = 0; a < N; ++a) {
        NodeTable::slots(force, nodes[static_cast<std::size_t>(a)]).template leftCols<K>() +=
            f.template middleCols<K>(K * a);
      }
    });
  }

  void visit_masses(const MassVisitor& visit) const override {
    Eigen::MatrixXd mass = Eigen::MatrixXd::Zero(4 * N, 4 * N);
    items_.for_masses([&](const auto& nodes, const SlotMatrix<S>& scalars) {
      for (int a = 0; a < N; ++a) {
        for (int b = 0; b < N; ++b) {
          mass.block<K, K>(4 * a, 4 * b) = scalars.template block<K, K>(K * a, K * b);
        }
      }
      visit(nodes, mass);
    });
  }

  double kinetic_energy(const Coordinates& velocity) const override {
    double sum = 0.0;
    const auto add = [&](std::size_t i, double energy) {
      if (placement_.owned[i]) sum += energy;
    };
    if constexpr (ComesInPacks<E>) {
      if (!packs_.empty()) {
        packs_.for_kinetic_energies(velocity, add);
        return sum;
      }
    }
    for (std::size_t i = 0; i < placement_.items.size(); ++i) {
      if (placement_.owned[i]) add(i, model::kinetic_energy<S>(mass_of(i), gather(i, velocity)));
    }
    return sum;
  }

  void add_momentum(const Coordinates& q, const Coordinates& velocity,
                    Momentum& momentum) const override {
    if constexpr (ComesInPacks<E>) {
      if (!packs_.empty()) {
        packs_.for_momenta(q, velocity, [&](std::size_t i, const Momentum& one) {
          if (placement_.owned[i]) momentum += one;
        });
        return;
      }
    }
    for (std::size_t i = 0; i < placement_.items.size(); ++i) {
      if (!placement_.owned[i]) continue;
      add_item_momentum<K, S>(mass_of(i), gather(i, q), gather(i, velocity), momentum);
    }
  }

  StepWork step_work(const State& state, const Stencil& stencil) const override {
    const Stencil damped = laws_.damped(stencil);
    if (!laws_.takes(damped)) return {};
    const Taken taken = taken_in_step(state, damped);
    StepWork work;
    const double physical = damping().viscosity / stencil.step;
    const double share = physical > 0.0 ? physical / damping().weight(stencil.step) : 0.0;
    work.damping = share * taken.by_law + taken.by_strains;
    work.dissipation = (1.0 - share) * taken.by_law;
    return work;
  }

  std::vector<std::string> resultant_names() const override {
    const auto names = E::resultant_names();
    return {names.begin(), names.end()};
  }

  void resultants(int item, const Coordinates& q, std::vector<double>& out) const override {
    const E& element = items_[item];
    const ItemSlots slots = gather_slots<K>(nodes(item), q);
    Vec<E::num_resultants> mean = Vec<E::num_resultants>::Zero();
    Strain y;
    for (int p = 0; p < E::num_points; ++p) {
      element.strain(p, slots, y);
      if constexpr (ElementWithInternals<E>) {
        // of any configuration: internals as at rest there
        Vec<E::num_internals> internals = Vec<E::num_internals>::Zero();
        Response<M> response;
        element.respond(p, y, y, internals, Stencil::statics(), internals, response);
        mean += element.resultants(p, y, internals) / E::num_points;
      } else {
        mean += element.resultants(p, y) / E::num_points;
      }
    }
    for (const AddedStresses* more : added_)
      more->add_resultants(item, {mean.data(), E::num_resultants});
    out.insert(out.end(), mean.data(), mean.data() + mean.size());
  }

  std::optional<TurnKind> turn_kind() const override {
    if constexpr (HasTurn<E>) return E::turn_kind;
    return {};
  }

  double largest_turn([[maybe_unused]] const Coordinates& q) const override {
    double least = 1.0;
    if constexpr (HasTurn<E>) {
      for (std::size_t i = 0; i < placement_.items.size(); ++i) {
        if (placement_.owned[i]) least = std::min(least, least_cosine(i, q));
      }
    }
    return turn_from(least);
  }

  int first_turned([[maybe_unused]] const Coordinates& q,
                   [[maybe_unused]] double turn) const override {
    if constexpr (HasTurn<E>) {
      for (std::size_t i = 0; i < placement_.items.size(); ++i) {
        if (!placement_.owned[i]) continue;
        if (turn_from(least_cosine(i, q)) >= turn) return placement_.items[i];
      }
    }
    return -1;
  }

  double turn_of([[maybe_unused]] int item, [[maybe_unused]] const Coordinates& q) const override {
    double least = 1.0;
    if constexpr (HasTurn<E>) {
      least = least_cosine(items_[item], nodes(item), q);
    }
    return turn_from(least);
  }

 private:
  static constexpr int K = slots_of(E::node_kind);  // slots per node
  using Motion = ElementMotion<E>;
  using Taken = typename PointLaws<E>::Taken;
  template <class Space>
  using Contribution = ElementContribution<Space, E>;

  // numbers that an item remembers, and where those of a point of a local item are in the array of
  // all items
  std::size_t item_memory() const {
    return static_cast<std::size_t>(E::num_points) * laws_.point_memory();
  }
  std::size_t memory_place(std::size_t i, int p) const {
    return static_cast<std::size_t>(placement_.items[i]) * item_memory() +
           static_cast<std::size_t>(p) * laws_.point_memory();
  }

  static std::size_t at(std::size_t item, int point) {
    return item * E::num_points + static_cast<std::size_t>(point);
  }

  // The i-th of those that this rank evaluates.
  const typename ElementStore<E>::Item& local(std::size_t i) const { return items_.local(i); }
  SlotMatrix<S> mass_of(std::size_t i) const {
    return masses_.empty() ? SlotMatrix<S>(local(i).element.mass()) : masses_[i];
  }
  ItemSlots gather(std::size_t i, const Coordinates& q) const {
    return gather_slots<K>(local(i).nodes, q);
  }
  double least_cosine(std::size_t i, const Coordinates& q) const requires HasTurn<E> {
    return least_cosine(local(i).element, nodes(placement_.items[i]), q);
  }
  static double least_cosine(const E& element, const std::array<int, N>& nodes,
                             const Coordinates& q) requires HasTurn<E> {
    return element.least_cosine(
        [&](int a) { return NodeTable::slots(q, nodes[static_cast<std::size_t>(a)]); });
  }
  static double turn_from(double cosine) {
    if constexpr (HasTurn<E>) return E::turn_kind.order * std::acos(std::clamp(cosine, -1.0, 1.0));
    return 0.0;
  }
  Motion motion_of(std::size_t i, const State& state, double theta) const {
    return Motion(nodes_, local(i).nodes, state, theta, form_);
  }

  // Motion as long as it is used.
  template <class Space>
  ElementForces<Space, E> forces_of(std::size_t i, const Motion& motion) {
    return {nodes_, local(i), motion, laws_, at(i, 0)};
  }

  // Calls action(space) with the space of the form; shell nodes have the same six unknowns in both.
  template <class Action>
  Verdict in_space(Action action) const {
    if constexpr (E::node_kind == NodeKind::node12) {
      if (form_ == Form::multipliers) return action(FullSpace{});
    }
    return action(NullSpace{});
  }

  // Whether items are evaluated in packs, which know their masses. @param stencil  damped
  bool comes_in_packs(const Stencil& stencil) const {
    return ComesInPacks<E> && form_ == Form::null_space && laws_.is_plain(stencil);
  }

  // What the strains of q store, less those at `less`, in the elements of this rank.
  double energy_of_packs(const Coordinates& q,
                         const Coordinates* less) const requires ComesInPacks<E> {
    double sum = 0.0;
    packs_.for_energies(q, less, [&](std::size_t i, double energy) {
      if (placement_.owned[i]) sum += energy;
    });
    return sum;
  }

  // @param stencil  damped
  Taken taken_in_step(const State& state, const Stencil& stencil) const {
    if (taken_) return *taken_;
    Taken taken;
    if constexpr (ComesInPacks<E>) {
      if (comes_in_packs(stencil)) {
        taken.by_law =
            PointLaws<E>::share_taken(stencil) * energy_of_packs(state.next, &state.prev);
        return taken;
      }
    }
    Strain y;
    for (std::size_t i = 0; i < placement_.items.size(); ++i) {
      if (!placement_.owned[i]) continue;
      const E& element = local(i).element;
      const ItemSlots q = gather(i, state.next);
      for (int p = 0; p < E::num_points; ++p) {
        element.strain(p, q, y);
        laws_.add_taken(element, p, at(i, p), y, stencil, nullptr, taken);
      }
    }
    return taken;
  }

  template <class Space>
  Verdict assemble_as(const State& state, const Stencil& stencil, Want want, Target& target) {
    const bool tells = want == Want::residual && stencil.step > 0.0 && laws_.takes(stencil);
    Taken taken;
    Verdict verdict = Verdict::ok;
    for (std::size_t i = 0; i < placement_.items.size(); ++i) {
      Taken* const told = tells && placement_.owned[i] ? &taken : nullptr;
      verdict = worse(verdict, want == Want::mass
                                   ? assemble_mass<Space>(i, state, target)
                                   : assemble_item<Space>(i, state, stencil, want, told, target));
    }
    if (tells && verdict == Verdict::ok) taken_ = taken;
    return verdict;
  }

  Verdict assemble_packs(const State& state, const Stencil& stencil, Want want,
                         Target& target) requires ComesInPacks<E> {
    const bool with_tangent = want == Want::residual_and_tangent;
    const bool tells = tells_change(stencil, with_tangent);
    double change_energy = 0.0;
    const auto add = [&](std::size_t i, int lane, const auto& c) {
      add_to_target<N>(i, c.residual, with_tangent ? &c.tangent : nullptr, placement_.scatter,
                       target);
      if (tells && placement_.owned[i]) change_energy += packs_.change_energy(lane);
    };
    const Verdict verdict = packs_.evaluate(nodes_, state, stencil, with_tangent, add);
    if (tells && verdict == Verdict::ok) {
      taken_ = Taken{PointLaws<E>::share_taken(stencil) * change_energy, 0.0};
    }
    return verdict;
  }

  template <class Space>
  Verdict assemble_item(std::size_t i, const State& state, const Stencil& stencil, Want want,
                        Taken* taken, Target& target) {
    const Motion motion = motion_of(i, state, stencil.theta);
    const auto forces = forces_of<Space>(i, motion);
    Contribution<Space> c(want == Want::residual_and_tangent);
    const Strain* const predicted = use_predicted_ ? &predicted_stress_[at(i, 0)] : nullptr;
    const Verdict verdict = forces.add_stress(stencil, predicted, taken, c);
    if (stencil.inertia != 0.0) forces.add_inertia(masses_[i], state, stencil, c);
    if (!std::isfinite(c.residual.sum())) return Verdict::not_finite;
    c.scatter(i, motion, stencil.theta, placement_.scatter, target);
    return verdict;
  }

  // the tangent of one branch at the end of the step
  template <class Space>
  Verdict assemble_branch(std::size_t i, std::size_t branch, const State& state, Target& target) {
    const Motion motion = motion_of(i, state, 1.0);
    Contribution<Space> c(true);
    forces_of<Space>(i, motion).add_branch(branch, c);
    if (!std::isfinite(c.tangent.sum())) return Verdict::not_finite;
    c.scatter(i, motion, 1.0, placement_.scatter, target);
    return Verdict::ok;
  }

  // P^T M P at the end of the step
  template <class Space>
  Verdict assemble_mass(std::size_t i, const State& state, Target& target) {
    const Motion motion = motion_of(i, state, 1.0);
    Contribution<Space> c(true);
    c.scalars = local(i).element.mass();
    c.scatter(i, motion, 1.0, placement_.scatter, target);
    return Verdict::ok;
  }

  Effect effect_;
  const NodeTable& nodes_;
  PointLaws<E> laws_;
  ElementStore<E> items_;
  std::vector<Vec<E::num_points>> expansions_;  // by item; empty where nothing expands
  std::vector<const AddedStresses*> added_;
  Placement placement_;
  Form form_ = Form::null_space;
  std::vector<SlotMatrix<S>> masses_;  // of the local items; filled when inertia wants them
  std::vector<Strain> predicted_stress_;
  bool use_predicted_ = false;
  std::optional<Taken> taken_;  // by the owned items in the step, if the last evaluation told
  struct NoPacks {};
  [[no_unique_address]] std::conditional_t<ComesInPacks<E>, ElementPacks<E>, NoPacks> packs_;
};

/// The batch of elements E of a model with this ledger name and damping, made when it is first
/// asked for.
template <BatchElement E>
ElementBatch<E>& elements(Model& model, const Effect& effect, const StrainDamping& damping = {}) {
  for (const auto& batch : model.element_batches()) {
    auto* same = dynamic_cast<ElementBatch<E>*>(batch.get());
    if (same != nullptr && same->effect() == effect && same->damping() == damping) return *same;
  }
  auto batch = std::make_unique<ElementBatch<E>>(effect, model.nodes(), damping);
  ElementBatch<E>& result = *batch;
  model.add_element_batch(std::move(batch));
  return result;
}

}  // namespace culm::model
