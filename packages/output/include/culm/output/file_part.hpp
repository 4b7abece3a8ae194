#pragma once

#include <string>
#include <string_view>

namespace culm::output {

/// Part of a file name: letters and digits in lower case, everything else '_'.
std::string file_part(std::string_view name);

}  // namespace culm::output
