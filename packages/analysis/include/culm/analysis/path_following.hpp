/// Equilibrium paths through limit points.
#pragma once

#include <culm/analysis/path_events.hpp>
#include <culm/analysis/post_mortem.hpp>
#include <culm/base/options.hpp>
#include <culm/base/schema.hpp>

#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace culm::analysis {

/// What to do at a bifurcation.
enum class AtBifurcation { report, stop, follow };

/// The node that a path is seen by.
struct WatchSettings {
  Where node_where;
  std::string node;
  Vec3 direction = Vec3::UnitX();
};

/// How a path is followed.
struct PathSettings {
  PathControl control = PathControl::linearised_sphere;
  double start_level = 0.0;
  /// First change of the level [-]; with displacement control of the displacement [m].
  double first_increment = 0.1;
  int desired_iterations = 5;
  double smallest_length = 1e-6;  ///< over the first one [-]
  double largest_length = 10.0;   ///< likewise
  int steps = 200;                ///< at most
  std::optional<double> final_level;
  std::optional<double> final_displacement;  ///< of the watched node [m]
  std::optional<int> limit_points;           ///< to end after
  std::optional<WatchSettings> watch;
  AtBifurcation at_bifurcation = AtBifurcation::report;
  std::optional<double> branch_amplitude;  ///< [m]; the present arc length if absent
  solver::NewtonSettings newton;
};

/// Follows an equilibrium path by arc length or displacement control, with automatic step length.
/// state.time is the level. @source formulation 5.3
class PathFollowing final : public Analysis {
 public:
  explicit PathFollowing(PathSettings settings) : settings_(std::move(settings)) {}

  static Schema schema();
  static std::unique_ptr<Analysis> make(const Options& options);

  void save(const Context& context, Snapshot& snapshot) const override;

 private:
  void start(Context& context, model::State& state) override;
  void restore(Context& context, const Snapshot& snapshot) override;
  AnalysisReport advance(Context& context, model::State& state, Observer& observer) override;

  void make_tools(Context& context);
  void balance_start(Context& context, model::State& state);
  /// Tangent of the path and determinant of the stiffness at state.next.
  std::pair<PathTangent, solver::Determinant> find_tangent(Context& context, model::State& state);
  /// Throws NumericalError if nothing changes with the level, or not what is to be prescribed.
  void refuse_idle_level(const model::State& state) const;
  /// Throws NumericalError if loads stop growing with the level at this one.
  void refuse_end_of_loads(Context& context, model::State& state) const;
  bool is_at_end(const Context& context, const model::State& state) const;
  bool is_on_target(const Context& context, const model::State& state) const;
  bool passed_limit_points() const;
  /// Says where the number of steps ended the path before it reached what the deck names.
  void report_early_end(Context& context, const model::State& state) const;
  StepReport attempt(Context& context, model::State& state);
  /// Where an attempt went beyond the end of the path, goes back to it.
  void land(Context& context, model::State& state, solver::StepOutcome& outcome);
  /// Looks for events between the last two points once the tangent of the later one is known.
  /// @return whether they end the path
  bool examine(Context& context, const PathTangent& tangent,
               const solver::Determinant& determinant);
  void switch_branch(Context& context, model::State& state, Observer& observer);
  /// Accepts or rejects an attempt and chooses the size of the next one.
  void take(Context& context, model::State& state, StepReport& report, Observer& observer);
  std::string describe(const PathEvent& event) const;
  AnalysisReport report() const;

  PathSettings settings_;
  int steps_ = 0;
  int failures_ = 0;           ///< since the last step that was taken
  double size_ = 0.0;          ///< of the next step [m]
  double first_size_ = 0.0;    ///< of the first one
  double last_length_ = 0.0;   ///< between the last two points [m]
  bool is_examined_ = false;   ///< the tangent at the present point is known
  bool has_behind_ = false;    ///< there is a point before the present one
  bool wants_branch_ = false;  ///< a bifurcation was passed that is to be followed
  bool has_branched_ = false;
  PathPoint behind_, here_;
  std::vector<PathEvent> events_;
  std::optional<PathCondition> condition_;
  std::optional<solver::NewtonSolver> newton_;
  std::optional<PostMortem> post_mortem_;
};

}  // namespace culm::analysis
