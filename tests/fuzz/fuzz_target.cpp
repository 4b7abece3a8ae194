#include "fuzz_target.hpp"

#include <unistd.h>

#include <algorithm>
#include <fstream>
#include <string>

namespace culm::fuzz {
namespace {

// Removes the folder when the process ends.
struct Folder {
  std::filesystem::path path;
  Folder() {
    const std::filesystem::path memory = "/dev/shm";
    const auto base =
        std::filesystem::is_directory(memory) ? memory : std::filesystem::temp_directory_path();
    path = base / ("culm_fuzz_" + std::to_string(::getpid()));
    std::filesystem::create_directories(path);
  }
  Folder(const Folder&) = delete;
  Folder& operator=(const Folder&) = delete;
  ~Folder() {
    std::error_code ignored;
    std::filesystem::remove_all(path, ignored);
  }
};

constexpr std::string_view mark = "%%% ";

// A name that stays in the folder, or none.
std::string plain_name(std::string_view line) {
  std::string name(line.substr(0, 40));
  while (!name.empty() && name.back() == '\r') name.pop_back();
  const bool leaves = name.find_first_of(std::string("/\0", 2)) != std::string::npos;
  return leaves || name == "." || name == ".." ? std::string() : name;
}

}  // namespace

const std::filesystem::path& scratch_folder() {
  static const Folder folder;
  return folder.path;
}

std::filesystem::path write_scratch(std::string_view name, std::string_view content) {
  const std::filesystem::path path = scratch_folder() / name;
  std::ofstream file(path, std::ios::binary | std::ios::trunc);
  file.write(content.data(), static_cast<std::streamsize>(content.size()));
  return path;
}

std::filesystem::path write_files(std::string_view input) {
  std::filesystem::path first;
  while (input.starts_with(mark)) {
    const auto line_end = std::min(input.find('\n'), input.size() - 1);
    const std::string name = plain_name(input.substr(mark.size(), line_end - mark.size()));
    input.remove_prefix(line_end + 1);
    const auto next = input.find("\n%%% ");
    const std::string_view content =
        next == std::string_view::npos ? input : input.substr(0, next + 1);
    input.remove_prefix(content.size());
    if (name.empty()) continue;
    const auto path = write_scratch(name, content);
    if (first.empty()) first = path;
  }
  return first;
}

void empty_scratch() {
  for (const auto& entry : std::filesystem::directory_iterator(scratch_folder())) {
    std::filesystem::remove(entry.path());
  }
}

}  // namespace culm::fuzz
