#include "left_out.hpp"

#include <culm/base/text.hpp>

#include "headings.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace culm::openfast {

void tell_left_out(InputFile& file, std::initializer_list<LeftOut> options, Report& report) {
  for (const LeftOut& option : options) {
    if (!file.has(option.keyword) || to_lower(file.text(option.keyword)) == "default") continue;
    const double value = file.number(option.keyword);
    if (std::abs(value - option.neutral) <= 1e-3 * std::max(1.0, option.neutral)) continue;
    report.add(not_used, fmt::format("{} = {:g}: {}", to_string(file.where(option.keyword)), value,
                                     option.instead));
  }
}

}  // namespace culm::openfast
