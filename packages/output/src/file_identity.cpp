#include <culm/base/error.hpp>
#include <culm/output/file_identity.hpp>

#include <sys/stat.h>

namespace culm::output {

FileIdentity::FileIdentity(const std::filesystem::path& path) {
  struct stat found {};
  if (::stat(path.c_str(), &found) != 0) {
    throw FileError(path.string(), "was removed or renamed while the run was writing it");
  }
  device_ = found.st_dev;
  number_ = found.st_ino;
  length_ = found.st_size;
}

void FileIdentity::check(const std::filesystem::path& path) const {
  const FileIdentity now(path);
  if (now.device_ != device_ || now.number_ != number_) {
    throw FileError(path.string(), "was replaced by another file while the run was writing it");
  }
}

void FileIdentity::check_whole(const std::filesystem::path& path) const {
  check(path);
  if (FileIdentity(path).length_ != length_) {
    throw FileError(path.string(), "was changed while the run was writing it");
  }
}

}  // namespace culm::output
