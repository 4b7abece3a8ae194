/// Tables and animated shapes of an analysis.
#pragma once

#include <culm/analysis/analysis.hpp>
#include <culm/output/analysis_results.hpp>

#include <filesystem>
#include <string>
#include <vector>

namespace culm::simulation {

/// For the result file.
output::AnalysisResults results_of(const model::Model& model, const std::string& name,
                                   const analysis::AnalysisReport& report);

/// Writes <folder>/analyses/<name>/<table>.csv, and per shape an animation of one period about a
/// state, shape_01.pvd and so on. Collective. Throws FileError.
/// @param state  with all nodes on rank 0
/// @return what a user opens, relative to the folder
std::vector<std::filesystem::path> write_analysis_files(
    const assembly::System& system, const std::string& name, const analysis::AnalysisReport& report,
    const model::State& state, const std::filesystem::path& folder, bool pictures);

}  // namespace culm::simulation
