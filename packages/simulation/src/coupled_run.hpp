/// Steps of a motion together with the partners of a deck.
#pragma once

#include <culm/analysis/stepper.hpp>
#include <culm/coupling/scheme.hpp>

#include "coupled_guess.hpp"
#include "coupled_side.hpp"
#include "coupled_window.hpp"

#include <memory>
#include <string>
#include <vector>

namespace culm::simulation {

/// Makes the steps of motions so that the loads at ports are what partners answer to the motion of
/// the ports. Partners live on the root; all ranks take the same way.
class CoupledRun {
 public:
  /// @param deck  with a list "Coupling"; it is referred to, as are the others. Throws InputError
  /// for ports that are not there.
  CoupledRun(const Options& deck, const coupling::PartnerRegistry& known, const CoupledFiles& files,
             const Ports& ports, const parallel::Comm& comm, Findings& findings);

  /// Whether loads at this port come from a partner.
  bool serves(const std::string& port) const;
  /// Makes all steps of a motion, as analysis::run does, and reports what crossed the ports. Throws
  /// PartnerError where a partner fails, NumericalError where a window does not fit.
  /// @param ports, watched  of the present model
  analysis::AnalysisReport run(analysis::Stepper& stepper, assembly::System& system,
                               const Ports& ports, const std::vector<WatchedQuantity>& watched,
                               analysis::Observer& observer);
  /// Says where a motion starts from another state that partners do not go back with it.
  void stay(const std::string& analysis, double time);
  /// Between windows; collective.
  void save(Snapshot& snapshot);
  /// Before run(). @param snapshot  must live until then
  void restore(const Snapshot& snapshot) { resumed_ = &snapshot; }
  /// Says good-bye to all partners. @param why  the run failed; empty if it did not
  void end(const std::string& why);
  /// Says what partners hold that the motion has not come to, before the end of a run that did not
  /// fail. Collective.
  void report_left_over(double time);

 private:
  void begin(const model::State& state);
  /// Whether partners answer what the structure does now: not to motions of a record or of points
  /// at rest.
  bool sees_motion() const { return !is_one_way_ && !is_replay_; }
  /// @return false if the structure did not converge with the loads that it began with; true if the
  /// window was accepted, or is cut since no loads fit
  bool make_window(CoupledWindow& window);
  bool repeat(CoupledWindow& window);
  bool repeat_in_parallel(CoupledWindow& window);
  void pose(const std::vector<coupling::Window>& asked);
  Eigen::VectorXd collect(const std::vector<coupling::Window>& asked);
  Eigen::VectorXd ask(const std::vector<coupling::Window>& asked);
  bool is_enough(const Eigen::VectorXd& answer) const;
  bool is_foreseen(const CoupledWindow& window, const CoupledGuess& guess,
                   const CoupledGuess& found) const;
  void watch(CoupledWindow& window, const std::vector<coupling::Window>& asked,
             const Eigen::VectorXd& answer);
  void accept(CoupledWindow& window, int attempts);
  std::string worst_point() const;
  /// Makes the next window shorter because no loads were found for this one.
  /// @param misses  by how much loads and answers differed, attempt by attempt
  void cut(CoupledWindow& window, const std::vector<double>& misses);
  [[noreturn]] void give_up(const CoupledWindow& window, const std::vector<double>& misses) const;
  void begin_side(CoupledSide& side, const model::State& state, bool goes_on);
  std::string explain(const CoupledSide& side) const;
  void balance(const CoupledSide& side, analysis::AnalysisReport& report, double time);
  void close_books(analysis::AnalysisReport& report, double time);
  double latest_end(double start) const;

  const Options& settings_;
  const parallel::Comm& comm_;
  Findings& findings_;
  std::vector<CoupledSide> sides_;
  std::unique_ptr<coupling::Scheme> scheme_;
  coupling::PartScale scale_;  ///< of loads and motions, where both are guessed
  bool is_one_way_ = false;
  bool is_replay_ = false;
  bool is_parallel_ = false;
  const Snapshot* resumed_ = nullptr;

  bool has_begun_ = false;
  Eigen::VectorXd loads_;  ///< of all sides: forces [N], and moments over the size of their port
  int windows_ = 0;
  int attempts_ = 0;
  int most_attempts_ = 0;
  WindowCuts cuts_;
};

}  // namespace culm::simulation
