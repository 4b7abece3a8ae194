#pragma once

#include <filesystem>
#include <functional>
#include <string_view>

namespace culm::output {

/// The name under which a file is written before it gets its own.
std::filesystem::path temporary_name(const std::filesystem::path& path);

/// Gives `from` the name `to`; what had that name is gone. Throws FileError.
void move_into_place(const std::filesystem::path& from, const std::filesystem::path& to);

/// Writes a whole file, so that its path holds the old or the new content, never a part. This holds
/// when the process dies; it does not wait for the disk, so a power cut may lose both. Throws
/// FileError.
void replace_file(const std::filesystem::path& path, std::string_view content);
/// The same piece by piece, for content that is better not in memory as a whole.
using Sink = std::function<void(std::string_view piece)>;
void replace_file(const std::filesystem::path& path,
                  const std::function<void(const Sink& sink)>& write);

/// Throws FileError with the system's words for an error.
[[noreturn]] void cannot_write(const std::filesystem::path& path, int error);

/// Creates a folder and those above it if they are missing. Throws FileError.
void make_folder(const std::filesystem::path& path);

}  // namespace culm::output
