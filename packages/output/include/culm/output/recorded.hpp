/// The beginning of a run that is on disk, for a run that goes on with it.
#pragma once

#include <cstddef>
#include <filesystem>
#include <vector>

namespace culm::output {

/// What a result file holds of a run.
struct Recorded {
  struct Step {
    int index = 0;
    double time = 0.0;
  };
  std::vector<Step> steps;      ///< in the order of their indices
  std::vector<double> history;  ///< time and values, row after row
};

/// The first steps and rows of the history of a result file, after recover_run(). Throws FileError
/// if the file cannot be read or holds less.
Recorded find_recorded(const std::filesystem::path& path, std::size_t steps, std::size_t rows);

}  // namespace culm::output
