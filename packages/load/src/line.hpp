/// Structures that loads per length can act on.
#pragma once

#include <culm/model/build_context.hpp>

namespace culm::load {

/// The structure that parameter "Structure" names; null, and an issue, if there is none or it is
/// not a line.
const model::Structure* select_line(const Options& options, model::BuildContext& context);

}  // namespace culm::load
