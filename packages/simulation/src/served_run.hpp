/// Steps of a motion that another program asks for.
#pragma once

#include <culm/analysis/stepper.hpp>
#include <culm/coupling/conversation.hpp>
#include <culm/coupling/messages.hpp>
#include <culm/simulation/simulation.hpp>

#include "coupled_side.hpp"
#include "run_observer.hpp"

#include <map>
#include <optional>
#include <string>
#include <vector>

namespace culm::simulation {

/// Follows another program over the wire format: it says where steps shall end and under which
/// loads at a port, and culm answers how the port moves. Steps are tried as often as it likes, and
/// any accepted state that it had saved can be gone back to, with results as they were then.
/// Checkpoints are written when it says so, for it must keep itself at the same time. The
/// conversation is the root's; all ranks take the same way. doc/developer/wire_format.md
class ServedRun {
 public:
  /// @param deck  with one analysis of type 'Dynamic'; throws InputError else, and UsageError for a
  /// port that is not there
  ServedRun(const Options& deck, ServeSettings settings, const Ports& ports,
            const parallel::Comm& comm);

  /// Of a run that goes on; before run().
  void restore(const Snapshot& snapshot);
  /// Whether a checkpoint is one of a run that was led.
  static bool has_led(const Snapshot& snapshot);
  /// For a checkpoint; between steps.
  void save(Snapshot& snapshot) const;
  bool serves(const std::string& port) const { return port == settings_.port; }
  /// Waits for the other program and follows it until it says good-bye. Throws PartnerError where
  /// it leaves, is silent for too long, or asks for what makes no sense.
  analysis::AnalysisReport run(analysis::Stepper& stepper, assembly::System& system,
                               const Ports& ports, RunObserver& observer);
  /// Tells it why the run fails; empty if it does not.
  void end(const std::string& why);
  /// Whether the partner left before the end of a motion.
  bool was_left() const { return was_left_; }

 private:
  // What was saved under a number.
  struct Kept {
    Snapshot state = Snapshot(Snapshot::Use::memory);
    Snapshot results;
    double work = 0.0;
  };
  // Where the run is, for one conversation.
  struct Course {
    analysis::Stepper& stepper;
    assembly::System& system;
    port::Port& port;
    RunObserver& observer;
    analysis::StepReport report = {};
    double step_work = 0.0;  // of the open attempt [J]
  };

  void greet(Course& course);
  coupling::Frame hear();
  /// @return whether it goes on
  bool follow(const coupling::Frame& asked, Course& course);
  void attempt(const coupling::Frame& asked, Course& course);
  void accept(Course& course);
  void save(std::uint32_t number, Course& course);
  void restore(std::uint32_t number, Course& course);
  void keep(std::uint32_t number, Course& course);
  void answer(const coupling::Frame& asked, coupling::FrameKind kind, const Course& course);
  template <class Talk>
  void speak(Talk talk);

  ServeSettings settings_;
  const parallel::Comm& comm_;
  std::optional<coupling::Conversation> conversation_;
  coupling::Introduction partner_;
  std::map<std::uint32_t, Kept> kept_;
  double work_ = 0.0;  // on the structure [J]
  bool was_left_ = false;
  int accepted_ = 0;
  int attempts_ = 0;
  std::uint32_t number_ = 0;  ///< that the other program gave the last checkpoint
};

}  // namespace culm::simulation
