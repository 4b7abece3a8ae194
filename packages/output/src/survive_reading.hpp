/// Reading of result files that may be damaged.
#pragma once

#include <filesystem>
#include <functional>

namespace culm::output {

/// Tries in a child process what is to be read afterwards: HDF5 trusts some numbers of a file, such
/// as lengths of texts, and over wrong ones it ends the process, or cannot be closed any more.
/// Throws FileError with what the child found.
/// @param read  throws where something is wrong; what it returns is lost
void survive_reading(const std::filesystem::path& path, const std::function<void()>& read);

}  // namespace culm::output
