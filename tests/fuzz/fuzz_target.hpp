/// What the fuzz targets share: each feeds bytes to one reader of culm.
#pragma once

#include <culm/base/error.hpp>

#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <string_view>

namespace culm::fuzz {

/// Calls a reader. What a user's file may cause passes: every error but an internal one. Anything
/// else, a foreign exception too, is a bug and ends the process, so that the input is kept.
template <class Reader>
void survive(Reader&& reader) {
  try {
    reader();
  } catch (const InternalError& error) {
    std::fprintf(stderr, "internal error: %s\n", error.what());
    std::abort();
  } catch (const Error&) {
  } catch (const std::exception& error) {
    std::fprintf(stderr, "not an error of culm: %s\n", error.what());
    std::abort();
  }
}

/// A folder of this process in memory, emptied at its end, for readers that open files.
const std::filesystem::path& scratch_folder();

/// Writes a file into the scratch folder, in place of the one of the same name.
std::filesystem::path write_scratch(std::string_view name, std::string_view content);

/// Writes the files that an input holds: a line "%%% NAME" begins each, names with folders are left
/// out. Returns the path of the first one, or nothing.
std::filesystem::path write_files(std::string_view input);

/// Removes all files from the scratch folder.
void empty_scratch();

/// The bytes of an input as text.
inline std::string_view text_of(const unsigned char* data, std::size_t size) {
  return {reinterpret_cast<const char*>(data), size};
}

}  // namespace culm::fuzz
