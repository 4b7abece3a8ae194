#include "analysis_files.hpp"

#include <culm/base/error.hpp>
#include <culm/output/file_part.hpp>
#include <culm/output/vtu.hpp>

#include "on_root.hpp"
#include "pictures.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <numbers>
#include <optional>

namespace culm::simulation {
namespace {

// Of one period, evenly spaced; the end of the period would repeat the start.
constexpr int frames_per_period = 16;

void animate(const assembly::System& system, const analysis::Shape& shape,
             const std::filesystem::path& folder, const std::string& stem,
             const model::State& state) {
  const model::Model& model = system.model();
  std::optional<output::Pictures> pictures;
  on_root(system.comm(), [&] { pictures.emplace(folder, stem, meshes_of(model, {})); });
  const double factor = analysis::visible_factor(model, shape);
  for (int i = 0; i < frames_per_period; ++i) {
    const double part = static_cast<double>(i) / frames_per_period;
    model::Coordinates q = state.next;
    analysis::displace(model, shape, factor, 2.0 * std::numbers::pi * part, q);
    output::Picture picture = picture_of(system, q);
    picture.index = i;
    picture.time = part;
    on_root(system.comm(), [&] { pictures->add(picture); });
  }
  on_root(system.comm(), [&] { pictures->write(); });
}

void append_rows(std::vector<double>& all, const std::vector<int>& nodes,
                 const std::vector<Vec6>& motions) {
  for (int node : nodes) {
    const Vec6& motion = motions[static_cast<std::size_t>(node)];
    all.insert(all.end(), motion.data(), motion.data() + 6);
  }
}

}  // namespace

output::AnalysisResults results_of(const model::Model& model, const std::string& name,
                                   const analysis::AnalysisReport& report) {
  output::AnalysisResults results;
  results.name = name;
  for (const analysis::ReportTable& table : report.tables) {
    results.tables.push_back({table.name, table.columns, table.rows, table.remarks});
  }
  for (const analysis::ReportMatrix& m : report.matrices) {
    results.matrices.push_back({m.name, m.rows, m.columns, m.row, m.column, m.value});
  }
  if (report.shapes.empty()) return results;
  for (const analysis::Shape& shape : report.shapes) results.shape_names.push_back(shape.name);
  const bool is_complex = std::any_of(report.shapes.begin(), report.shapes.end(),
                                      [](const auto& shape) { return !shape.imaginary.empty(); });
  const std::vector<Vec6> nothing(static_cast<std::size_t>(model.nodes().size()), Vec6::Zero());
  for (const model::Structure& structure : model.structures()) {
    output::StructureShapes shapes;
    shapes.structure = structure.name;
    shapes.shapes = report.shapes.size();
    shapes.nodes = structure.nodes.size();
    for (const analysis::Shape& shape : report.shapes) {
      append_rows(shapes.real, structure.nodes, shape.real);
      if (!is_complex) continue;
      append_rows(shapes.imaginary, structure.nodes,
                  shape.imaginary.empty() ? nothing : shape.imaginary);
    }
    results.shapes.push_back(std::move(shapes));
  }
  return results;
}

std::vector<std::filesystem::path> write_analysis_files(
    const assembly::System& system, const std::string& name, const analysis::AnalysisReport& report,
    const model::State& state, const std::filesystem::path& folder, bool pictures) {
  const std::filesystem::path own = std::filesystem::path("analyses") / output::file_part(name);
  std::vector<std::filesystem::path> files;
  on_root(system.comm(), [&] {
    std::error_code failure;
    std::filesystem::remove_all(folder / own, failure);  // of an earlier run with other modes
    if (!failure) std::filesystem::create_directories(folder / own, failure);
    if (failure) throw FileError((folder / own).string(), failure.message());
    for (const analysis::ReportTable& table : report.tables) {
      files.push_back(own / (table.name + ".csv"));
      output::write_csv(folder / files.back(),
                        {table.name, table.columns, table.rows, table.remarks});
    }
    for (const analysis::ReportMatrix& m : report.matrices) {
      files.push_back(own / (m.name + ".mtx"));
      output::write_matrix_market(folder / files.back(),
                                  {m.name, m.rows, m.columns, m.row, m.column, m.value});
    }
  });
  if (!pictures) return files;
  for (std::size_t i = 0; i < report.shapes.size(); ++i) {
    const std::string stem = fmt::format("shape_{:02}", i + 1);
    animate(system, report.shapes[i], folder / own, stem, state);
    if (i == 0) files.push_back(own / (stem + ".pvd"));
  }
  return files;
}

}  // namespace culm::simulation
