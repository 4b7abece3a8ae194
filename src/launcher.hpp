/// A run whose partner comes by MPI, started from outside of it.
#pragma once

#include <sys/resource.h>

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace culm::app {

/// How a run ended, in its own words. Launchers have others: they return the code of the program
/// that died.
struct Verdict {
  int code = 0;
  std::filesystem::path started;  ///< folder of results, where there are some
};

/// Tells who waits for a verdict that MPI has begun. Nowhere where the name is empty.
void tell_begin(const std::filesystem::path& verdict);

/// Leaves a verdict in a file, as a whole. Nowhere where the name is empty.
void leave_verdict(const std::filesystem::path& file, const Verdict& verdict);

/// What is started together.
struct Launch {
  std::vector<std::string> words;  ///< of the command line, with those that asked for a launcher
  std::string partner;             ///< command for the shell
  int ranks = 1;                   ///< so many processes of culm come first
};

/// Starts culm and its partner by mpiexec, with all that this process was given when it began: MPI
/// and culm change some of it.
class Launcher {
 public:
  /// To be made before MPI starts.
  Launcher();

  /// Whether this process was itself started by a launcher.
  bool is_inside() const { return is_inside_; }
  /// Starts both and waits until both have ended. A signal by which a run is told to stop goes on
  /// to culm; a second one, or SIGINT, ends both. Nothing that was started outlasts the call.
  /// @return what culm says; where it had no time to say it, what became of the partner or of the
  /// launcher, with a line on standard error
  Verdict run(const Launch& launch) const;

 private:
  std::vector<std::string> environment_;
  rlimit memory_{};
  bool is_inside_;
};

}  // namespace culm::app
