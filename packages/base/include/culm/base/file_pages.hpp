/// Pages of the program and its libraries.
#pragma once

#include <cstddef>

namespace culm {

/// Gives back pages of files that are mapped to be read, and that nothing has changed in memory
/// (Linux; nothing elsewhere). The loader and the start of a run touch most of the program and its
/// libraries, a time loop little; what is needed again comes from what the system keeps of files.
/// Takes some milliseconds. @return bytes that this process no longer holds
std::size_t give_back_file_pages();

}  // namespace culm
