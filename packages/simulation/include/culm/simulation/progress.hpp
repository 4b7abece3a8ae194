/// A line that tells where a run is.
#pragma once

#include <culm/analysis/analysis.hpp>
#include <culm/base/log.hpp>

#include <chrono>
#include <optional>
#include <string>

namespace culm::simulation {

/// On a terminal one line is rewritten; elsewhere a line is printed at every tenth of the way, so
/// that logs stay short.
class Progress {
 public:
  /// @param terminal whether standard output is one, and the caller the rank that prints
  Progress(const Log& log, bool quiet, bool terminal);

  /// Starts an analysis.
  void begin(const std::string& analysis);
  void show(const analysis::StepReport& report);
  /// Ends the line of a terminal.
  void end();

 private:
  std::string line(const analysis::StepReport& report) const;

  const Log& log_;
  bool quiet_;
  bool terminal_;
  bool open_ = false;
  std::string analysis_;
  int tenth_ = 0;
  std::optional<double> first_;  ///< part of the way that was done before
  std::chrono::steady_clock::time_point start_;
};

}  // namespace culm::simulation
