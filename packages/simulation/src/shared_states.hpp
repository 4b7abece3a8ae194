#pragma once

#include <culm/output/recorder.hpp>
#include <culm/output/state_tables.hpp>
#include <culm/parallel/shared_file.hpp>

#include "pictures.hpp"

#include <filesystem>
#include <optional>

namespace culm::simulation {

/// Records states that lie on many ranks: rank 0 makes the tables, and each rank writes its rows.
/// What is small goes through rank 0.
class SharedStates {
 public:
  /// @param path  of the result file
  SharedStates(const parallel::Comm& comm, std::filesystem::path path)
      : comm_(comm), path_(std::move(path)) {}

  /// Collective. Throws FileError on all ranks.
  /// @param part      of this rank
  /// @param picture   drawn by it; its arrays on rank 0
  /// @param recorder  on rank 0
  void record(const PicturePart& part, const output::Picture& picture, output::Recorder* recorder);

 private:
  void record_table(std::size_t table, const output::StateTables& tables, const PicturePart& part,
                    const output::Picture& picture, output::Recorder* recorder);

  parallel::Comm comm_;
  std::filesystem::path path_;
  std::optional<parallel::SharedFile> file_;  ///< open from the first large table on
};

}  // namespace culm::simulation
