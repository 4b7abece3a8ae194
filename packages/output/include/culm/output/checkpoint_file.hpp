/// Checkpoints on disk.
#pragma once

#include <filesystem>
#include <functional>
#include <string>
#include <string_view>

namespace culm::output {

/// Writes a checkpoint; the one that has its name becomes previous_checkpoint(path), and the one
/// before that goes. The new one gets its name only when all of it is on the disk, so that at any
/// time one of the two is whole. Throws FileError.
void write_checkpoint(const std::filesystem::path& path, std::string_view content);
/// The same where content hands over its bytes piece by piece, so that they need not all be in
/// memory.
using TakePiece = std::function<void(std::string_view)>;
void write_checkpoint(const std::filesystem::path& path,
                      const std::function<void(const TakePiece&)>& content);

/// What write_checkpoint was given. Throws FileError if the file is missing, cut off or changed.
std::string read_checkpoint(const std::filesystem::path& path);

/// Where the checkpoint before the last is: `path`.old.
std::filesystem::path previous_checkpoint(const std::filesystem::path& path);

}  // namespace culm::output
