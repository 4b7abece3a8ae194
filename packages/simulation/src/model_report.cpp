#include "model_report.hpp"

#include <culm/base/text.hpp>
#include <culm/model/mass_properties.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <vector>

namespace culm::simulation {
namespace {

using model::MassProperties;

// A difference of large numbers that is nothing but round-off is shown as zero.
double clean(double value, double size) { return std::abs(value) < 1e-12 * size ? 0.0 : value; }

std::string mass_line(const std::string& name, std::size_t nodes, std::size_t elements,
                      const MassProperties& m) {
  std::string line = fmt::format("{:<24} {:>6} {:>8} {:>12.6g}", name, nodes, elements, m.mass);
  if (m.mass > 0.0) {
    const Vec3 centre = m.centre();
    const double size = std::sqrt(m.second.trace() / m.mass);
    for (int i = 0; i < 3; ++i) line += fmt::format(" {:>12.6g}", clean(centre[i], size));
  }
  return line + "\n";
}

std::string inertia_line(const std::string& name, const MassProperties& m) {
  if (m.mass <= 0.0) return {};
  const Mat3 J = m.inertia();
  const double size = m.second.trace();
  std::string line = fmt::format("{:<24}", name);
  for (const auto& [i, j] : {std::pair{0, 0}, {1, 1}, {2, 2}, {1, 2}, {0, 2}, {0, 1}}) {
    line += fmt::format(" {:>12.6g}", clean(J(i, j), size));
  }
  return line + "\n";
}

constexpr std::size_t most_places = 6;  // on a line

// Nodes by name; of many the first ones.
std::string places_of(const std::vector<int>& nodes, const model::Model& model) {
  std::vector<std::string> names;
  for (int node : nodes) {
    if (names.size() < most_places) names.push_back(model.node_name(node));
  }
  const std::string text = join(names, ", ");
  return nodes.size() > most_places ? fmt::format("{}, … {} nodes", text, nodes.size()) : text;
}

// All nodes of links that belong together, such as those of a rigid beam.
std::vector<int> linked_nodes(const std::vector<model::Constraint>& all, std::size_t first) {
  std::vector<int> nodes = all[first].nodes;
  for (std::size_t i = first + 1; i < all.size(); ++i) {
    if (!all[i].link || all[i].name != all[first].name) continue;
    nodes.push_back(all[i].link->slave);
  }
  return nodes;
}

// Whether an earlier line speaks of a link.
bool is_told(const std::vector<model::Constraint>& all, std::size_t number) {
  return all[number].link &&
         std::any_of(all.begin(), all.begin() + static_cast<std::ptrdiff_t>(number),
                     [&](const auto& c) { return c.link && c.name == all[number].name; });
}

std::string fate_of(const model::Constraint& c, const model::Model& model) {
  const auto& equations = model.equations();
  const auto kept = std::find_if(equations.begin(), equations.end(), [&](const auto& equation) {
    return equation.name == c.name && equation.type == c.type && equation.nodes == c.nodes;
  });
  if (kept == equations.end()) return c.fix || c.link ? "by elimination" : "left out";
  const std::size_t rows = kept->rows.size();
  std::string text = fmt::format("{} equation{}", rows, rows == 1 ? "" : "s");
  if (rows < c.rows.size()) text += fmt::format(", {} left out", c.rows.size() - rows);
  return text;
}

}  // namespace

std::string report_masses(const model::Model& model) {
  const auto masses = model::mass_properties(model, model.initial_state().next);
  std::string text = fmt::format("{:<24} {:>6} {:>8} {:>12} {:>12} {:>12} {:>12}\n", "structure",
                                 "nodes", "elements", "mass [kg]", "centre x [m]", "y", "z");
  std::string inertias;
  MassProperties total;
  std::size_t elements = 0;
  for (std::size_t i = 0; i < masses.size(); ++i) {
    const model::Structure& structure = model.structures()[i];
    text += mass_line(structure.name, structure.nodes.size(), structure.cells.size(), masses[i]);
    inertias += inertia_line(structure.name, masses[i]);
    total += masses[i];
    elements += structure.cells.size();
  }
  text += mass_line("total", static_cast<std::size_t>(model.nodes().size()), elements, total);
  inertias += inertia_line("total", total);
  if (inertias.empty()) return text;
  return text +
         fmt::format("\n{:<24} {:>12} {:>12} {:>12} {:>12} {:>12} {:>12}\n",
                     "inertia about the centre", "xx [kg m^2]", "yy", "zz", "yz", "xz", "xy") +
         inertias;
}

std::string report_constraints(const model::Model& model) {
  if (model.constraints().empty()) return {};
  std::string text = fmt::format("{:<40} {:<28} {}\n", "constraint", "held", "on");
  const auto& all = model.constraints();
  for (std::size_t i = 0; i < all.size(); ++i) {
    const model::Constraint& c = all[i];
    // the structure says what it is made of
    if (c.is_structural || is_told(all, i)) continue;
    text +=
        fmt::format("{:<40} {:<28} {}\n", fmt::format("{} '{}'", c.type, c.name), fate_of(c, model),
                    places_of(c.link ? linked_nodes(all, i) : c.nodes, model));
  }
  return text;
}

std::string report_unknowns(const model::Model& model) {
  const model::UnknownTable& unknowns = model.unknowns();
  const int multipliers = unknowns.num_forces();
  const int of_nodes = unknowns.num_unknowns() - multipliers - unknowns.num_signals();
  // what is left of the equations is independent
  const std::string signals =
      unknowns.num_signals() > 0 ? fmt::format(", {} of signals", unknowns.num_signals()) : "";
  return fmt::format("unknowns: {} ({} multipliers{})\ndegrees of freedom: {}\n",
                     unknowns.num_unknowns(), multipliers, signals, of_nodes - multipliers);
}

}  // namespace culm::simulation
