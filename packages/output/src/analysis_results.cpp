#include <culm/output/analysis_results.hpp>

#include "replace_file.hpp"

#include <fmt/format.h>

namespace culm::output {

void write_csv(const std::filesystem::path& path, const NamedTable& table) {
  std::string text = fmt::format("{}", fmt::join(table.columns, ","));
  if (!table.remarks.empty()) text += ",remark";
  text += '\n';
  for (std::size_t i = 0; i < table.rows.size(); ++i) {
    text += fmt::format("{:.17g}", fmt::join(table.rows[i], ","));
    if (!table.remarks.empty()) text += fmt::format(",\"{}\"", table.remarks[i]);
    text += '\n';
  }
  replace_file(path, text);
}

}  // namespace culm::output
