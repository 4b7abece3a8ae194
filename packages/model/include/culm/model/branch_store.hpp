/// Memory of viscoelastic branches.
#pragma once

#include <culm/math/types.hpp>
#include <culm/mechanics/relaxation.hpp>

#include <algorithm>
#include <cstddef>
#include <span>
#include <vector>

namespace culm::model {

/// The strains of the springs of all branches at all points of a batch, as they were accepted, with
/// M strains. Steps without length, as in statics, end relaxed. Empty, and without work, where
/// there are no branches.
template <int M>
class BranchStore {
 public:
  using Strain = Vec<M>;
  using Stiffness = RowMat<M, M>;

  explicit BranchStore(const std::vector<MaxwellBranch>& branches) {
    for (const MaxwellBranch& branch : branches) {
      Branch& made = branches_.emplace_back();
      made.time = branch.time;
      made.roots = Eigen::Map<const Strain>(branch.ratios.data()).cwiseSqrt();
    }
  }

  bool empty() const { return branches_.empty(); }
  /// Whether all strains relax alike, in each branch.
  bool is_uniform() const {
    return std::ranges::all_of(
        branches_, [](const Branch& b) { return (b.roots.array() == b.roots[0]).all(); });
  }
  void resize(std::size_t points) { strains_.assign(points * branches_.size(), Strain::Zero()); }
  /// Before an attempt of a step [s].
  void prepare(double step) {
    acts_ = step > 0.0 && !empty();
    if (!acts_) return;
    for (Branch& branch : branches_) branch.step = MaxwellStep::of(step, branch.time);
  }
  /// Whether the step has branches that act.
  bool acts() const { return acts_; }

  /// Adds the stress of all branches for the change of strain De. @param theta where in the step:
  /// the mean at 1/2
  template <class Matrix>
  void add_stress(std::size_t point, const Matrix& C, const Strain& De, double theta,
                  Strain& stress) const {
    for (std::size_t k = 0; k < branches_.size(); ++k) {
      const Branch& b = branches_[k];
      const Strain d = (b.step.mean_kept + (theta - 0.5) * (b.step.kept - 1.0)) * at(point, k) +
                       weight(b, theta) * De;
      const Strain rooted = b.roots.cwiseProduct(d);
      stress += b.roots.cwiseProduct((C * rooted).eval());
    }
  }
  /// Adds the derivative of that by De.
  template <class Matrix>
  void add_stiffness(const Matrix& C, double theta, Stiffness& sum) const {
    for (const Branch& b : branches_) {
      sum += weight(b, theta) * (b.roots.asDiagonal() * C * b.roots.asDiagonal());
    }
  }
  /// The same over C, where all strains relax alike.
  double stiffness_weight(double theta) const {
    double sum = 0.0;
    for (const Branch& b : branches_) sum += weight(b, theta) * b.roots[0] * b.roots[0];
    return sum;
  }

  /// Energy of the springs as accepted.
  template <class Matrix>
  double energy(std::size_t point, const Matrix& C) const {
    double sum = 0.0;
    for (std::size_t k = 0; k < branches_.size(); ++k) {
      sum += energy(branches_[k], C, at(point, k));
    }
    return sum;
  }
  /// What the dashpots take in the step, >= 0.
  template <class Matrix>
  double taken(std::size_t point, const Matrix& C, const Strain& De) const {
    double sum = 0.0;
    for (std::size_t k = 0; k < branches_.size(); ++k) {
      const Branch& b = branches_[k];
      const Strain& prev = at(point, k);
      const Strain mean = b.roots.cwiseProduct(b.step.mean_kept * prev + b.step.mean_gained * De);
      const Strain rooted = b.roots.cwiseProduct(De);
      sum += mean.dot(C * rooted) - energy(b, C, next(b, prev, De)) + energy(b, C, prev);
    }
    return sum;
  }
  /// Ends the step of a point.
  void accept(std::size_t point, const Strain& De) {
    for (std::size_t k = 0; k < branches_.size(); ++k) {
      Strain& d = strains_[point * branches_.size() + k];
      d = acts_ ? next(branches_[k], d, De) : Strain(Strain::Zero());
    }
  }

  std::size_t point_memory() const { return branches_.size() * M; }
  void save(std::size_t point, std::span<double> memory) const {
    for (std::size_t k = 0; k < branches_.size(); ++k) {
      std::copy_n(at(point, k).data(), M, memory.data() + k * M);
    }
  }
  void restore(std::size_t point, std::span<const double> memory) {
    for (std::size_t k = 0; k < branches_.size(); ++k) {
      std::copy_n(memory.data() + k * M, M, strains_[point * branches_.size() + k].data());
    }
  }

 private:
  struct Branch {
    double time = 0.0;
    Strain roots;  ///< of the ratios
    MaxwellStep step;
  };

  const Strain& at(std::size_t point, std::size_t k) const {
    return strains_[point * branches_.size() + k];
  }
  static double weight(const Branch& b, double theta) {
    return b.step.mean_gained + (theta - 0.5) * b.step.gained;
  }
  static Strain next(const Branch& b, const Strain& prev, const Strain& De) {
    return b.step.kept * prev + b.step.gained * De;
  }
  template <class Matrix>
  static double energy(const Branch& b, const Matrix& C, const Strain& d) {
    const Strain rooted = b.roots.cwiseProduct(d);
    return 0.5 * rooted.dot(C * rooted);
  }

  std::vector<Branch> branches_;
  std::vector<Strain> strains_;  ///< by point, branch after branch
  bool acts_ = false;
};

}  // namespace culm::model
