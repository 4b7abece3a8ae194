/// A step as an object: attempted as often as wanted, then accepted or discarded.
#pragma once

#include <culm/analysis/analysis.hpp>
#include <culm/analysis/post_mortem.hpp>

#include <functional>
#include <optional>

namespace culm::analysis {

/// Moves a state in steps. Statics, paths and motions are steppers; runs of decks, couplings and
/// tests drive them by the same verbs, collectively:
///
///   begin | resume      attempt … attempt      accept | discard | fail      save, restore
///
/// Every attempt starts from the same accepted state and with the same first guess, whatever was
/// attempted before: equal loads and equal targets give equal bits. Verbs out of order are a
/// UsageError. A stepper borrows its context and its state.
class Stepper {
 public:
  Stepper(Context& context, model::State& state) : context_(context), state_(state) {
    state_.in_motion = false;  // where it is, the constructor of what moves says so
  }
  virtual ~Stepper() = default;
  Stepper(const Stepper&) = delete;
  Stepper& operator=(const Stepper&) = delete;

  /// Whom to tell of steps that others make: of accept, fail and finish, and of save and restore
  /// with snapshots for memory; null for nobody. run() tells its observer by itself.
  void tell(Observer* observer) { observer_ = observer; }

  /// Brings positions and velocities to where the analysis can begin.
  void fit();
  /// After fit: looks at the state and prepares the first step. Throws NumericalError where none
  /// can be made, as from a mechanism.
  void begin();
  /// Instead of both: goes on from what save() wrote, on any number of ranks. Throws FileError if
  /// it does not fit.
  void resume(const Snapshot& snapshot);

  /// Whether the last accepted step was the last one, or an attempt found that it is.
  bool is_at_end() const { return reaches_end(); }
  /// Where the next step should go: a time [s], a load level, or the length of a way along a path.
  double proposal() const { return propose(); }
  /// Where the last step ends: a time [s] or a load level; infinite where nobody knows, as on
  /// paths.
  virtual double final_time() const = 0;
  /// Solves a step from the accepted state to `target`, of the kind that proposal() gives; whatever
  /// was attempted before is forgotten. Not converging is a value: StepReport::accepted is false.
  /// The state's end of the step is that of this attempt until the next verb. Throws UsageError for
  /// a time that is not after the accepted one, NonFiniteError for no number.
  const StepReport& attempt(double target);
  /// Makes the end of a converged attempt the accepted state. Exactly once per step.
  void accept();
  /// Goes back to the accepted state because the caller wants another attempt: teaches nothing.
  void discard();
  /// The same where an attempt was made and nobody will judge it any more.
  void abandon();
  /// Goes back because the attempt was not good: the next proposal is nearer.
  void fail();
  /// Whether an attempt has converged and waits for its verb.
  bool is_open() const { return stage_ == Stage::tried && report_.accepted; }
  /// Shows the state that accept() would make of an open attempt, with what the model would then
  /// remember, and takes it back. Collective.
  void preview(const std::function<void(model::State&)>& look);
  /// Tells that a load or signal was set from outside: an attempt that is open still shows what it
  /// found, and cannot be accepted.
  void outdate() { is_outdated_ = is_open(); }
  /// Whether the last evaluation was that of the accepted state, so that reactions are its own.
  bool has_reactions() const { return has_reactions_; }
  /// Whether nothing nearer than the last failure may be tried.
  bool is_exhausted() const { return is_exhausted_; }
  /// Throws NumericalError or NonFiniteError with a post-mortem of the attempts that failed.
  [[noreturn]] void give_up();
  /// What the analysis says at its end. An attempt that is still open is discarded; no other
  /// follows.
  AnalysisReport finish();

  /// The accepted state and all that the next step needs beside it; between steps. A snapshot for
  /// memory takes what this rank has, without communication; one for files is the same for any
  /// number of ranks, and complete on the root.
  void save(Snapshot& snapshot);
  /// Goes back to what save() wrote into a snapshot for memory, here or in an equal stepper. Steps
  /// made since are forgotten, but for what observers have seen of them. Throws UsageError, and
  /// changes nothing, for a snapshot of another kind of analysis or of another model.
  void restore(const Snapshot& snapshot);

  /// Of the last attempt if one is open, else the accepted one.
  const model::State& state() const { return state_; }
  model::State& state() { return state_; }
  /// Velocities that belong to state(): at the end of an attempt that is open and converged, where
  /// state().velocity is still that at its start.
  model::Coordinates velocity() const;
  /// Time [s] or level of the accepted state.
  double time() const { return state_.time_prev; }
  int steps() const { return steps_; }
  /// Of the last attempt.
  virtual Stencil last_stencil() const = 0;

 protected:
  Context& context() const { return context_; }
  assembly::System& system() const { return context_.system; }
  /// Of accepted and failed attempts; made by do_begin, or here after resume.
  PostMortem& post_mortem() { return *post_mortem_; }
  template <class... Args>
  void make_post_mortem(Args&&... args) {
    post_mortem_.emplace(context_, std::forward<Args>(args)...);
  }
  solver::NewtonSolver& newton() { return newton_.value(); }
  void make_newton(const solver::NewtonSettings& settings) {
    newton_.emplace(system(), context_.linear, settings, context_.ledger);
  }

 private:
  /// Type of the analysis in a deck; what snapshots of its steppers are known by.
  virtual const char* kind() const = 0;
  virtual void do_fit() {}
  /// Makes Newton's solver, the post-mortem and all other tools for the present state.
  virtual void do_begin() = 0;
  /// Makes Newton's solver and other tools without a look at the state.
  virtual void do_prepare_resume() = 0;
  virtual bool reaches_end() const = 0;
  virtual double propose() const = 0;
  /// @return with outcome, time and increment
  virtual StepReport do_attempt(double target) = 0;
  /// Learns from an attempt that is accepted; state.prev is still the start of the step. Calls
  /// accept of the system at its place among what happens then.
  virtual void do_accept(const StepReport& report) = 0;
  /// Velocities at the end of an attempt.
  virtual model::Coordinates end_velocity(const StepReport&) const { return state_.velocity; }
  /// Forgets what an attempt has found, beside the state.
  virtual void do_discard() {}
  /// Learns from an attempt that failed, after going back. @return whether to give up
  virtual bool do_fail(const StepReport& report) = 0;
  /// What the post-mortem can not know: throws where there is a better reason.
  virtual void explain_failure() {}
  /// Towards which level ever smaller gains lead, where they are the reason to give up.
  virtual std::optional<double> dead_end() const { return {}; }
  virtual AnalysisReport do_finish() = 0;
  virtual void do_save(Snapshot& snapshot) const = 0;
  virtual void do_restore(const Snapshot& snapshot) = 0;

  enum class Stage { unbegun, resting, tried, ended };
  static void require(bool holds, const char* verb);
  void go_back();
  void refuse_foreign(const Snapshot& snapshot) const;

  Context& context_;
  model::State& state_;
  Stage stage_ = Stage::unbegun;
  bool is_exhausted_ = false;
  bool has_reactions_ = false;
  bool is_outdated_ = false;
  Observer* observer_ = nullptr;
  int steps_ = 0;
  StepReport report_;
  std::optional<solver::NewtonSolver> newton_;
  std::optional<PostMortem> post_mortem_;
};

/// Makes all steps to the end, as a deck asks for them. Throws what Stepper::give_up throws; the
/// state is then the last accepted one.
AnalysisReport run(Stepper& stepper, Observer& observer);
/// The same where nobody looks on.
AnalysisReport run(Stepper& stepper);

}  // namespace culm::analysis
