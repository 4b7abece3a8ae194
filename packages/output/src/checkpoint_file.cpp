#include <culm/base/error.hpp>
#include <culm/base/read_file.hpp>
#include <culm/output/checkpoint_file.hpp>
#include <culm/output/checksum.hpp>

#include "replace_file.hpp"

#include <fcntl.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstdint>
#include <cstring>
#include <limits>
#include <span>
#include <system_error>

namespace culm::output {

namespace {

struct CheckpointHeader {
  std::uint64_t magic;
  std::uint64_t length;    // of what follows
  std::uint64_t checksum;  // of what follows
};
constexpr std::uint64_t checkpoint_magic = 0x31504b434d4c5543;  // "CULMCKP1"

class Descriptor {
 public:
  Descriptor(const std::filesystem::path& path, int flags)
      : number_(::open(path.c_str(), flags | O_CLOEXEC, 0666)) {
    if (number_ < 0) cannot_write(path, errno);
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

// The body of a checkpoint, which grows piece by piece behind its header.
class Body {
 public:
  explicit Body(int file) : file_(file) { write(std::as_bytes(std::span(&header_, 1))); }

  void take(std::string_view piece) {
    while (!piece.empty() && error_ == 0) {
      const std::size_t count = std::min(piece.size(), whole_words - waiting_.size());
      waiting_ += piece.substr(0, count);
      piece.remove_prefix(count);
      if (waiting_.size() == whole_words) flush();
    }
  }
  // @return errno of what could not be written, or 0
  int finish() {
    flush();
    header_.magic = checkpoint_magic;
    note(::lseek(file_, 0, SEEK_SET) == 0);
    write(std::as_bytes(std::span(&header_, 1)));
    note(::fsync(file_) == 0);
    return error_;
  }

 private:
  static constexpr std::size_t whole_words = std::size_t{1} << 20;

  void note(bool is_done) {
    if (!is_done && error_ == 0) error_ = errno;
  }
  void write(std::span<const std::byte> bytes) {
    if (error_ == 0) note(write_all(file_, bytes));
  }
  void flush() {
    const auto bytes = std::as_bytes(std::span(waiting_));
    header_.checksum = checksum(bytes, header_.checksum);
    header_.length += bytes.size();
    write(bytes);
    waiting_.clear();
  }

  int file_;
  int error_ = 0;
  std::string waiting_;
  CheckpointHeader header_{0, 0, checksum({})};  // without its magic number until all is written
};

void write_to_disk(const std::filesystem::path& path,
                   const std::function<void(const TakePiece&)>& content) {
  const Descriptor file(path, O_WRONLY | O_CREAT | O_TRUNC);
  try {
    Body body(file.number());
    content([&](std::string_view piece) { body.take(piece); });
    if (const int error = body.finish(); error != 0) cannot_write(path, error);
  } catch (...) {
    ::unlink(path.c_str());
    throw;
  }
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
  write_checkpoint(path, [&](const TakePiece& take) { take(content); });
}

void write_checkpoint(const std::filesystem::path& path,
                      const std::function<void(const TakePiece&)>& content) {
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
  CheckpointHeader header{};
  if (content.size() >= sizeof header) std::memcpy(&header, content.data(), sizeof header);
  if (header.magic != checkpoint_magic)
    throw FileError(path.string(), "is no checkpoint of this version");
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
