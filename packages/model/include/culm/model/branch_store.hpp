/// Memory of viscoelastic branches.
#pragma once

#include <culm/math/types.hpp>
#include <culm/mechanics/relaxation.hpp>

#include <algorithm>
#include <concepts>
#include <cstddef>
#include <span>
#include <vector>

namespace culm::model {

/// Derivative of the strain of a branch's spring by the change of strain in the step, where in the
/// step forces act: the mean at theta = 1/2, the end at 1.
inline double branch_weight(const MaxwellStep& step, double theta) {
  return step.mean_gained + (theta - 0.5) * step.gained;
}

/// An element with a stiffness of its own for each branch of its batch, symmetric, positive
/// semidefinite and with the weight of the point, such as one of layers that relax differently.
/// Branches of other elements are C with roots of ratios on both sides.
template <class E>
concept HasBranchStiffness = requires(const E& e, int point, std::size_t branch) {
  { e.branch_stiffness(point, branch) }
  noexcept->std::convertible_to<const RowMat<E::num_strains, E::num_strains>&>;
};

/// Stiffnesses of the branches at a point: sqrt(g_I) C_IJ sqrt(g_J).
template <int M>
struct ScaledBranches {
  RowMat<M, M> C;
  const std::vector<Vec<M>>& roots;  ///< of the ratios g, by branch

  Vec<M> stress(std::size_t k, const Vec<M>& d) const {
    const Vec<M> rooted = roots[k].cwiseProduct(d);
    return roots[k].cwiseProduct((C * rooted).eval());
  }
  RowMat<M, M> stiffness(std::size_t k) const {
    return roots[k].asDiagonal() * C * roots[k].asDiagonal();
  }
  /// a . C_k b
  double product(std::size_t k, const Vec<M>& a, const Vec<M>& b) const {
    const Vec<M> rooted = roots[k].cwiseProduct(b);
    return roots[k].cwiseProduct(a).dot(C * rooted);
  }
};

/// The same where the element states them.
template <HasBranchStiffness E>
struct OwnBranches {
  static constexpr int M = E::num_strains;
  const E& element;
  int point;

  Vec<M> stress(std::size_t k, const Vec<M>& d) const { return stiffness(k) * d; }
  RowMat<M, M> stiffness(std::size_t k) const { return element.branch_stiffness(point, k); }
  double product(std::size_t k, const Vec<M>& a, const Vec<M>& b) const {
    return a.dot(stiffness(k) * b);
  }
};

/// The strains of the springs of all branches at all points of a batch, as they were accepted, with
/// M strains. Steps without length, as in statics, end relaxed. Empty, and without work, where
/// there are no branches. `Law` is one of the two above.
template <int M>
class BranchStore {
 public:
  using Strain = Vec<M>;
  using Stiffness = RowMat<M, M>;

  explicit BranchStore(const std::vector<MaxwellBranch>& branches) {
    for (const MaxwellBranch& branch : branches) {
      times_.push_back(branch.time);
      if (branch.ratios.empty()) continue;
      roots_.push_back(Eigen::Map<const Strain>(branch.ratios.data()).cwiseSqrt());
    }
    steps_.resize(times_.size());
  }

  bool empty() const { return times_.empty(); }
  std::size_t size() const { return times_.size(); }
  /// Relaxation times by branch [s].
  const std::vector<double>& times() const { return times_; }
  /// Roots of ratios by branch; none where elements have stiffnesses of branches.
  const std::vector<Strain>& roots() const { return roots_; }
  void resize(std::size_t points) { strains_.assign(points * size(), Strain::Zero()); }
  /// Before an attempt of a step [s].
  void prepare(double step) {
    acts_ = step > 0.0 && !empty();
    if (!acts_) return;
    for (std::size_t k = 0; k < size(); ++k) steps_[k] = MaxwellStep::of(step, times_[k]);
  }
  /// Whether the step has branches that act.
  bool acts() const { return acts_; }

  /// Adds the stress of all branches for the change of strain De. @param theta where in the step:
  /// the mean at 1/2
  template <class Law>
  void add_stress(std::size_t point, const Law& law, const Strain& De, double theta,
                  Strain& stress) const {
    for (std::size_t k = 0; k < size(); ++k) {
      const MaxwellStep& s = steps_[k];
      const Strain d = (s.mean_kept + (theta - 0.5) * (s.kept - 1.0)) * at(point, k) +
                       branch_weight(s, theta) * De;
      stress += law.stress(k, d);
    }
  }
  /// Adds the derivative of that by De.
  template <class Law>
  void add_stiffness(const Law& law, double theta, Stiffness& sum) const {
    for (std::size_t k = 0; k < size(); ++k) {
      sum += branch_weight(steps_[k], theta) * law.stiffness(k);
    }
  }

  /// Energy of the springs as accepted.
  template <class Law>
  double energy(std::size_t point, const Law& law) const {
    double sum = 0.0;
    for (std::size_t k = 0; k < size(); ++k) sum += energy(law, k, at(point, k));
    return sum;
  }
  /// What the dashpots take in the step, >= 0.
  template <class Law>
  double taken(std::size_t point, const Law& law, const Strain& De) const {
    double sum = 0.0;
    for (std::size_t k = 0; k < size(); ++k) {
      const Strain& prev = at(point, k);
      const Strain mean = steps_[k].mean_kept * prev + steps_[k].mean_gained * De;
      sum += law.product(k, mean, De) - energy(law, k, next(k, prev, De)) + energy(law, k, prev);
    }
    return sum;
  }
  /// Ends the step of a point.
  void accept(std::size_t point, const Strain& De) {
    for (std::size_t k = 0; k < size(); ++k) {
      Strain& d = strains_[point * size() + k];
      d = acts_ ? next(k, d, De) : Strain(Strain::Zero());
    }
  }

  std::size_t point_memory() const { return size() * M; }
  void save(std::size_t point, std::span<double> memory) const {
    for (std::size_t k = 0; k < size(); ++k) {
      std::copy_n(at(point, k).data(), M, memory.data() + k * M);
    }
  }
  void restore(std::size_t point, std::span<const double> memory) {
    for (std::size_t k = 0; k < size(); ++k) {
      std::copy_n(memory.data() + k * M, M, strains_[point * size() + k].data());
    }
  }

 private:
  const Strain& at(std::size_t point, std::size_t k) const { return strains_[point * size() + k]; }
  Strain next(std::size_t k, const Strain& prev, const Strain& De) const {
    return steps_[k].kept * prev + steps_[k].gained * De;
  }
  template <class Law>
  static double energy(const Law& law, std::size_t k, const Strain& d) {
    return 0.5 * law.product(k, d, d);
  }

  std::vector<double> times_;
  std::vector<Strain> roots_;
  std::vector<MaxwellStep> steps_;
  std::vector<Strain> strains_;  ///< by point, branch after branch
  bool acts_ = false;
};

}  // namespace culm::model
