/// What answers the strains of elements, point by point, and what it remembers.
#pragma once

#include <culm/base/error.hpp>
#include <culm/mechanics/element.hpp>
#include <culm/model/branch_store.hpp>
#include <culm/model/internal_store.hpp>
#include <culm/model/strain_damping.hpp>

#include <cstddef>
#include <optional>
#include <span>
#include <vector>

namespace culm::model {

/// What a batch can hold.
template <class E>
concept BatchElement = Element<E> || ElementWithInternals<E>;

/// The law of the element at all points of a batch, with damping, viscoelastic branches and
/// internal variables: stress and its derivative, energy, what a step takes, and the memory.
template <BatchElement E>
class PointLaws {
 public:
  static constexpr int M = E::num_strains;
  static constexpr bool has_internals = ElementWithInternals<E>;
  using Strain = Vec<M>;

  explicit PointLaws(const StrainDamping& damping)
      : damping_(damping), branches_(damping.branches) {
    internal_check(branches_.empty() || HasStiffness<E>, "these elements do not relax");
    internal_check(
        branches_.roots().size() == (HasBranchStiffness<E> ? 0 : branches_.times().size()),
        "branches have ratios or stiffnesses of elements");
    if (damping.viscosities.empty()) return;
    internal_check(HasStiffness<E> && damping.viscosities.size() == M,
                   "these elements do not damp strains one by one");
    roots_ = Eigen::Map<const Strain>(damping.viscosities.data()).cwiseSqrt();
  }

  const StrainDamping& damping() const { return damping_; }
  const BranchStore<M>& branches() const { return branches_; }
  void resize(std::size_t points) {
    prev_.assign(points, Strain::Zero());
    if constexpr (has_internals) internals_.resize(points);
    branches_.resize(points);
  }

  /// Before an attempt of a step.
  /// @return whether the strains at its start are wanted, as `prev`
  bool prepare(const Stencil& stencil) {
    if constexpr (has_internals) internals_.prepare();
    branches_.prepare(stencil.step);
    return stencil.step != 0.0 || has_internals;  // in statics the old strain has no weight
  }
  Strain& prev(std::size_t point) { return prev_[point]; }
  const Strain& prev(std::size_t point) const { return prev_[point]; }
  /// Whether points carry something from step to step.
  bool remembers() const { return has_internals || !branches_.empty(); }
  /// Ends a step: what needs no strain, and what needs that of its end.
  void accept() {
    if constexpr (has_internals) internals_.accept();
  }
  void accept(std::size_t point, const Strain& y) { branches_.accept(point, y - prev_[point]); }

  /// The stencil with the weight that damping gives the new strain.
  Stencil damped(Stencil stencil) const {
    if (stencil.step > 0.0) stencil.theta_strain += damping_.weight(stencil.step);
    return stencil;
  }

  /// The stress of a point at the strain y, moved on by dy where that is given: to first order.
  /// @param stencil  damped
  Verdict respond(const E& element, int p, std::size_t point, const Strain& y,
                  const Stencil& stencil, Response<M>& response, const Strain* dy = nullptr) {
    if constexpr (has_internals) {
      return respond_with(internals_.solve_at(point, y), element, p, point, y, stencil, response,
                          dy);
    } else {
      Internals none;
      return respond_with(none, element, p, point, y, stencil, response, dy);
    }
  }

  /// Calls add(matrix, factor) with dS/dy = factor matrix, of the stress that was found last; the
  /// matrix is not copied where it need not.
  template <class Add>
  void with_tangent(const E& element, int p, const Stencil& stencil, const Response<M>& response,
                    Add add) const {
    if constexpr (HasStiffness<E>) {
      const RowMat<M, M>& C = element.stiffness(p);
      const bool damps = roots_ && stencil.step > 0.0;
      if (!damps && !branches_.acts()) return add(C, stencil.theta_strain);
      RowMat<M, M> tangent = stencil.theta_strain * C;
      if (damps) tangent += roots_->asDiagonal() * C * (*roots_ / stencil.step).asDiagonal();
      if (branches_.acts()) {
        branches_.add_stiffness(branch_law(element, p), stencil.theta, tangent);
      }
      add(tangent, 1.0);
    } else {
      add(response.tangent, 1.0);
    }
  }

  /// The stiffness of a branch at a point, all of its spring acting.
  RowMat<M, M> branch_stiffness(const E& element, int p, std::size_t branch) const {
    if constexpr (HasStiffness<E>) {
      return branch_law(element, p).stiffness(branch);
    } else {
      return RowMat<M, M>::Zero();
    }
  }

  /// Stored energy at a strain, of branches as accepted.
  double energy(const E& element, int p, std::size_t point, const Strain& y) const {
    Internals internals{};
    if constexpr (has_internals) internals = internals_.at(point, y);
    double sum = energy_of(element, p, y, internals);
    if constexpr (HasStiffness<E>) {
      if (!branches_.empty()) sum += branches_.energy(point, branch_law(element, p));
    }
    return sum;
  }

  /// Whether the stress is nothing but C times a mean of the strains at both ends of the step.
  bool is_plain(const Stencil& stencil) const {
    return HasStiffness<E> && !branches_.acts() && !(roots_ && stencil.step > 0.0);
  }

  /// What the stresses of a step took beyond the change of the stored energy.
  struct Taken {
    double by_law = 0.0;      ///< by the law with its mean damping
    double by_strains = 0.0;  ///< by the damping of each strain and by branches
  };
  /// Whether a step takes anything. @param stencil  damped
  bool takes(const Stencil& stencil) const {
    return !StressConserves<E> || stencil.theta_strain != 0.5 || roots_ || branches_.acts();
  }
  /// Of what the change of the strains would store by itself, so much is taken by a linear law.
  static double share_taken(const Stencil& stencil) { return 2.0 * stencil.theta_strain - 1.0; }
  /// Adds that of a point at the strain y of the end of the step.
  /// @param response  to it, if that is known
  void add_taken(const E& element, int p, std::size_t point, const Strain& y,
                 const Stencil& stencil, [[maybe_unused]] const Response<M>* response,
                 Taken& taken) const {
    const Strain& prev = prev_[point];
    if constexpr (HasStiffness<E>) {
      taken.by_law += share_taken(stencil) * element.energy(p, y - prev);
      if (roots_) {
        taken.by_strains += 2.0 / stencil.step * element.energy(p, roots_->cwiseProduct(y - prev));
      }
      if (branches_.acts()) {
        taken.by_strains += branches_.taken(point, branch_law(element, p), y - prev);
      }
    } else {
      Internals before{}, after{};
      if constexpr (has_internals) {
        before = internals_.prev(point);
        after = internals_.next(point);
      }
      Response<M> found;
      if (response == nullptr) {
        found.wants_tangent = false;
        respond_with(after, element, p, point, y, stencil, found);
        response = &found;
      }
      taken.by_law += response->stress.dot(y - prev) -
                      (energy_of(element, p, y, after) - energy_of(element, p, prev, before));
    }
  }

  /// Numbers that a point remembers.
  std::size_t point_memory() const { return internal_memory + branches_.point_memory(); }
  void save(std::size_t point, std::span<double> memory) const {
    if constexpr (has_internals) internals_.save(point, memory);
    branches_.save(point, memory.subspan(internal_memory));
  }
  void restore(std::size_t point, std::span<const double> memory) {
    if constexpr (has_internals) internals_.restore(point, memory);
    branches_.restore(point, memory.subspan(internal_memory));
  }

 private:
  struct Nothing {};
  template <class T, bool wanted>
  struct InternalTypes {
    using Store = InternalStore<T>;
    using Values = typename Store::Internals;
  };
  template <class T>
  struct InternalTypes<T, false> {
    using Store = Nothing;
    using Values = Nothing;
  };
  using Internals = typename InternalTypes<E, has_internals>::Values;
  static constexpr std::size_t internal_memory = [] {
    if constexpr (has_internals) return InternalStore<E>::point_memory;
    return std::size_t{0};
  }();

  auto branch_law(const E& element, int p) const requires HasStiffness<E> {
    if constexpr (HasBranchStiffness<E>) {
      return OwnBranches<E>{element, p};
    } else {
      return ScaledBranches<M>{element.stiffness(p), branches_.roots()};
    }
  }

  Verdict respond_with(Internals& internals, const E& element, int p, std::size_t point,
                       const Strain& y, const Stencil& stencil, Response<M>& response,
                       const Strain* dy = nullptr) const {
    const Strain& prev = prev_[point];
    const double weight = stencil.theta_strain;
    if constexpr (HasStiffness<E>) {
      Strain e = (1.0 - weight) * prev + weight * y;
      if (dy != nullptr) e += weight * *dy;
      response.stress.noalias() = element.stiffness(p) * e;
      if (roots_ && stencil.step > 0.0) {
        Strain rate = y - prev;
        if (dy != nullptr) rate += *dy;
        rate = roots_->cwiseProduct(rate) / stencil.step;
        response.stress += roots_->cwiseProduct((element.stiffness(p) * rate).eval());
      }
      if (branches_.acts()) {
        Strain change = y - prev;
        if (dy != nullptr) change += *dy;
        branches_.add_stress(point, branch_law(element, p), change, stencil.theta, response.stress);
      }
      return Verdict::ok;
    } else {
      Verdict verdict = Verdict::ok;
      if constexpr (has_internals) {
        verdict = element.respond(p, prev, y, internals_.prev(point), stencil, internals, response);
      } else {
        verdict = element.respond(p, prev, y, stencil, response);
      }
      if (dy != nullptr) response.stress += response.tangent * *dy;
      return verdict;
    }
  }

  static double energy_of(const E& element, int p, const Strain& y,
                          [[maybe_unused]] const Internals& internals) {
    if constexpr (has_internals) {
      return element.energy(p, y, internals);
    } else {
      return element.energy(p, y);
    }
  }

  StrainDamping damping_;
  std::vector<Strain> prev_;     ///< at the start of the step, by point
  std::optional<Strain> roots_;  ///< sqrt(eta) of the strains that are damped each by itself
  [[no_unique_address]] typename InternalTypes<E, has_internals>::Store internals_;
  BranchStore<M> branches_;
};

}  // namespace culm::model
