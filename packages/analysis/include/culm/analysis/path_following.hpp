/// Equilibrium paths through limit points.
#pragma once

#include <culm/analysis/path_events.hpp>
#include <culm/analysis/path_pace.hpp>
#include <culm/analysis/path_settings.hpp>
#include <culm/analysis/stepper.hpp>

#include <limits>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace culm::analysis {

/// Follows an equilibrium path by arc length or displacement control, with automatic step length.
/// state.time is the level; a step is attempted by the length of its way. @source formulation 5.3
class PathFollowing final : public Stepper {
 public:
  /// Throws InputError if the watched node is none, or several.
  PathFollowing(PathSettings settings, Context& context, model::State& state);

  static Schema schema() { return path_schema(); }
  static std::unique_ptr<Stepper> make(const Options& options, Context& context,
                                       model::State& state);

  double final_time() const override { return std::numeric_limits<double>::infinity(); }

 private:
  /// What is known of the path behind and at the accepted state.
  struct Knowledge {
    PathPoint behind, here;
    bool has_behind = false;    ///< there is a point before the present one
    bool is_examined = false;   ///< the tangent at the present point is known
    bool has_branched = false;  ///< the crossing path was taken, or not found
    bool is_ended = false;      ///< the path ends here by an event
    std::vector<PathEvent> events;
  };

  /// A step that bends more than this, as a cosine, may have reached another piece of the path.
  static constexpr double least_straightness = 0.5;

  void do_begin() override;
  void do_prepare_resume() override { make_newton(settings_.newton); }
  bool reaches_end() const override;
  double propose() const override { return size_; }
  StepReport do_attempt(double size) override;
  void do_accept(const StepReport& report) override;
  void do_discard() override { known_ = before_; }
  bool do_fail(const StepReport& report) override;
  void explain_failure() override;
  Stencil last_stencil() const override { return Stencil::statics(); }
  AnalysisReport do_finish() override;
  const char* kind() const override { return "Path"; }
  void do_save(Snapshot& snapshot) const override;
  void do_restore(const Snapshot& snapshot) override;

  void balance_start();
  /// Tangent of the path and determinant of the stiffness at state.next.
  std::pair<PathTangent, solver::Determinant> compute_tangent();
  /// Throws NumericalError if nothing changes with the level, or not what is to be prescribed.
  void refuse_idle_level() const;
  bool is_on_target() const;
  bool passed_limit_points() const;
  /// Says where the number of steps ended the path before it reached what the deck names.
  void report_early_end() const;
  solver::StepOutcome go_on(double size);
  /// Where an attempt went beyond the end of the path, goes back to it.
  void land(solver::StepOutcome& outcome);
  /// Whether an attempt by the watched displacement has left the path: the structure moved much
  /// more than the tangent promised, or at both ends the level grows with this displacement, and
  /// yet it fell, or the other way round.
  bool leaps();
  /// Change of the state with the level at state.next, where a step has begun; nothing if it is not
  /// to be had.
  std::optional<assembly::Vector> find_flexibility();
  /// Looks for events between the last two points once the tangent of the later one is known.
  /// @return whether the determinant passes zero there; locate_events() is to follow
  bool examine(const PathTangent& tangent, const solver::Determinant& determinant);
  /// Solves on the path at a `length` [m] of arc before the last accepted point. @return the
  /// determinant there; nothing if no solution is found
  std::optional<solver::Determinant> go_back(double length);
  /// Whether the softest direction of the tangent at the present point sets energy free.
  void look_for_free_energy();
  /// Warns of two directions that lost their stiffness between the last two points, and left the
  /// determinant its sign.
  void watch_pairs();
  /// Finds where the determinant passes zero between the last two points, and corrects what was
  /// found there: the crossing of another path, or the limit point, or one of each.
  void locate_events();
  /// Warns that an event may lie anywhere between two levels.
  void doubt(const PathEvent& event, double one_level, double other_level);
  /// Warns that the level of a limit point is interpolated.
  void doubt_limit(const PathEvent& event);
  /// Whether another path crosses between the last two points.
  bool crosses() const;
  /// Tells the events that were found since the last step was accepted or failed.
  void tell_events();
  /// Whether the path that crosses behind the last accepted point is to be taken.
  bool is_to_branch() const;
  /// A step onto the path that crosses at the bifurcation just passed; nothing if none is found.
  std::optional<solver::StepOutcome> branch_off();
  /// Whether a path that crosses between the last two points may begin at this level.
  bool may_cross_at(double level) const;
  std::string describe(const PathEvent& event) const;
  AnalysisReport report() const;

  PathSettings settings_;
  PathCondition condition_;
  PathPace pace_;
  int failures_ = 0;          ///< since the last step that was taken
  double size_ = 0.0;         ///< of the next step [m]
  double attempted_ = 0.0;    ///< of the last attempt [m]
  double first_size_ = 0.0;   ///< of the first step
  double last_length_ = 0.0;  ///< between the last two points [m]
  /// Length from the last point back to the crossing, or as near as it was found [m].
  double back_ = 0.0;
  bool is_on_branch_ = false;  ///< the last attempt took a crossing path
  Knowledge known_, before_;   ///< now, and before the last attempt
};

}  // namespace culm::analysis
