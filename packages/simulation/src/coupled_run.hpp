/// Steps of a motion together with the partners of a deck.
#pragma once

#include <culm/analysis/stepper.hpp>
#include <culm/coupling/register_coupling.hpp>
#include <culm/coupling/scheme.hpp>
#include <culm/parallel/comm.hpp>
#include <culm/port/port.hpp>

#include <filesystem>
#include <memory>
#include <string>
#include <vector>

namespace culm::simulation {

/// Where a coupling of a deck writes, and what it hears again.
struct CoupledFiles {
  std::filesystem::path folder;
  std::filesystem::path replay = {};  ///< a record; its loads act in place of the only partner's
};

using Ports = std::vector<std::unique_ptr<port::Port>>;

/// Makes the steps of motions so that the loads at ports are what partners answer to the motion of
/// the ports. Partners live on the root; all ranks take the same way.
class CoupledRun {
 public:
  /// @param deck  with a list "Coupling"; it is referred to, as are the others. Throws InputError
  /// for ports that are not there.
  CoupledRun(const Options& deck, const coupling::PartnerRegistry& known, CoupledFiles files,
             const Ports& ports, const parallel::Comm& comm, Findings& findings);
  ~CoupledRun();

  /// Whether loads at this port come from a partner.
  bool serves(const std::string& port) const;
  /// Makes all steps of a motion, as analysis::run does, and reports what crossed the ports. Throws
  /// PartnerError where a partner fails, NumericalError where a window does not fit.
  /// @param ports  of the present model
  analysis::AnalysisReport run(analysis::Stepper& stepper, assembly::System& system,
                               const Ports& ports, analysis::Observer& observer);
  /// Between windows; collective.
  void save(Snapshot& snapshot);
  /// Before run(). @param snapshot  must live until then
  void restore(const Snapshot& snapshot) { resumed_ = &snapshot; }
  /// Says good-bye to all partners. @param why  the run failed; empty if it did not
  void end(const std::string& why);

 private:
  struct Side;   // a port and its partner
  class Window;  // the steps of one window

  void begin(const model::State& state);
  /// @return false if the structure did not converge with the loads that it began with
  bool make_window(Window& window);
  bool repeat(Window& window);
  void ask(coupling::Window& about, Side& side, Eigen::VectorXd& answer);
  Eigen::VectorXd ask(const Window& window, int attempt);
  bool is_enough(const Eigen::VectorXd& answer) const;
  void watch(Window& window, const Eigen::VectorXd& answer);
  void accept(Window& window, int attempts);
  std::string worst_point() const;
  [[noreturn]] void give_up(const Window& window) const;
  void close_books(analysis::AnalysisReport& report, double time);
  double latest_end(double start) const;

  const Options& settings_;
  const parallel::Comm& comm_;
  Findings& findings_;
  std::vector<Side> sides_;
  std::unique_ptr<coupling::Scheme> scheme_;
  bool is_one_way_ = false;
  bool is_replay_ = false;
  const Snapshot* resumed_ = nullptr;

  bool has_begun_ = false;
  Eigen::VectorXd loads_;  ///< of all sides: forces [N], and moments over the size of their port
  int windows_ = 0;
  int attempts_ = 0;
  int most_attempts_ = 0;
};

}  // namespace culm::simulation
