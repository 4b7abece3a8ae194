#include <culm/base/error.hpp>
#include <culm/base/read_file.hpp>
#include <culm/output/checkpoint_file.hpp>
#include <culm/output/checksum.hpp>

#include "replace_file.hpp"

#include <fcntl.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstdint>
#include <cstring>
#include <limits>
#include <span>
#include <string_view>
#include <system_error>
#include <utility>

namespace culm::output {

namespace {

struct CheckpointHeader {
  std::uint64_t magic;
  std::uint64_t length;    // of the content
  std::uint64_t checksum;  // of the content
  std::uint64_t count;     // of the numbers that follow it
  std::uint64_t sum;       // of the numbers
};
constexpr std::uint64_t checkpoint_magic = 0x32504b434d4c5543;  // "CULMCKP2"

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

// That of the numbers behind the content, in pieces, as they need not lie as numbers do.
std::uint64_t sum_behind(std::string_view bytes, std::size_t length) {
  std::array<double, 1024> piece{};
  std::uint64_t sum = 0;
  const std::size_t count = (bytes.size() - length) / sizeof(double);
  for (std::size_t first = 0; first < count; first += piece.size()) {
    const std::size_t size = std::min(piece.size(), count - first);
    std::memcpy(piece.data(), bytes.data() + length + first * sizeof(double),
                size * sizeof(double));
    sum += sum_of_numbers(std::span(piece).first(size), first);
  }
  return sum;
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

/// The file, which grows piece by piece behind its header.
class CheckpointFile::Writer {
 public:
  explicit Writer(std::filesystem::path name)
      : name_(std::move(name)), file_(name_, O_WRONLY | O_CREAT | O_TRUNC) {
    write(std::as_bytes(std::span(&header_, 1)));
  }
  Writer(const Writer&) = delete;
  Writer& operator=(const Writer&) = delete;
  ~Writer() {
    if (!is_finished_) ::unlink(name_.c_str());
  }

  const std::filesystem::path& name() const { return name_; }
  void take(std::string_view piece) {
    while (!piece.empty()) {
      const std::size_t count = std::min(piece.size(), whole_words - waiting_.size());
      waiting_ += piece.substr(0, count);
      piece.remove_prefix(count);
      if (waiting_.size() == whole_words) flush();
    }
  }
  std::uint64_t make_room(std::uint64_t count) {
    flush();
    const std::uint64_t place = sizeof header_ + header_.length;
    header_.count = count;
    if (count == 0) return place;
    // taken from the disk now: who writes it later may not be told that the disk is full
    errno = ::posix_fallocate(file_.number(), static_cast<off_t>(place),
                              static_cast<off_t>(count * sizeof(double)));
    demand(errno == 0);
    return place;
  }
  void fill_room(std::span<const double> numbers) { write(std::as_bytes(numbers)); }
  void finish(std::uint64_t sum) {
    flush();
    header_.magic = checkpoint_magic;
    header_.sum = sum;
    demand(::lseek(file_.number(), 0, SEEK_SET) == 0);
    write(std::as_bytes(std::span(&header_, 1)));
    demand(::fsync(file_.number()) == 0);
    is_finished_ = true;
  }

 private:
  static constexpr std::size_t whole_words = std::size_t{1} << 20;

  void demand(bool is_done) const {
    if (!is_done) cannot_write(name_, errno);
  }
  void write(std::span<const std::byte> bytes) { demand(write_all(file_.number(), bytes)); }
  void flush() {
    const auto bytes = std::as_bytes(std::span(waiting_));
    header_.checksum = checksum(bytes, header_.checksum);
    header_.length += bytes.size();
    write(bytes);
    waiting_.clear();
  }

  std::filesystem::path name_;
  Descriptor file_;
  bool is_finished_ = false;
  std::string waiting_;
  // without its magic number until all is written
  CheckpointHeader header_{0, 0, checksum({}), 0, 0};
};

CheckpointFile::CheckpointFile(const std::filesystem::path& path)
    : writer_(std::make_unique<Writer>(temporary_name(path))), path_(path) {}
CheckpointFile::CheckpointFile(CheckpointFile&&) noexcept = default;
CheckpointFile& CheckpointFile::operator=(CheckpointFile&&) noexcept = default;
CheckpointFile::~CheckpointFile() = default;

const std::filesystem::path& CheckpointFile::name() const { return writer_->name(); }
void CheckpointFile::take(std::string_view piece) { writer_->take(piece); }
std::uint64_t CheckpointFile::make_room(std::uint64_t count) { return writer_->make_room(count); }
void CheckpointFile::fill_room(std::span<const double> numbers) { writer_->fill_room(numbers); }

void CheckpointFile::finish(std::uint64_t sum) {
  writer_->finish(sum);
  std::error_code ignored;
  if (std::filesystem::exists(path_, ignored)) {
    move_into_place(path_, previous_checkpoint(path_));
  }
  move_into_place(writer_->name(), path_);
  sync_folder(path_);
}

void write_checkpoint(const std::filesystem::path& path, std::string_view content) {
  CheckpointFile file(path);
  file.take(content);
  file.finish();
}

std::string read_checkpoint(const std::filesystem::path& path) {
  // as large as a model and its kept states make it
  std::string content = read_file(path, std::numeric_limits<std::size_t>::max());
  CheckpointHeader header{};
  if (content.size() >= sizeof header) std::memcpy(&header, content.data(), sizeof header);
  if (header.magic != checkpoint_magic)
    throw FileError(path.string(), "is no checkpoint of this version");
  content.erase(0, sizeof header);
  const std::uint64_t whole = header.length + header.count * sizeof(double);
  if (content.size() != whole || header.count > whole / sizeof(double)) {
    throw FileError(path.string(), "was cut off: it holds " + std::to_string(content.size()) +
                                       " of " + std::to_string(whole) + " bytes");
  }
  if (checksum(std::as_bytes(std::span(content)).first(header.length)) != header.checksum ||
      sum_behind(content, header.length) != header.sum) {
    throw FileError(path.string(), "is damaged: its checksum is wrong");
  }
  return content;
}

}  // namespace culm::output
