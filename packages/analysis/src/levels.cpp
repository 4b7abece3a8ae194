#include "levels.hpp"

#include <fmt/format.h>

#include <vector>

namespace culm::analysis {
namespace {

void check_levels(const Options& options, InputIssues& issues) {
  const std::vector<double>& levels = options.numbers("Levels");
  for (std::size_t i = 1; i < levels.size(); ++i) {
    if (levels[i] > levels[i - 1]) continue;
    issues.add(options.where("Levels"),
               fmt::format("levels must rise, got {:g} after {:g}", levels[i], levels[i - 1]));
    return;
  }
}

}  // namespace

void add_levels(Schema& schema, const std::string& help) {
  schema.add(numbers("Levels", "1", help).at_least(0.0).min_size(1)).check(check_levels);
}

}  // namespace culm::analysis
