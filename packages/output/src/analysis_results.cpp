#include <culm/base/absent.hpp>
#include <culm/output/analysis_results.hpp>

#include "replace_file.hpp"

#include <fmt/format.h>

#include <iterator>

namespace culm::output {

void write_csv(const std::filesystem::path& path, const NamedTable& table) {
  std::string text = fmt::format("{}", fmt::join(table.columns, ","));
  if (!table.remarks.empty()) text += ",remark";
  text += '\n';
  for (std::size_t i = 0; i < table.rows.size(); ++i) {
    for (std::size_t column = 0; column < table.rows[i].size(); ++column) {
      if (column > 0) text += ',';
      const double value = table.rows[i][column];
      if (value != absent) fmt::format_to(std::back_inserter(text), "{:.17g}", value);
    }
    if (!table.remarks.empty()) text += fmt::format(",\"{}\"", table.remarks[i]);
    text += '\n';
  }
  replace_file(path, text);
}

void write_matrix_market(const std::filesystem::path& path, const SparseMatrix& matrix) {
  std::string text = fmt::format("%%MatrixMarket matrix coordinate real general\n{} {} {}\n",
                                 matrix.rows, matrix.columns, matrix.value.size());
  for (std::size_t k = 0; k < matrix.value.size(); ++k) {
    fmt::format_to(std::back_inserter(text), "{} {} {:.17g}\n", matrix.row[k] + 1,
                   matrix.column[k] + 1, matrix.value[k]);
  }
  replace_file(path, text);
}

}  // namespace culm::output
