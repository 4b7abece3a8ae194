#include "journaled_file.hpp"

#include <culm/output/checksum.hpp>

#include <fcntl.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <system_error>
#include <utility>

namespace culm::output {

namespace {

// What a journal starts with; then per change offset, length and bytes.
struct JournalHeader {
  std::uint64_t magic;
  std::uint64_t length;    // of what follows
  std::uint64_t checksum;  // of what follows
};
constexpr std::uint64_t journal_magic = 0x314c4e4a4d4c5543;  // "CULMJNL1"

[[noreturn]] void fail(const char* action) {
  throw std::system_error(errno, std::generic_category(), action);
}

int open_file(const std::filesystem::path& path, int flags) {
  const int file = ::open(path.c_str(), flags | O_CLOEXEC, 0666);
  if (file < 0) fail("open");
  return file;
}

void write_all(int file, std::uint64_t offset, std::span<const std::byte> bytes) {
  while (!bytes.empty()) {
    const ssize_t count = ::pwrite(file, bytes.data(), bytes.size(), static_cast<off_t>(offset));
    if (count < 0 && errno == EINTR) continue;
    if (count < 0) fail("write");
    bytes = bytes.subspan(static_cast<std::size_t>(count));
    offset += static_cast<std::uint64_t>(count);
  }
}

// Returns the number of bytes up to the end of the file.
std::size_t read_all(int file, std::uint64_t offset, std::span<std::byte> bytes) {
  std::size_t total = 0;
  while (total < bytes.size()) {
    const ssize_t count = ::pread(file, bytes.data() + total, bytes.size() - total,
                                  static_cast<off_t>(offset + total));
    if (count < 0 && errno == EINTR) continue;
    if (count < 0) fail("read");
    if (count == 0) break;
    total += static_cast<std::size_t>(count);
  }
  return total;
}

void put(std::vector<std::byte>& bytes, std::uint64_t number) {
  const auto raw = std::as_bytes(std::span(&number, 1));
  bytes.insert(bytes.end(), raw.begin(), raw.end());
}

std::uint64_t take(std::span<const std::byte>& bytes) {
  std::uint64_t number = 0;
  std::memcpy(&number, bytes.data(), sizeof number);
  bytes = bytes.subspan(sizeof number);
  return number;
}

// The changes of a complete journal; nothing if it is empty or was cut off.
std::vector<std::byte> read_journal(int journal) {
  JournalHeader header{};
  const auto raw = std::as_writable_bytes(std::span(&header, 1));
  if (read_all(journal, 0, raw) < raw.size() || header.magic != journal_magic) return {};
  struct stat status {};
  if (::fstat(journal, &status) != 0) fail("read");
  if (header.length > static_cast<std::uint64_t>(status.st_size)) return {};
  std::vector<std::byte> body(header.length);
  if (read_all(journal, sizeof header, body) < body.size()) return {};
  if (checksum(body) != header.checksum) return {};
  return body;
}

void write_changes(int file, std::span<const std::byte> changes) {
  while (changes.size() >= 2 * sizeof(std::uint64_t)) {
    const std::uint64_t offset = take(changes);
    const std::uint64_t length = std::min<std::uint64_t>(take(changes), changes.size());
    write_all(file, offset, changes.first(length));
    changes = changes.subspan(length);
  }
}

}  // namespace

JournaledFile::JournaledFile(const std::filesystem::path& path, Mode mode)
    : file_(open_file(path, mode == Mode::create ? O_RDWR | O_CREAT | O_TRUNC : O_RDWR)) {
  struct stat status {};
  if (::fstat(file_, &status) != 0) fail("open");
  size_ = committed_size_ = static_cast<std::uint64_t>(status.st_size);
}

JournaledFile::~JournaledFile() {
  ::close(file_);
  if (journal_ < 0) return;
  // Changes that are still in the journal after an error are what recover() needs.
  if (!journal_in_use_) ::unlink(journal_path_.c_str());
  ::close(journal_);
}

std::filesystem::path JournaledFile::journal_path(const std::filesystem::path& file) {
  return file.string() + ".journal";
}

void JournaledFile::start_journal(const std::filesystem::path& file) {
  journal_path_ = journal_path(file);
  journal_ = open_file(journal_path_, O_RDWR | O_CREAT);
  // Some network file systems know no locks; then nothing tells that the file is in use.
  if (::flock(journal_, LOCK_EX | LOCK_NB) != 0 && errno == EWOULDBLOCK) {
    ::close(std::exchange(journal_, -1));
    throw std::system_error(EBUSY, std::generic_category(), "another process writes this file");
  }
  if (::ftruncate(journal_, 0) != 0) fail("start journal");
}

void JournaledFile::read(std::uint64_t offset, std::span<std::byte> bytes) const {
  const std::size_t count = read_all(file_, offset, bytes);
  std::fill(bytes.begin() + static_cast<std::ptrdiff_t>(count), bytes.end(), std::byte{0});
  for (const Change& change : changes_) {
    const std::uint64_t begin = std::max(offset, change.offset);
    const std::uint64_t end = std::min(offset + bytes.size(), change.offset + change.bytes.size());
    if (begin >= end) continue;
    std::memcpy(bytes.data() + (begin - offset), change.bytes.data() + (begin - change.offset),
                end - begin);
  }
}

void JournaledFile::write(std::uint64_t offset, std::span<const std::byte> bytes) {
  if (offset < committed_size_) {
    const auto old = bytes.first(std::min<std::uint64_t>(bytes.size(), committed_size_ - offset));
    changes_.push_back({offset, {old.begin(), old.end()}});
    bytes = bytes.subspan(old.size());
    offset += old.size();
  }
  write_all(file_, offset, bytes);
  size_ = std::max(size_, offset + bytes.size());
}

void JournaledFile::reserve(std::uint64_t offset, std::uint64_t length) {
  errno = ::posix_fallocate(file_, static_cast<off_t>(offset), static_cast<off_t>(length));
  if (errno != 0) fail("extend");
}

void JournaledFile::resize(std::uint64_t size) {
  // Longer at once, since readers refuse a file that ends too early; shorter only in commit().
  if (size > size_ && ::ftruncate(file_, static_cast<off_t>(size)) != 0) fail("extend");
  size_ = size;
}

std::vector<std::byte> JournaledFile::encode_changes() const {
  std::vector<std::byte> body;
  for (const Change& change : changes_) {
    put(body, change.offset);
    put(body, change.bytes.size());
    body.insert(body.end(), change.bytes.begin(), change.bytes.end());
  }
  return body;
}

void JournaledFile::write_journal(std::span<const std::byte> body) {
  const JournalHeader header{journal_magic, body.size(), checksum(body)};
  journal_in_use_ = true;
  // The header last: until it is there, the journal counts as empty.
  write_all(journal_, sizeof header, body);
  write_all(journal_, 0, std::as_bytes(std::span(&header, 1)));
}

void JournaledFile::void_journal() {
  // Much faster than making the file empty.
  const JournalHeader nothing{};
  write_all(journal_, 0, std::as_bytes(std::span(&nothing, 1)));
  journal_in_use_ = false;
}

void JournaledFile::commit() {
  if (!changes_.empty()) {
    const std::vector<std::byte> body = encode_changes();
    if (journal_ >= 0) write_journal(body);
    write_changes(file_, body);
    if (journal_ >= 0) void_journal();
    changes_.clear();
  }
  if (size_ < committed_size_ && ::ftruncate(file_, static_cast<off_t>(size_)) != 0) {
    fail("shorten");
  }
  committed_size_ = size_;
}

bool JournaledFile::recover(const std::filesystem::path& file) {
  const std::filesystem::path path = journal_path(file);
  const int journal = ::open(path.c_str(), O_RDONLY | O_CLOEXEC);
  if (journal < 0 && errno == ENOENT) return false;
  if (journal < 0) fail("open journal");
  bool recovered = false;
  if (::flock(journal, LOCK_EX | LOCK_NB) == 0) {
    const std::vector<std::byte> changes = read_journal(journal);
    if (!changes.empty()) {
      const int target = open_file(file, O_RDWR);
      write_changes(target, changes);
      ::close(target);
      recovered = true;
    }
    ::unlink(path.c_str());
  }
  ::close(journal);
  return recovered;
}

}  // namespace culm::output
