/// How far along an equilibrium path a step goes: arc length and displacement control.
#pragma once

#include <culm/base/snapshot.hpp>
#include <culm/solver/level_condition.hpp>

#include <functional>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace culm::analysis {

/// The equation that makes a step of a path one of a given size. @source formulation 5.3
enum class PathControl {
  linearised_sphere,  ///< |Dx| = l, linearised anew in each iteration
  normal_plane,       ///< t . Dx = l with the direction t of the start of the step
  sphere,             ///< |Dx| = l, by the root that goes on
  displacement,       ///< a node moves by a given distance
};

/// Component of the displacement of a node.
struct WatchedMotion {
  int node = -1;
  Vec3 direction = Vec3::UnitX();  ///< of unit length
};

/// The direction of the path at the start of a step, by the arc length s.
struct PathTangent {
  double level = 0.0;    ///< dlevel/ds [1/m]
  double watched = 0.0;  ///< derivative of the watched displacement [-]; 0 without one
};

/// The condition of the steps of one path. Lengths are root mean squares over all nodes of what
/// they move and turn: a node counts |x|^2 + r^2 |theta|^2, the rotation by its directors, with the
/// length r = turning_arm(). Multipliers do not count, and the same steps are made in both forms of
/// the equations. Remembers the last increment, by which the next step knows its sense.
class PathCondition final : public solver::LevelCondition {
 public:
  /// Of the slots of all nodes, directors times their weights; the same on all ranks.
  using Motion = Eigen::Matrix<double, 12, Eigen::Dynamic>;

  /// @param level_difference for derivatives by the level; its sign is the sense of the first step
  PathCondition(assembly::System& system, PathControl control,
                const std::optional<WatchedMotion>& watched, double level_difference);

  /// Before an attempt that goes by `size` [m], the arc length or the displacement.
  void begin(double size);
  /// Before an attempt that goes back on the path, by `size` [m] along the tangent at the last
  /// accepted point.
  void begin_back(double size);
  /// Before the first attempt, where the arc length is to follow from the change of the level.
  void begin_first(double level_increment);
  /// After an attempt: goes on from its end to where the watched displacement has changed by
  /// `distance` [m] in the step.
  void begin_to_displacement(double distance);
  /// The attempt leaves the path at state.next: in the direction of `motion` it goes by `size` [m],
  /// from a state that has been moved there. With a positive size the watched displacement grows.
  /// @return factor of `motion` that makes it such a move
  double begin_branch(const model::State& state, const assembly::Vector& motion, double size);

  /// The displacement that a rotation by 1 rad counts as: a tenth of the length of the model [m].
  static double turning_arm(const model::Model& model);

  double level_difference() const override { return level_difference_; }
  double level_increment(const model::State& state, const assembly::Vector& response,
                         const assembly::Vector& flexibility) override;
  double violation(const model::State& state) override;

  /// Length of the way of the last attempt [m].
  double length(const model::State& state);
  /// Cosine between the way of the last attempt and the direction in which it began.
  double straightness(const model::State& state);
  /// The way of the last attempt.
  const Motion& way(const model::State& state);
  /// The way of the last accepted step; no columns before the first.
  const Motion& last_way() const { return previous_; }
  /// Length of a way [m].
  static double length(const Motion& way);
  /// Who looks at the start of each attempt while the factors at hand are those of its tangent.
  void set_probe(std::function<void()> probe) { probe_ = std::move(probe); }
  /// The tangent at the start of the last attempt; nothing if it had none.
  const std::optional<PathTangent>& tangent() const { return tangent_; }
  /// Finds the tangent from d_f at an equilibrium.
  void compute_tangent(const model::State& state, const assembly::Vector& flexibility);
  /// How the watched displacement changes with the level, from d_f at an equilibrium [m].
  double watched_by_level(const model::State& state, const assembly::Vector& flexibility) const;
  /// The watched displacement from the reference [m]; 0 without one.
  double watched_displacement(const model::Coordinates& q) const;

  /// After an accepted attempt, before prev takes the place of next.
  void accept(const model::State& state);
  /// The last increment, under "path/increment".
  void save(Snapshot& snapshot) const;
  void restore(const Snapshot& snapshot);

 private:
  void read_slots(const model::Coordinates& q, Motion& motion) const;
  void read_way(const model::State& state);
  void complete(Motion& motion) const;
  /// Mean over all nodes, so that a length does not depend on the mesh.
  static double dot(const Motion& a, const Motion& b);
  double watched_part(const Motion& motion) const;
  void set_tangent();
  double predict();
  double correct() const;

  assembly::System& system_;
  PathControl control_;
  std::optional<WatchedMotion> watched_;
  double level_difference_;
  std::vector<int> nodes_;   ///< that this rank has up to date, each on one rank
  Eigen::VectorXd weights_;  ///< of the directors of each node [m]

  PathControl present_;                    ///< of this attempt
  double size_ = 0.0;                      ///< of this attempt [m]
  std::optional<double> first_increment_;  ///< the size is not known yet
  bool has_begun_ = false;                 ///< an iteration of the attempt was made
  int missing_iterations_ = 0;             ///< that an attempt off the path has to make at least
  std::optional<PathTangent> tangent_;
  std::function<void()> probe_ = [] {};
  Motion previous_;     ///< the last accepted increment; no columns before the first
  Motion direction_;    ///< unit vector in which the attempt began
  Motion flexibility_;  ///< a
  Motion response_;     ///< b
  Motion way_;          ///< Dx
};

}  // namespace culm::analysis
