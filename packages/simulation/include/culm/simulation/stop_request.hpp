/// When a run is asked to end before its time.
#pragma once

#include <chrono>
#include <optional>
#include <string>

namespace culm::simulation {

/// Listens to SIGTERM and SIGUSR1, which then no longer end the process, and watches the time that
/// the run may take. One that begins while another one lives knows what came since that began: the
/// program listens from its first moment on, and a run counts its time.
class StopRequest {
 public:
  /// Begins to listen and to count.
  /// @param walltime [s]
  explicit StopRequest(std::optional<double> walltime = {});
  /// The last one gives the signals back.
  ~StopRequest();
  StopRequest(const StopRequest&) = delete;
  StopRequest& operator=(const StopRequest&) = delete;

  /// Listens anew while one lives. Wanted now and then: METIS, where it has ordered a matrix, puts
  /// the handler of SIGTERM back as one that acts once and interrupts reading and writing.
  static void listen();
  /// Number of the signal that this process received last; 0 if none.
  int signal() const;
  /// Whether the last signal was SIGTERM, and this process sent it. The launcher, which is the
  /// parent, does so to all its programs when one of them has died, and kills them soon after.
  static bool is_ended_by(int process);
  /// Whether the time is over, or would be `ahead` seconds from now.
  bool is_time_over(double ahead) const;
  /// Since the beginning [s].
  double elapsed() const;

 private:
  std::optional<double> walltime_;
  std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
};

/// Reads the time that a run may take: "90 min", "1.5 h", "5400" (seconds), "90:00", "1:30:00" or
/// "1-12:00:00" with days, as batch systems write it. @return seconds; nothing for an empty text.
/// Throws UsageError.
std::optional<double> find_walltime(const std::string& text);

}  // namespace culm::simulation
