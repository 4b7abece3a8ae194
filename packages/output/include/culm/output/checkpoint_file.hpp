/// Checkpoints on disk.
#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <span>
#include <string>
#include <string_view>

namespace culm::output {

/// Writes a checkpoint; the one that has its name becomes previous_checkpoint(path), and the one
/// before that goes. The new one gets its name only when all of it is on the disk, so that at any
/// time one of the two is whole. All functions throw FileError.
class CheckpointFile {
 public:
  /// Begins a file under another name.
  explicit CheckpointFile(const std::filesystem::path& path);
  CheckpointFile(CheckpointFile&&) noexcept;
  CheckpointFile& operator=(CheckpointFile&&) noexcept;
  /// Removes what was not finished.
  ~CheckpointFile();

  /// Its name until it is finished.
  const std::filesystem::path& name() const;
  /// Adds to the content.
  void take(std::string_view piece);
  /// Ends the content, which is a multiple of eight bytes then; numbers follow, which others write,
  /// or fill_room() piece by piece. @return where they begin in the file [bytes]
  std::uint64_t make_room(std::uint64_t count);
  void fill_room(std::span<const double> numbers);
  /// Gives the file its name.
  /// @param sum  of those numbers, by sum_of_numbers()
  void finish(std::uint64_t sum = 0);

 private:
  class Writer;
  std::unique_ptr<Writer> writer_;
  std::filesystem::path path_;
};

/// Writes a checkpoint at once.
void write_checkpoint(const std::filesystem::path& path, std::string_view content);

/// The content of a checkpoint, and the numbers that follow it. Throws FileError if the file is
/// missing, cut off or changed.
std::string read_checkpoint(const std::filesystem::path& path);

/// Where the checkpoint before the last is: `path`.old.
std::filesystem::path previous_checkpoint(const std::filesystem::path& path);

}  // namespace culm::output
