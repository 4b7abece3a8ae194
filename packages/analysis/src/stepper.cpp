#include <culm/analysis/stepper.hpp>
#include <culm/base/error.hpp>

#include <cmath>
#include <string>

namespace culm::analysis {

void Stepper::require(bool holds, const char* verb) {
  if (holds) return;
  throw UsageError(std::string("a step cannot ") + verb +
                   " now: begin; then attempt; then accept, discard or fail; save and restore "
                   "between steps; nothing after the end");
}

void Stepper::fit() {
  require(stage_ == Stage::unbegun, "be fitted");
  system().forget_others(state_);
  do_fit();
  system().show_level(state_);
}

void Stepper::begin() {
  require(stage_ == Stage::unbegun, "begin");
  system().forget_others(state_);
  do_begin();
  system().sample(state_);
  newton().keep();
  stage_ = Stage::resting;
}

void Stepper::resume(const Snapshot& snapshot) {
  require(stage_ == Stage::unbegun, "be resumed");
  do_prepare_resume();
  stage_ = Stage::resting;
  restore(snapshot);
  system().forget_others(state_);
}

const StepReport& Stepper::attempt(double target) {
  if (stage_ == Stage::tried) discard();
  require(stage_ == Stage::resting, "be attempted");
  if (!std::isfinite(target)) throw NonFiniteError("a step cannot be attempted to no number");
  is_exhausted_ = has_reactions_ = is_outdated_ = false;
  stage_ = Stage::tried;
  try {
    report_ = do_attempt(target);
  } catch (...) {
    discard();
    throw;
  }
  report_.final_time = final_time();
  report_.accepted = report_.outcome.converged();
  report_.step = steps_ + (report_.accepted ? 1 : 0);
  return report_;
}

void Stepper::accept() {
  require(stage_ == Stage::tried, "be accepted");
  if (!report_.accepted) {
    throw UsageError("an attempt cannot be accepted that did not converge: " +
                     solver::describe(report_.outcome.end));
  }
  if (is_outdated_) {
    throw UsageError(
        "an attempt cannot be accepted under loads or signals that were set after it: attempt "
        "again");
  }
  ++steps_;
  post_mortem().record(report_);
  do_accept(report_);
  has_reactions_ = true;
  system().sample(state_);
  report_.is_last = reaches_end();
  newton().keep();
  stage_ = Stage::resting;
  if (observer_ != nullptr) observer_->step(report_, state_);
}

void Stepper::preview(const std::function<void(model::State&)>& look) {
  require(is_open(), "be looked at");
  system().preview(state_, end_velocity(report_), last_stencil(), look);
}

model::Coordinates Stepper::velocity() const {
  return is_open() ? end_velocity(report_) : state_.velocity;
}

void Stepper::go_back() {
  system().discard(state_);
  stage_ = Stage::resting;
}

void Stepper::discard() {
  require(stage_ == Stage::tried, "be discarded");
  go_back();
  do_discard();
  newton().go_back();
}

void Stepper::abandon() {
  if (stage_ == Stage::tried) discard();
}

void Stepper::fail() {
  require(stage_ == Stage::tried, "fail");
  report_.accepted = false;
  report_.step = steps_;
  post_mortem().record(report_);
  go_back();
  newton().keep();
  const bool not_finite = report_.outcome.end == solver::StepEnd::not_finite;
  is_exhausted_ = do_fail(report_) || not_finite;  // no nearer target will make it finite
  if (observer_ != nullptr) observer_->step(report_, state_);
}

void Stepper::give_up() {
  require(stage_ == Stage::resting, "be given up");
  explain_failure();
  post_mortem().give_up(state_, last_stencil(), dead_end());
}

AnalysisReport Stepper::finish() {
  if (stage_ == Stage::tried) discard();
  require(stage_ != Stage::unbegun, "end");
  const bool is_told = observer_ != nullptr && stage_ != Stage::ended;
  stage_ = Stage::ended;
  AnalysisReport report = do_finish();
  if (is_told) observer_->finish(report, state_);
  return report;
}

void Stepper::save(Snapshot& snapshot) {
  require(stage_ == Stage::resting || stage_ == Stage::ended, "be saved");
  system().save(state_, snapshot);
  snapshot.set_text("stepper", kind());
  snapshot.set("steps", steps_);
  do_save(snapshot);
  newton_->save(snapshot);
  post_mortem_->save(snapshot);
  if (observer_ != nullptr && snapshot.is_for_memory()) observer_->keep(snapshot);
}

void Stepper::restore(const Snapshot& snapshot) {
  if (stage_ == Stage::tried) discard();
  require(stage_ == Stage::resting, "be restored");
  refuse_foreign(snapshot);
  if (observer_ != nullptr && snapshot.is_for_memory()) observer_->go_back(snapshot);
  system().restore(snapshot, state_);
  steps_ = snapshot.integer("steps");
  has_reactions_ = false;
  do_restore(snapshot);
  newton_->restore(snapshot);
  newton_->keep();
  if (!post_mortem_) post_mortem_.emplace(context_, snapshot);
}

void Stepper::refuse_foreign(const Snapshot& snapshot) const {
  if (!snapshot.is_for_memory()) return;  // files say by themselves what they do not fit
  if (!snapshot.has("stepper")) {
    throw UsageError("a step cannot be restored from a snapshot that no step was saved to");
  }
  const std::string& other = snapshot.text("stepper");
  if (other != kind()) {
    throw UsageError("a snapshot of type '" + other + "' does not belong to a step of type '" +
                     kind() + "'");
  }
  if (system().fits(snapshot, state_)) return;
  throw UsageError("a snapshot does not belong to this model: it has other unknowns or memories");
}

AnalysisReport run(Stepper& stepper) {
  struct Nobody final : Observer {
    void step(const StepReport&, model::State&) override {}
  } nobody;
  return run(stepper, nobody);
}

AnalysisReport run(Stepper& stepper, Observer& observer) {
  while (!stepper.is_at_end()) {
    const StepReport& tried = stepper.attempt(stepper.proposal());
    if (stepper.is_at_end()) break;
    tried.accepted ? stepper.accept() : stepper.fail();
    observer.step(tried, stepper.state());
    if (stepper.is_exhausted()) stepper.give_up();
  }
  return stepper.finish();
}

}  // namespace culm::analysis
