#include <culm/base/error.hpp>
#include <culm/base/read_file.hpp>

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <system_error>
#include <utility>

namespace culm {
namespace {

std::string unreadable(int error) {
  if (error == ENOENT) return "there is no such file";
  return "cannot be read: " + std::generic_category().message(error);
}

std::string kind_objection(mode_t mode) {
  if (S_ISREG(mode)) return {};
  if (S_ISDIR(mode)) return "is a folder";
  if (S_ISFIFO(mode)) return "is a pipe, not a file";
  if (S_ISSOCK(mode)) return "is a socket, not a file";
  return "is a device, not a file";
}

std::string size_text(std::size_t bytes) {
  constexpr std::size_t megabyte = std::size_t{1} << 20U;
  if (bytes % megabyte == 0) return std::to_string(bytes / megabyte) + " MB";
  return std::to_string(bytes) + " bytes";
}

// Closes itself.
class Descriptor {
 public:
  explicit Descriptor(int number) : number_(number) {}
  Descriptor(const Descriptor&) = delete;
  Descriptor& operator=(const Descriptor&) = delete;
  ~Descriptor() {
    if (number_ >= 0) ::close(number_);
  }

 private:
  int number_;
};

FileText refused(std::string objection) { return {{}, std::move(objection)}; }

}  // namespace

std::string file_objection(const std::string& path) {
  struct stat status {};
  return ::stat(path.c_str(), &status) == 0 ? kind_objection(status.st_mode) : unreadable(errno);
}

FileText find_text(const std::string& path, std::size_t most) {
  std::string objection = file_objection(path);
  if (!objection.empty()) return refused(std::move(objection));
  // without waiting: a pipe may have taken the place of the file since it was looked at
  const int file = ::open(path.c_str(), O_RDONLY | O_CLOEXEC | O_NONBLOCK);
  if (file < 0) return refused(unreadable(errno));
  const Descriptor closing(file);
  std::string text;
  std::string block(std::size_t{1} << 16U, '\0');
  // not by the size it claims: files of /proc claim none, and a file may grow meanwhile
  while (text.size() <= most) {
    const ssize_t count = ::read(file, block.data(), block.size());
    if (count < 0 && errno == EINTR) continue;
    if (count < 0) return refused(unreadable(errno));
    if (count == 0) return {std::move(text)};
    text.append(block, 0, static_cast<std::size_t>(count));
  }
  return refused("is larger than " + size_text(most));
}

std::string read_file(const std::string& path, std::size_t most) {
  FileText found = find_text(path, most);
  if (!found.objection.empty()) throw FileError(path, found.objection);
  return std::move(found.text);
}

std::string read_file(const std::string& path, const Where& asking) {
  FileText found = find_text(path);
  if (found.objection.empty()) return std::move(found.text);
  throw FileError(path, found.objection + "; " + to_string(asking) + " asks for it");
}

}  // namespace culm
