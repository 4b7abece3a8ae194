#include <culm/base/error.hpp>
#include <culm/base/read_file.hpp>
#include <culm/output/checkpoint_file.hpp>
#include <culm/output/checksum.hpp>

#include "replace_file.hpp"

#include <fcntl.h>
#include <unistd.h>

#include <cerrno>
#include <cstdint>
#include <cstring>
#include <limits>
#include <span>
#include <system_error>

namespace culm::output {

namespace {

struct Header {
  std::uint64_t magic;
  std::uint64_t length;    // of what follows
  std::uint64_t checksum;  // of what follows
};
constexpr std::uint64_t magic = 0x31504b434d4c5543;  // "CULMCKP1"

[[noreturn]] void give_up(const std::filesystem::path& path, int error) {
  throw FileError(path.string(), "cannot write: " + std::generic_category().message(error));
}

class Descriptor {
 public:
  Descriptor(const std::filesystem::path& path, int flags)
      : number_(::open(path.c_str(), flags | O_CLOEXEC, 0666)) {
    if (number_ < 0) give_up(path, errno);
  }
  Descriptor(const Descriptor&) = delete;
  Descriptor& operator=(const Descriptor&) = delete;
  ~Descriptor() { ::close(number_); }
  int number() const { return number_; }

 private:
  int number_;
};

bool write_all(int file, std::span<const std::byte> bytes) {
  while (!bytes.empty()) {
    const ssize_t count = ::write(file, bytes.data(), bytes.size());
    if (count < 0 && errno == EINTR) continue;
    if (count < 0) return false;
    bytes = bytes.subspan(static_cast<std::size_t>(count));
  }
  return true;
}

void write_to_disk(const std::filesystem::path& path, std::string_view content) {
  const Descriptor file(path, O_WRONLY | O_CREAT | O_TRUNC);
  const auto body = std::as_bytes(std::span(content));
  const Header header{magic, body.size(), checksum(body)};
  if (write_all(file.number(), std::as_bytes(std::span(&header, 1))) &&
      write_all(file.number(), body) && ::fsync(file.number()) == 0) {
    return;
  }
  const int error = errno;
  ::unlink(path.c_str());
  give_up(path, error);
}

// Names reach the disk with their folder. Some network file systems refuse this; then there is
// nothing more to do.
void sync_folder(const std::filesystem::path& path) {
  const std::filesystem::path folder = path.parent_path();
  const Descriptor file(folder.empty() ? "." : folder, O_RDONLY | O_DIRECTORY);
  ::fsync(file.number());
}

}  // namespace

std::filesystem::path previous_checkpoint(const std::filesystem::path& path) {
  return path.string() + ".old";
}

void write_checkpoint(const std::filesystem::path& path, std::string_view content) {
  const std::filesystem::path temporary = temporary_name(path);
  write_to_disk(temporary, content);
  std::error_code ignored;
  if (std::filesystem::exists(path, ignored)) move_into_place(path, previous_checkpoint(path));
  move_into_place(temporary, path);
  sync_folder(path);
}

std::string read_checkpoint(const std::filesystem::path& path) {
  // as large as a model and its kept states make it
  std::string content = read_file(path, std::numeric_limits<std::size_t>::max());
  Header header{};
  if (content.size() >= sizeof header) std::memcpy(&header, content.data(), sizeof header);
  if (header.magic != magic) throw FileError(path.string(), "is no checkpoint of this version");
  content.erase(0, sizeof header);
  if (content.size() != header.length) {
    throw FileError(path.string(), "was cut off: it holds " + std::to_string(content.size()) +
                                       " of " + std::to_string(header.length) + " bytes");
  }
  if (checksum(std::as_bytes(std::span(content))) != header.checksum) {
    throw FileError(path.string(), "is damaged: its checksum is wrong");
  }
  return content;
}

}  // namespace culm::output
