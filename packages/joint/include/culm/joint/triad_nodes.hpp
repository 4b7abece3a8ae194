/// Refuses nodes of shells where a triad is needed.
#pragma once

#include <culm/model/build_context.hpp>

#include <string>
#include <vector>

namespace culm::joint {

/// Whether all nodes have triads, which joints turn with; an issue names one that does not.
bool have_triads(const std::vector<int>& nodes, const std::string& parameter,
                 const Options& options, model::BuildContext& context);

}  // namespace culm::joint
