#include <culm/base/error.hpp>
#include <culm/base/text.hpp>
#include <culm/output/folder_lock.hpp>

#include <fcntl.h>
#include <fmt/core.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <system_error>
#include <utility>

namespace culm::output {
namespace {

std::string reason(int error) { return std::generic_category().message(error); }

// What the owner wrote; it may be just about to.
std::string read_owner(int file) {
  std::array<char, 200> text{};
  const ssize_t count = ::pread(file, text.data(), text.size(), 0);
  const std::string_view owner(text.data(), count > 0 ? static_cast<std::size_t>(count) : 0);
  return std::string(trim(owner.substr(0, owner.find('\n'))));
}

}  // namespace

FolderLock::FolderLock(const std::filesystem::path& folder) : path_(folder / "run.lock") {
  std::error_code failure;
  std::filesystem::create_directories(folder, failure);
  if (failure) throw FileError(folder.string(), failure.message());
  take(folder);
  sign();
}

FolderLock::~FolderLock() {
  // first the name, then the lock: a file without a name is nobody's
  ::unlink(path_.c_str());
  ::close(file_);
}

void FolderLock::take(const std::filesystem::path& folder) {
  while (true) {
    file_ = ::open(path_.c_str(), O_RDWR | O_CREAT | O_CLOEXEC, 0666);
    if (file_ < 0) throw FileError(path_.string(), "cannot write: " + reason(errno));
    if (::flock(file_, LOCK_EX | LOCK_NB) == 0) {
      if (has_name()) return;
      // its owner has just ended and removed it
      ::close(std::exchange(file_, -1));
      continue;
    }
    if (errno != EWOULDBLOCK) {
      weakness_ = reason(errno);
      return;
    }
    const std::string owner = read_owner(file_);
    ::close(std::exchange(file_, -1));
    throw FileError(folder.string(),
                    fmt::format("another run writes here{}{}; wait for its end, or take another "
                                "folder",
                                owner.empty() ? "" : ": ", owner));
  }
}

// Whether the locked file is still the one of this name.
bool FolderLock::has_name() const {
  struct stat own {};
  struct stat named {};
  return ::fstat(file_, &own) == 0 && ::stat(path_.c_str(), &named) == 0 &&
         own.st_dev == named.st_dev && own.st_ino == named.st_ino;
}

// For messages only, so it does not matter whether it can be written.
void FolderLock::sign() const {
  std::array<char, 100> host{};
  ::gethostname(host.data(), host.size() - 1);
  const std::string text = fmt::format("process {} on {}\n", ::getpid(), host.data());
  if (::ftruncate(file_, 0) != 0) return;
  [[maybe_unused]] const ssize_t written = ::pwrite(file_, text.data(), text.size(), 0);
}

}  // namespace culm::output
