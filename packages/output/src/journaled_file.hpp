#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <span>
#include <vector>

namespace culm::output {

/// A file whose content changes from one commit() to the next as a whole, even if the process is
/// killed in between or meanwhile.
///
/// What is written beyond the end of the last commit goes to the file at once, because nothing that
/// counts refers to it yet. What overwrites older content waits in memory; commit() first writes it
/// to a journal beside the file, then to its place, then empties the journal. If the process dies
/// between, recover() completes the commit from the journal.
///
/// All functions throw std::system_error.
class JournaledFile {
 public:
  enum class Mode { create, existing };

  /// Creates or empties a file, or opens one for changes. There is no journal yet: commits are not
  /// protected.
  explicit JournaledFile(const std::filesystem::path& path, Mode mode = Mode::create);
  JournaledFile(const JournaledFile&) = delete;
  JournaledFile& operator=(const JournaledFile&) = delete;
  /// Closes the file without a commit and removes the journal.
  ~JournaledFile();

  /// Protects commits from now on. The journal is locked as long as this file is open; if it is
  /// locked already, another process writes the file, which is an error.
  void start_journal(const std::filesystem::path& file);

  /// Bytes as written so far, committed or not; zeros behind the end.
  void read(std::uint64_t offset, std::span<std::byte> bytes) const;
  void write(std::uint64_t offset, std::span<const std::byte> bytes);
  /// Takes room from the disk for what others write.
  void reserve(std::uint64_t offset, std::uint64_t length);
  /// Length of the file from the next commit on.
  void resize(std::uint64_t size);
  std::uint64_t size() const { return size_; }
  /// Its length at the last commit: what is behind counts from the next one on.
  std::uint64_t committed_size() const { return committed_size_; }
  void commit();

  /// Why something could not be written, after which nothing more is; empty if all could.
  const std::string& failure() const { return failure_; }
  void set_failure(std::string reason) { failure_ = std::move(reason); }

  static std::filesystem::path journal_path(const std::filesystem::path& file);

  /// Completes a commit that a dead process left in the journal, if there is one, and removes the
  /// journal. Does nothing while a living process has the file open. Returns whether it wrote.
  static bool recover(const std::filesystem::path& file);

 private:
  std::string failure_;
  struct Change {
    std::uint64_t offset;
    std::vector<std::byte> bytes;
  };

  std::vector<std::byte> encode_changes() const;
  void write_journal(std::span<const std::byte> changes);
  void void_journal();

  int file_ = -1;
  int journal_ = -1;
  bool journal_in_use_ = false;
  std::filesystem::path journal_path_;
  std::uint64_t size_ = 0;            // as the next commit will have it
  std::uint64_t committed_size_ = 0;  // below this, changes must wait
  std::vector<Change> changes_;       // in the order of writing; later ones win
};

}  // namespace culm::output
