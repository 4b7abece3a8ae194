#pragma once

#include <string_view>

namespace culm {

/// Version of culm: major.minor.patch.
inline constexpr std::string_view version = "0.1.0";

}  // namespace culm
