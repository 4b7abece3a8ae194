#include "finite.hpp"

#include <culm/base/error.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace culm::simulation {
namespace {

[[noreturn]] void refuse(const std::string& what, double value, const std::string& when) {
  throw NonFiniteError(
      fmt::format("{} became {} {}.\n"
                  "Likely cause: a load, stiffness or length beyond the range of numbers.\n"
                  "Try: check units and load functions.",
                  what, std::isnan(value) ? "not a number" : "infinite", when));
}

const double* find_infinite(std::span<const double> values) {
  const auto at =
      std::find_if_not(values.begin(), values.end(), [](double v) { return std::isfinite(v); });
  return at == values.end() ? nullptr : &*at;
}

bool is_finite_node(const output::StructureState& state, std::size_t node) {
  return state.positions[node].allFinite() &&
         (state.triads.empty() || state.triads[node].allFinite());
}

}  // namespace

bool is_finite(std::span<const double> values) { return find_infinite(values) == nullptr; }

bool is_finite(const output::Picture& picture) {
  for (const output::NamedArray& array : picture.arrays) {
    if (!is_finite(array.values)) return false;
  }
  return std::all_of(
      picture.structures.begin(), picture.structures.end(), [](const output::StructureState& s) {
        const auto is_sound = [](const std::vector<double>& values) { return is_finite(values); };
        for (std::size_t node = 0; node < s.positions.size(); ++node) {
          if (!is_finite_node(s, node)) return false;
        }
        return is_finite(s.resultants) &&
               std::all_of(s.node_values.begin(), s.node_values.end(), is_sound) &&
               std::all_of(s.cell_values.begin(), s.cell_values.end(), is_sound);
      });
}

void refuse_infinite(const std::vector<output::HistoryColumn>& columns,
                     std::span<const double> values, const std::string& when) {
  const double* found = find_infinite(values);
  internal_check(found != nullptr, "all values are finite");
  const auto column = static_cast<std::size_t>(found - values.data());
  refuse(fmt::format("The watched '{}'", columns[column].name), *found, when);
}

void refuse_infinite(const std::vector<output::StructureMesh>& meshes,
                     const output::Picture& picture) {
  const std::string when = fmt::format("at {:.8g}", picture.time);
  for (std::size_t s = 0; s < meshes.size(); ++s) {
    const output::StructureMesh& mesh = meshes[s];
    const output::StructureState& state = picture.structures[s];
    for (std::size_t node = 0; node < state.positions.size(); ++node) {
      if (is_finite_node(state, node)) continue;
      refuse(fmt::format("The position of node {} of '{}'", node, mesh.name),
             state.positions[node].sum(), when);
    }
    if (const double* found = find_infinite(state.resultants)) {
      const auto at = static_cast<std::size_t>(found - state.resultants.data());
      const std::size_t width = mesh.resultant_names.size();
      refuse(fmt::format("{} of element {} of '{}'", mesh.resultant_names[at % width], at / width,
                         mesh.name),
             *found, when);
    }
    for (std::size_t a = 0; a < state.node_values.size(); ++a) {
      const double* found = find_infinite(state.node_values[a]);
      if (found == nullptr) continue;
      const auto at = static_cast<std::size_t>(found - state.node_values[a].data());
      refuse(fmt::format("The {} of node {} of '{}'", mesh.node_arrays[a].name,
                         at / static_cast<std::size_t>(mesh.node_arrays[a].columns), mesh.name),
             *found, when);
    }
    for (std::size_t a = 0; a < state.cell_values.size(); ++a) {
      const double* found = find_infinite(state.cell_values[a]);
      if (found == nullptr) continue;
      const auto at = static_cast<std::size_t>(found - state.cell_values[a].data());
      refuse(fmt::format("The {} of element {} of '{}'", mesh.cell_arrays[a].name,
                         at / mesh.cell_arrays[a].columns.size(), mesh.name),
             *found, when);
    }
  }
  for (const output::NamedArray& array : picture.arrays) {
    const double* found = find_infinite(array.values);
    if (found != nullptr) refuse(fmt::format("A number of '{}'", array.name), *found, when);
  }
  throw InternalError("all values are finite");
}

void refuse_infinite(const std::string& analysis, const analysis::AnalysisReport& report) {
  const std::string when = fmt::format("in the analysis '{}'", analysis);
  for (const auto& [name, value] : report.numbers) {
    if (!std::isfinite(value)) refuse(fmt::format("The {}", name), value, when);
  }
  for (const analysis::ReportTable& table : report.tables) {
    for (std::size_t row = 0; row < table.rows.size(); ++row) {
      const double* found = find_infinite(table.rows[row]);
      if (found == nullptr) continue;
      const auto column = static_cast<std::size_t>(found - table.rows[row].data());
      refuse(fmt::format("'{}' in row {} of the table '{}'", table.columns[column], row + 1,
                         table.name),
             *found, when);
    }
  }
}

}  // namespace culm::simulation
