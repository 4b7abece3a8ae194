/// All elements of one type: the mechanics every element shares, written once.
#pragma once

#include <culm/mechanics/element.hpp>
#include <culm/model/batch.hpp>
#include <culm/model/inertia.hpp>
#include <culm/model/projection.hpp>

#include <cmath>
#include <memory>
#include <utility>

namespace culm::model {

/// What takes energy out of strains, in dynamics only.
struct StrainDamping {
  /// Numerical dissipation chi in [0, 1]: takes 1/2 chi De . C De per step and leaves the momenta;
  /// first order in the step. @source formulation 4.5
  double dissipation = 0.0;
  double viscosity = 0.0;  ///< physical damping eta [s]: stress C eta de/dt on top of C e

  bool operator==(const StrainDamping&) const = default;
  /// Weight that the new strain gains over the old one in a step of length h.
  double weight(double h) const { return 0.5 * dissipation + viscosity / h; }
};

/// Elements as plain values. Forces, tangents, stress extrapolation, energy and inertia follow from
/// the quadratic forms that the element states. @source formulation 0.3, 5.2, 6.7
template <Element E>
class ElementBatch final : public Batch, public MassSource, public ResultantSource {
 public:
  static constexpr int N = E::num_nodes;
  static constexpr int S = E::num_slots;
  static constexpr int M = E::num_strains;
  static_assert(E::node_kind == NodeKind::node12, "projection is written for triad nodes");
  using ItemSlots = Slots<S>;
  using Strain = Vec<M>;

  ElementBatch(std::string effect, const NodeTable& nodes, const StrainDamping& damping = {})
      : effect_(std::move(effect)), nodes_(nodes), damping_(damping) {}

  /// Adds an element. @return item number
  int add(E element, const std::array<int, N>& nodes) {
    elements_.push_back(std::move(element));
    connectivity_.push_back(nodes);
    return size() - 1;
  }

  const E& element(int item) const { return elements_[static_cast<std::size_t>(item)]; }
  const std::array<int, N>& nodes(int item) const {
    return connectivity_[static_cast<std::size_t>(item)];
  }

  const StrainDamping& damping() const { return damping_; }
  const std::string& effect() const override { return effect_; }
  int size() const override { return static_cast<int>(elements_.size()); }
  bool has_tangent() const override { return true; }
  std::vector<int> blocks(int item, const UnknownTable& unknowns) const override {
    std::vector<int> result;
    for (int node : nodes(item)) result.push_back(unknowns.node_block(node));
    return result;
  }

  void place(Placement placement, Form form) override {
    placement_ = std::move(placement);
    form_ = form;
    strain_prev_.assign(placement_.items.size() * E::num_points, Strain::Zero());
    predicted_stress_.resize(strain_prev_.size());
    use_predicted_ = false;
  }

  void begin_step(const State& state, const Stencil& stencil) override {
    use_predicted_ = false;
    if (stencil.inertia != 0.0 && masses_.empty()) {
      for (int item : placement_.items) masses_.push_back(element(item).mass());
    }
    if (stencil.step == 0.0) return;  // the old strain has no weight in statics
    for (std::size_t i = 0; i < placement_.items.size(); ++i) {
      const ItemSlots q = gather(placement_.items[i], state.prev);
      const E& element = this->element(placement_.items[i]);
      for (int p = 0; p < E::num_points; ++p) element.strain(p, q, strain_prev_[at(i, p)]);
    }
  }

  Verdict assemble(const State& state, const Stencil& stencil, Want want, Target& target) override {
    const Stencil damped = with_damping(stencil);
    if (form_ == Form::null_space) return assemble_as<NullSpace>(state, damped, want, target);
    return assemble_as<FullSpace>(state, damped, want, target);
  }

  void extrapolate(const State& state, const Stencil& stencil,
                   const Coordinates& increment) override {
    const Stencil damped = with_damping(stencil);
    Response<M> response;
    Gradient<S, M> B;
    Strain y;
    for (std::size_t i = 0; i < placement_.items.size(); ++i) {
      const ItemSlots q = gather(placement_.items[i], state.next);
      const ItemSlots du = gather(placement_.items[i], increment);
      const E& element = this->element(placement_.items[i]);
      for (int p = 0; p < E::num_points; ++p) {
        element.strain(p, q, y);
        element.gradient(p, q, B);
        element.respond(p, strain_prev_[at(i, p)], y, damped, response);
        const Strain dy = B.transpose() * du.template reshaped<Eigen::AutoOrder>();
        predicted_stress_[at(i, p)] = response.stress + response.tangent * dy;
      }
    }
    use_predicted_ = true;
  }

  double stored_energy(const Coordinates& q) const override {
    double energy = 0.0;
    Strain y;
    for (std::size_t i = 0; i < placement_.items.size(); ++i) {
      if (!placement_.owned[i]) continue;
      const ItemSlots slots = gather(placement_.items[i], q);
      const E& element = this->element(placement_.items[i]);
      for (int p = 0; p < E::num_points; ++p) {
        element.strain(p, slots, y);
        energy += element.energy(p, y);
      }
    }
    return energy;
  }

  void add_mass_times(const Coordinates& acceleration, Coordinates& force) const override {
    for (int item = 0; item < size(); ++item) {
      const ItemSlots f = gather(item, acceleration) * element(item).mass();  // mass is symmetric
      for (int a = 0; a < N; ++a) {
        NodeTable::slots(force, nodes(item)[static_cast<std::size_t>(a)]) +=
            f.template middleCols<4>(4 * a);
      }
    }
  }

  void add_momentum(const Coordinates& q, const Coordinates& velocity,
                    Momentum& momentum) const override {
    for (std::size_t i = 0; i < placement_.items.size(); ++i) {
      if (!placement_.owned[i]) continue;
      const int item = placement_.items[i];
      add_item_momentum<S>(element(item).mass(), gather(item, q), gather(item, velocity), momentum);
    }
  }

  StepWork step_work(const State& state, const Stencil& stencil) const override {
    const Stencil damped = with_damping(stencil);
    double taken = 0.0;
    Strain y;
    Response<M> response;
    for (std::size_t i = 0; i < placement_.items.size(); ++i) {
      if (!placement_.owned[i]) continue;
      const int item = placement_.items[i];
      const ItemSlots q = gather(item, state.next);
      for (int p = 0; p < E::num_points; ++p) {
        const Strain& prev = strain_prev_[at(i, p)];
        element(item).strain(p, q, y);
        element(item).respond(p, prev, y, damped, response);
        // what the stress takes beyond the change of the stored energy
        taken += response.stress.dot(y - prev) -
                 (element(item).energy(p, y) - element(item).energy(p, prev));
      }
    }
    StepWork work;
    const double physical = damping_.viscosity / stencil.step;
    const double share = physical > 0.0 ? physical / damping_.weight(stencil.step) : 0.0;
    work.damping = share * taken;
    work.dissipation = taken - work.damping;
    return work;
  }

  std::vector<std::string> resultant_names() const override {
    const auto names = E::resultant_names();
    return {names.begin(), names.end()};
  }

  void resultants(int item, const Coordinates& q, std::vector<double>& out) const override {
    const ItemSlots slots = gather(item, q);
    Vec<E::num_resultants> mean = Vec<E::num_resultants>::Zero();
    Strain y;
    for (int p = 0; p < E::num_points; ++p) {
      element(item).strain(p, slots, y);
      mean += element(item).resultants(p, y) / E::num_points;
    }
    out.insert(out.end(), mean.data(), mean.data() + mean.size());
  }

 private:
  Stencil with_damping(Stencil stencil) const {
    if (stencil.step > 0.0) stencil.theta_strain += damping_.weight(stencil.step);
    return stencil;
  }
  static std::size_t at(std::size_t item, int point) {
    return item * E::num_points + static_cast<std::size_t>(point);
  }

  ItemSlots gather(int item, const Coordinates& q) const {
    ItemSlots slots;
    for (int a = 0; a < N; ++a) {
      slots.template middleCols<4>(4 * a) =
          NodeTable::slots(q, nodes(item)[static_cast<std::size_t>(a)]);
    }
    return slots;
  }

  ItemSlots gather_arms(int item, const ItemSlots& slots, const Coordinates& q) const {
    ItemSlots arms = slots;
    for (int a = 0; a < N; ++a) {
      const int node = nodes(item)[static_cast<std::size_t>(a)];
      arms.col(4 * a).setZero();
      if (nodes_.is_slave(node)) {
        arms.col(4 * a) = slots.col(4 * a) - NodeTable::slots(q, nodes_.master(node)).col(0);
      }
    }
    return arms;
  }

  template <class Space>
  Verdict assemble_as(const State& state, const Stencil& stencil, Want want, Target& target) {
    Verdict verdict = Verdict::ok;
    for (std::size_t i = 0; i < placement_.items.size(); ++i) {
      verdict = worse(verdict, want == Want::mass
                                   ? assemble_mass<Space>(i, state, target)
                                   : assemble_item<Space>(i, state, stencil, want, target));
    }
    return verdict;
  }

  // Slots and arms of an item where forces act, and at the end of the step.
  struct Motion {
    ItemSlots next, arms_next, mid, arms_mid;
  };

  Motion gather_motion(int item, const State& state, double theta) const {
    Motion m;
    m.next = gather(item, state.next);
    m.arms_next = gather_arms(item, m.next, state.next);
    if (theta == 1.0) {
      m.mid = m.next;
      m.arms_mid = m.arms_next;
    } else {
      const ItemSlots prev = gather(item, state.prev);
      m.mid = (1.0 - theta) * prev + theta * m.next;
      m.arms_mid = (1.0 - theta) * gather_arms(item, prev, state.prev) + theta * m.arms_next;
    }
    return m;
  }

  // What an item adds: residual and tangent in unknowns, and the parts of the tangent that come
  // from scalars between slots and from forces on slots.
  template <class Space>
  struct Contribution {
    static constexpr int W = Space::width;
    Vec<W* N> residual = Vec<W * N>::Zero();
    RowMat<W * N, W * N> tangent;
    SlotMatrix<S> scalars;
    Vec<3 * S> slot_force;
    bool with_tangent;

    explicit Contribution(bool tangent_wanted) : with_tangent(tangent_wanted) {
      if (!with_tangent) return;
      tangent.setZero();
      scalars.setZero();
      slot_force.setZero();
    }
  };

  template <class Space>
  Verdict assemble_item(std::size_t i, const State& state, const Stencil& stencil, Want want,
                        Target& target) {
    const Motion motion = gather_motion(placement_.items[i], state, stencil.theta);
    Contribution<Space> c(want == Want::residual_and_tangent);
    const Verdict verdict = add_stress(i, motion, stencil, c);
    if (stencil.inertia != 0.0) add_inertia(i, motion, state, stencil, c);
    if (!std::isfinite(c.residual.sum())) return Verdict::not_finite;
    scatter(i, motion, stencil.theta, c, target);
    return verdict;
  }

  // B(q_theta)^T S and its derivative
  template <class Space>
  Verdict add_stress(std::size_t i, const Motion& motion, const Stencil& stencil,
                     Contribution<Space>& c) {
    const E& element = this->element(placement_.items[i]);
    Verdict verdict = Verdict::ok;
    Strain y;
    Response<M> response;
    Gradient<S, M> B_mid;
    RowMat<Space::width * N, M> R_mid;
    for (int p = 0; p < E::num_points; ++p) {
      element.strain(p, motion.next, y);
      element.gradient(p, motion.mid, B_mid);
      verdict = worse(verdict, element.respond(p, strain_prev_[at(i, p)], y, stencil, response));
      reduce<Space>(B_mid, motion.arms_mid, R_mid);
      c.residual.noalias() += R_mid * response.stress;
      if (!c.with_tangent) continue;

      const Strain& stress = use_predicted_ ? predicted_stress_[at(i, p)] : response.stress;
      c.slot_force.noalias() += B_mid * stress;
      SlotMatrix<S> curvature = SlotMatrix<S>::Zero();
      element.add_curvature(p, stress, curvature);
      c.scalars += stencil.theta * curvature;
      const RowMat<Space::width * N, M> RD = R_mid * response.tangent;
      if (stencil.theta == 1.0) {
        c.tangent.noalias() += RD * R_mid.transpose();
      } else {
        Gradient<S, M> B_next;
        RowMat<Space::width * N, M> R_next;
        element.gradient(p, motion.next, B_next);
        reduce<Space>(B_next, motion.arms_next, R_next);
        c.tangent.noalias() += RD * R_next.transpose();
      }
    }
    return verdict;
  }

  // M a with a = inertia (q_next - q_prev) + offset
  template <class Space>
  void add_inertia(std::size_t i, const Motion& motion, const State& state, const Stencil& stencil,
                   Contribution<Space>& c) {
    const int item = placement_.items[i];
    const SlotMatrix<S>& mass = masses_[i];
    const ItemSlots force =
        inertia_force<S>(mass, stencil.inertia * (motion.next - gather(item, state.prev)) +
                                   gather(item, state.acceleration_offset));
    for (int a = 0; a < N; ++a) {
      const Vec<12> slots =
          force.template middleCols<4>(4 * a).template reshaped<Eigen::AutoOrder>();
      RowMat<Space::width, 1> reduced;
      Space::reduce_rows(slots, motion.arms_mid.template middleCols<4>(4 * a), reduced);
      c.residual.template segment<Space::width>(Space::width * a) += reduced;
    }
    if (!c.with_tangent) return;
    c.slot_force += force.template reshaped<Eigen::AutoOrder>();
    c.scalars += stencil.inertia * mass;
  }

  template <class Space>
  void scatter(std::size_t i, const Motion& motion, double theta, Contribution<Space>& c,
               Target& target) {
    constexpr int W = Space::width;
    target.force_scale =
        std::max(target.force_scale, c.residual.template lpNorm<Eigen::Infinity>());
    for (int a = 0; a < N; ++a) {
      placement_.scatter.add_residual(i, a, c.residual.data() + W * a, target);
    }
    if (!c.with_tangent) return;
    const Eigen::Map<const ItemSlots> slot_forces(c.slot_force.data());
    for (int a = 0; a < N; ++a) {
      for (int b = 0; b < N; ++b) {
        auto block = c.tangent.template block<W, W>(W * a, W * b);
        Space::add_pairs(c.scalars.template block<4, 4>(4 * a, 4 * b),
                         motion.arms_mid.template middleCols<4>(4 * a),
                         motion.arms_next.template middleCols<4>(4 * b), block);
        if (a == b) {
          Space::add_turning(slot_forces.template middleCols<4>(4 * a),
                             motion.arms_next.template middleCols<4>(4 * a), theta, block);
        }
        placement_.scatter.add_tangent(i, a, b, block, target);
      }
    }
  }

  // P^T M P at the end of the step
  template <class Space>
  Verdict assemble_mass(std::size_t i, const State& state, Target& target) {
    const Motion motion = gather_motion(placement_.items[i], state, 1.0);
    Contribution<Space> c(true);
    c.scalars = element(placement_.items[i]).mass();
    scatter(i, motion, 1.0, c, target);
    return Verdict::ok;
  }

  template <class Space>
  static void reduce(const Gradient<S, M>& B, const ItemSlots& arms,
                     RowMat<Space::width * N, M>& R) {
    for (int a = 0; a < N; ++a) {
      Space::reduce_rows(B.template middleRows<12>(12 * a), arms.template middleCols<4>(4 * a),
                         R.template middleRows<Space::width>(Space::width * a));
    }
  }

  std::string effect_;
  const NodeTable& nodes_;
  StrainDamping damping_;
  std::vector<E> elements_;
  std::vector<std::array<int, N>> connectivity_;
  Placement placement_;
  Form form_ = Form::null_space;
  std::vector<SlotMatrix<S>> masses_;  // of the local items; filled when inertia is wanted
  std::vector<Strain> strain_prev_;
  std::vector<Strain> predicted_stress_;
  bool use_predicted_ = false;
};

}  // namespace culm::model
