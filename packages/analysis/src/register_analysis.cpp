#include <culm/analysis/register_analysis.hpp>
#include <culm/analysis/statics.hpp>

namespace culm::analysis {

void register_analyses(AnalysisRegistry& registry) {
  registry.add("Static", Statics::schema(), Statics::make);
}

}  // namespace culm::analysis
