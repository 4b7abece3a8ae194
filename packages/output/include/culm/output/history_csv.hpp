#pragma once

#include <culm/output/file_identity.hpp>
#include <culm/output/picture_mesh.hpp>

#include <chrono>
#include <cstdio>
#include <filesystem>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace culm::output {

/// History of a run as a text table: first line `time,<name> [unit],...,analysis,step`, then one
/// line per row. Numbers have 17 digits and read back exactly; the cell of one that is `absent` is
/// empty. The file has whole lines at any time. Lines that come within a tenth of a second wait for
/// the next one or for write(): a small model makes thousands in that time.
class HistoryCsv {
 public:
  /// Replaces a file of this name. Throws FileError.
  /// @param rows  of an earlier run, to go on with: as Recorded::history
  HistoryCsv(std::filesystem::path path, const std::vector<HistoryColumn>& columns,
             std::span<const double> rows = {});
  HistoryCsv(HistoryCsv&&) = default;
  /// Writes what is missing; use write() to learn whether that worked.
  ~HistoryCsv();

  /// Throws FileError, as write() does.
  void add(const HistoryRow& row);

  /// Brings the file up to date. Throws FileError, also if somebody removed or replaced it.
  void write();

 private:
  using Clock = std::chrono::steady_clock;
  struct Closer {
    void operator()(std::FILE* file) const { std::fclose(file); }
  };

  void put_pending();
  [[noreturn]] void give_up() const;

  std::filesystem::path path_;
  std::optional<FileIdentity> identity_;
  std::size_t column_count_;
  std::unique_ptr<std::FILE, Closer> file_;
  std::string pending_;  // lines that are not in the file yet
  Clock::time_point written_at_;
};

}  // namespace culm::output
