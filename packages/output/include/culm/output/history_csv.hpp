#pragma once

#include <culm/output/file_identity.hpp>
#include <culm/output/picture_mesh.hpp>

#include <cstdio>
#include <filesystem>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace culm::output {

/// History of a run as a text table: first line `time,<name> [unit],...,analysis,step`, then one
/// line per row. Numbers have 17 digits and read back exactly; the cell of one that is `absent` is
/// empty. Each line is in the file when add() returns.
class HistoryCsv {
 public:
  /// Replaces a file of this name. Throws FileError.
  /// @param rows  of an earlier run, to go on with: as Recorded::history
  HistoryCsv(std::filesystem::path path, const std::vector<HistoryColumn>& columns,
             std::span<const double> rows = {});

  /// Throws FileError, also if somebody removed or replaced the file.
  void add(const HistoryRow& row);

 private:
  struct Closer {
    void operator()(std::FILE* file) const { std::fclose(file); }
  };

  void write(std::string_view text);
  void flush();
  [[noreturn]] void give_up() const;

  std::filesystem::path path_;
  std::optional<FileIdentity> identity_;
  std::size_t column_count_;
  std::unique_ptr<std::FILE, Closer> file_;
};

}  // namespace culm::output
