#include "replace_file.hpp"

#include <culm/base/error.hpp>

#include <cerrno>
#include <cstdio>
#include <system_error>

namespace culm::output {

void cannot_write(const std::filesystem::path& path, int error) {
  throw FileError(path.string(), "cannot write: " + std::generic_category().message(error));
}

namespace {

void write_file(const std::filesystem::path& path,
                const std::function<void(const Sink& sink)>& write) {
  std::FILE* file = std::fopen(path.c_str(), "wb");
  if (file == nullptr) cannot_write(path, errno);
  int error = 0;
  try {
    write([&](std::string_view piece) {
      if (error != 0) return;
      if (std::fwrite(piece.data(), 1, piece.size(), file) != piece.size()) error = errno;
    });
  } catch (...) {  // nothing half-written stays, whatever went wrong with the content
    std::fclose(file);
    std::remove(path.c_str());
    throw;
  }
  // A full disk may show only when the last bytes leave the buffer.
  if (std::fclose(file) != 0 && error == 0) error = errno;
  if (error != 0) {
    std::remove(path.c_str());
    cannot_write(path, error);
  }
}

}  // namespace

std::filesystem::path temporary_name(const std::filesystem::path& path) {
  return path.string() + ".part";
}

void move_into_place(const std::filesystem::path& from, const std::filesystem::path& to) {
  std::error_code error;
  std::filesystem::rename(from, to, error);
  if (error) throw FileError(to.string(), "cannot replace: " + error.message());
}

void replace_file(const std::filesystem::path& path,
                  const std::function<void(const Sink& sink)>& write) {
  const std::filesystem::path temporary = temporary_name(path);
  write_file(temporary, write);
  move_into_place(temporary, path);
}

void replace_file(const std::filesystem::path& path, std::string_view content) {
  replace_file(path, [&](const Sink& sink) { sink(content); });
}

void make_folder(const std::filesystem::path& path) {
  std::error_code error;
  std::filesystem::create_directories(path, error);
  if (error) throw FileError(path.string(), "cannot create folder: " + error.message());
}

}  // namespace culm::output
