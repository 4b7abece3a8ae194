/// The analyses this package offers.
#pragma once

#include <culm/analysis/analysis.hpp>
#include <culm/base/registry.hpp>

namespace culm::analysis {

using AnalysisRegistry = Registry<std::unique_ptr<Analysis>>;

void register_analyses(AnalysisRegistry& registry);

}  // namespace culm::analysis
