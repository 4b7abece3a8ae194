/// When a run writes a checkpoint, and when it stops.
#pragma once

#include <culm/base/snapshot.hpp>
#include <culm/parallel/comm.hpp>
#include <culm/simulation/stop_request.hpp>

#include <filesystem>
#include <string>

namespace culm::simulation {

/// Where the newest checkpoint of a run is.
std::filesystem::path checkpoint_path(const std::filesystem::path& folder);

/// Decides after each step, for all ranks together.
class Checkpoints {
 public:
  enum class Demand { none, checkpoint, stop };

  /// @param active    whether checkpoints are written; a run can be stopped without
  /// @param interval  from one to the next [s]; longer where writing is slow
  Checkpoints(const parallel::Comm& comm, std::filesystem::path folder, bool active,
              double interval, const StopRequest& request);

  bool are_active() const { return active_; }
  /// Where the run may lose a partner at any time: the first checkpoint is due at once, and each
  /// further one when the run has taken as long again, until this is the interval.
  void begin_early();
  /// To be asked once after each step; collective.
  Demand demand();
  /// Writes a checkpoint. Throws FileError on all ranks.
  void write(const Snapshot& snapshot);
  /// Why the run stops, and how to go on.
  std::string farewell() const;
  /// The command that goes on from the checkpoint.
  std::string way_on() const { return "culm resume " + folder_.string(); }

 private:
  const parallel::Comm& comm_;
  std::filesystem::path folder_;
  bool active_;
  double interval_;
  const StopRequest& request_;
  int reason_ = 0;          ///< why to stop: a signal, or that the time is over
  double last_step_ = 0.0;  ///< when the last step ended [s]
  double longest_step_ = 0.0;
  double listened_ = 0.0;  ///< when signals were last made sure of [s]
  bool is_early_ = false;
  double begun_;  ///< when the run began [s]
  double due_;    ///< when the next checkpoint is due [s]
};

}  // namespace culm::simulation
