/// Who writes into a folder of results.
#pragma once

#include <filesystem>
#include <string>

namespace culm::output {

/// Makes one process the owner of a folder until it ends, however it ends: an advisory lock on the
/// file `run.lock` in it, which names process and host and is removed at the end. Locks reach other
/// hosts where the file system does (NFS since version 4, or with lockd).
class FolderLock {
 public:
  /// Creates the folder if it is missing. Throws FileError if it cannot be written, and with the
  /// name of the owner if there is one.
  explicit FolderLock(const std::filesystem::path& folder);
  FolderLock(const FolderLock&) = delete;
  FolderLock& operator=(const FolderLock&) = delete;
  ~FolderLock();

  /// Why nothing keeps another process out, on file systems without locks; empty otherwise.
  const std::string& weakness() const { return weakness_; }

 private:
  void take(const std::filesystem::path& folder);
  bool has_name() const;
  void sign() const;

  std::filesystem::path path_;
  int file_ = -1;
  std::string weakness_;
};

}  // namespace culm::output
