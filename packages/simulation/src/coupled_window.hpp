/// The steps of one window of a coupling.
#pragma once

#include <culm/analysis/stepper.hpp>
#include <culm/assembly/system.hpp>
#include <culm/base/snapshot.hpp>
#include <culm/coupling/window.hpp>

#include "coupled_side.hpp"
#include "memories.hpp"

#include <optional>
#include <vector>

namespace culm::simulation {

/// Windows that were made shorter because structure and partners did not agree.
struct WindowCuts {
  int count = 0;
  double shortest = 0.0;  ///< that was tried then [s]
  double length = 0.0;    ///< of the parts of a window of several steps [s]; zero: it is whole
  double end = 0.0;       ///< of that window [s]

  void save(Snapshot& snapshot) const;
  void restore(const Snapshot& snapshot);
};

/// One step, or several where the deck has windows: then it goes back by a copy of its start.
/// Collective.
class CoupledWindow {
 public:
  /// @param watched  sees all steps of a window, where it remembers any; must live as long
  /// @param length  of windows of several steps [s]; none: each step is one
  /// @param cuts  those so far; must live as long
  CoupledWindow(analysis::Stepper& stepper, assembly::System& system,
                const std::vector<WatchedQuantity>& watched, std::vector<CoupledSide>& sides,
                std::optional<double> length, WindowCuts& cuts);

  /// Before the first window of an analysis, or of what is left of it.
  void enter();
  /// Begins the next one. @param latest  where it must end [s]
  void start(int number, double latest);
  /// Goes to its end with the loads as they are, from its start. @return whether the structure
  /// converged
  bool go();
  /// To the start, with nothing learnt.
  void go_back();
  /// After go().
  void accept();
  /// To the last accepted state, where something else has failed.
  void abandon();
  /// The structure does not converge, whatever the partners say: gives up, or tries less.
  void fail();
  /// After go(): structure and partners do not agree on this window, so that the next one is to be
  /// shorter. @return false if there is no shorter one: the smallest step of the deck, or of
  /// windows of several steps a thousandth, was tried
  bool cut();

  /// How the points of each side moved.
  std::vector<coupling::Window> about(int attempt) const;
  /// The same if they stood still; before the first attempt.
  std::vector<coupling::Window> at_rest();
  /// The same if their motion changes as it did in the windows before; before the first attempt.
  std::vector<coupling::Window> foreseen();

  double start() const { return start_; }
  double end() const { return end_; }
  double length() const { return end_ - start_; }
  double shortest_step() const { return shortest_step_; }
  bool has_steps() const { return length_.has_value(); }
  const analysis::StepReport& report() const { return report_; }
  /// Those of the attempts before it in the same window.
  const std::vector<analysis::StepReport>& passed() const { return passed_; }

 private:
  double whole_end() const;
  double proposal() const;
  bool go_in_one();
  bool go_in_steps();
  void complete();
  void read(bool is_last);
  std::vector<coupling::Window> unmoved();

  analysis::Stepper& stepper_;
  assembly::System& system_;
  std::vector<CoupledSide>& sides_;
  std::optional<double> length_;
  WindowCuts& cuts_;
  std::optional<MemoryKeeper> keeper_;
  Snapshot memory_ = Snapshot(Snapshot::Use::memory);
  bool is_ahead_ = false;  // steps of the window have been accepted
  bool is_open_ = false;   // its only step has been attempted
  // whether steps that fail are cut: where none failed in the attempt before, the loads are to
  // blame
  bool may_cut_ = true;
  int number_ = 0;
  double start_ = 0.0;
  double end_ = 0.0;
  double latest_ = 0.0;
  double shortest_step_ = 0.0;  ///< of the last attempt [s]
  analysis::StepReport report_;
  std::vector<analysis::StepReport> passed_;
  std::vector<coupling::Window> motions_;
};

}  // namespace culm::simulation
