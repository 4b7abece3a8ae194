#pragma once

#include <cstdint>
#include <filesystem>

namespace culm::output {

/// Tells whether a path still names the file that was written there: somebody may remove or replace
/// files of a run that is not yet over.
class FileIdentity {
 public:
  /// Of the file that has this path now. Throws FileError if there is none.
  explicit FileIdentity(const std::filesystem::path& path);

  /// Throws FileError if the path names no file, or another one.
  void check(const std::filesystem::path& path) const;
  /// The same if the file has another length than when it was written, for one that is whole.
  void check_whole(const std::filesystem::path& path) const;

 private:
  std::uint64_t device_ = 0;
  std::uint64_t number_ = 0;  ///< of the file on its device
  std::int64_t length_ = 0;
};

}  // namespace culm::output
