/// A file that all ranks write together.
#pragma once

#include <culm/base/row_ranges.hpp>
#include <culm/parallel/comm.hpp>

#include <cstdint>
#include <filesystem>
#include <span>

namespace culm::parallel {

/// Each rank writes its rows of tables to their places (MPI-IO). All functions are collective,
/// also the destructor, and throw FileError on all ranks.
class SharedFile {
 public:
  /// Opens a file that is there.
  SharedFile(const Comm& comm, std::filesystem::path path);
  SharedFile(const SharedFile&) = delete;
  SharedFile& operator=(const SharedFile&) = delete;
  /// Closes it.
  ~SharedFile();

  const std::filesystem::path& path() const { return path_; }
  /// Writes rows of a table of doubles.
  /// @param place    where the table begins [bytes]
  /// @param width    numbers in a row
  /// @param rows     those of this rank; no other one has them
  /// @param numbers  row after row
  void write(std::uint64_t place, std::size_t width, std::span<const RowRange> rows,
             std::span<const double> numbers);
  /// Waits until all that was written is on the disk.
  void sync();

 private:
  void check(int status, const char* action) const;

  Comm comm_;
  std::filesystem::path path_;
  MPI_File file_ = MPI_FILE_NULL;
};

}  // namespace culm::parallel
