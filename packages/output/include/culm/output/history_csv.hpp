#pragma once

#include <culm/output/picture_mesh.hpp>

#include <cstdio>
#include <filesystem>
#include <memory>
#include <span>
#include <vector>

namespace culm::output {

/// History of a run as a text table: first line `time,<name> [unit],...`, then one line per step.
/// Numbers have 17 digits and read back exactly; each line is in the file when add() returns.
class HistoryCsv {
 public:
  /// Replaces a file of this name. Throws FileError.
  HistoryCsv(std::filesystem::path path, std::vector<HistoryColumn> columns);

  /// @param time    s
  /// @param values  one per column
  /// Throws FileError.
  void add(double time, std::span<const double> values);

 private:
  struct Closer {
    void operator()(std::FILE* file) const { std::fclose(file); }
  };

  void write(const std::string& line);

  std::filesystem::path path_;
  std::size_t column_count_;
  std::unique_ptr<std::FILE, Closer> file_;
};

}  // namespace culm::output
