/// The one way in which whole files of users are read.
#pragma once

#include <culm/base/issue.hpp>

#include <cstddef>
#include <string>

namespace culm {

/// What a table, a mesh or a file of another program may hold at most.
inline constexpr std::size_t max_file_bytes = std::size_t{1} << 30U;

/// The text of a file, or why it cannot be read: "is a folder", "there is no such file".
struct FileText {
  std::string text;
  std::string objection = {};  ///< empty if it can be read
};

/// The content of a regular file, or of the one that a symbolic link leads to. There is an
/// objection to anything else (a folder, a pipe, a device: these may have no end), to a file that
/// cannot be read, and to more than `most` bytes.
FileText find_text(const std::string& path, std::size_t most = max_file_bytes);

/// The same; throws FileError with the path and the objection if there is any.
std::string read_file(const std::string& path, std::size_t most = max_file_bytes);

/// The same for a file that a parameter of the deck names; the message has the place of that, too.
std::string read_file(const std::string& path, const Where& asking);

/// Why there is no regular file at a path; empty if there is one.
std::string file_objection(const std::string& path);

}  // namespace culm
