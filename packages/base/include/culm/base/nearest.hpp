#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace culm {

/// The candidate most like `name`, by edit distance without regard to case; a swap of neighbouring
/// letters counts as one edit. Empty if none is near.
std::string nearest_name(std::string_view name, const std::vector<std::string>& candidates);

/// End of a sentence about a wrong name: " – did you mean 'X'?", or " (allowed: a, b, c)" if no
/// candidate is near, or nothing if there are no candidates.
std::string did_you_mean(std::string_view name, const std::vector<std::string>& candidates);

}  // namespace culm
