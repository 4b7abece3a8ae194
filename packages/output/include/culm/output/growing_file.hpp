#pragma once

#include <culm/output/file_identity.hpp>

#include <chrono>
#include <cstddef>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace culm::output {

/// A text file of head, entries and tail that is complete and readable at any time. It is rewritten
/// through a temporary file, but not for every entry, which would take quadratic time: for the
/// first one, and then when it lacks an eighth of its entries and a tenth of a second, or ten
/// seconds.
class GrowingFile {
 public:
  /// Writes the file without entries. Throws FileError.
  GrowingFile(std::filesystem::path path, std::string head, std::string tail);
  GrowingFile(GrowingFile&&) = default;
  GrowingFile& operator=(GrowingFile&&) = default;
  /// Writes what is missing; use write() to learn whether that worked.
  ~GrowingFile();

  /// Adds an entry. Throws FileError.
  void add(const std::string& entry);

  /// Puts others in the place of all entries, and writes the file. Throws FileError.
  void replace(const std::vector<std::string>& entries);

  /// Brings the file up to date. Throws FileError, also if somebody removed or changed it.
  void write();

 private:
  using Clock = std::chrono::steady_clock;

  bool is_due() const;

  std::filesystem::path path_;
  std::optional<FileIdentity> identity_;  // since it was written first
  std::string head_;
  std::string text_;  // of the entries
  std::string tail_;
  std::size_t entries_ = 0;
  std::size_t written_entries_ = 0;
  Clock::time_point written_at_;
};

}  // namespace culm::output
