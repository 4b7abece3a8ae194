/// The beginning of a run that is on disk, for a run that goes on with it.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <map>
#include <string>
#include <vector>

namespace culm::output {

/// How far a result file has come, and checksums of what is in it up to there.
struct RecordMark {
  std::size_t steps = 0;
  std::size_t rows = 0;        ///< of the history
  std::uint64_t head_sum = 0;  ///< of meshes and names of columns
  std::uint64_t steps_sum = 0;
  std::uint64_t history_sum = 0;
  std::map<std::string, std::uint64_t> results;  ///< sums by names of analyses
};

/// What a result file holds of a run.
struct Recorded {
  struct Step {
    int index = 0;
    double time = 0.0;
    int analysis = 0;
  };
  std::vector<Step> steps;      ///< in the order of their indices
  std::vector<double> history;  ///< time, values, analysis, step, row after row
};

/// What a result file holds up to a mark, after recover_run(). Throws FileError if the file cannot
/// be read, is of another run, holds less, or holds anything else than what was written.
/// @param run  RunInfo::run
Recorded find_recorded(const std::filesystem::path& path, const std::string& run,
                       const RecordMark& mark);

}  // namespace culm::output
