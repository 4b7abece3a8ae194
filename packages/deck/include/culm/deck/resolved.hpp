#pragma once

#include <culm/base/options.hpp>

#include <string>

namespace culm::deck {

/// The deck as it is used: ParameterList XML without variables, expressions, units and includes,
/// with all defaults, which carry isDefault="true". Read again, it gives the same options.
std::string resolved(const Options& options);

}  // namespace culm::deck
