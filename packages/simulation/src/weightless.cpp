#include "weightless.hpp"

#include <culm/base/text.hpp>

#include <algorithm>

namespace culm::simulation {
namespace {

bool has_mass(const Options& entry) {
  return std::ranges::any_of(entry.parameters(), [&](const Options::Parameter& parameter) {
    if (parameter.name == "Mass") return parameter.given;
    if (parameter.name != "Density" && parameter.name != "rhoA") return false;
    return entry.has(parameter.name) && entry.number(parameter.name) > 0.0;
  });
}

std::vector<std::string> names_in(const Options& entry, const char* one, const char* several) {
  std::vector<std::string> names;
  for (const Options::Parameter& parameter : entry.parameters()) {
    if (!parameter.given) continue;
    if (parameter.name == one) names.push_back(entry.text(one));
    if (parameter.name == several) names = entry.texts(several);
  }
  return names;
}

// Of beams by sections, of shells and tubes by materials; bodies have mass.
bool is_weightless(const Options& deck, const Options& structure) {
  const bool is_beam = structure.text("Type") == "Beam";
  const std::vector<std::string> names = is_beam ? names_in(structure, "Section", "Sections")
                                                 : names_in(structure, "Material", "Materials");
  if (names.empty()) return false;
  const Options& list = deck.list(is_beam ? "Sections" : "Materials");
  return std::ranges::none_of(list.entries(), [&](const Options& entry) {
    return std::ranges::find(names, entry.name()) != names.end() && has_mass(entry);
  });
}

}  // namespace

std::vector<std::string> weightless_structures(const Options& deck) {
  if (!deck.list("Masses").entries().empty()) return {};
  std::vector<std::string> weightless;
  for (const Options& structure : deck.list("Structures").entries()) {
    if (is_weightless(deck, structure)) weightless.push_back("'" + structure.name() + "'");
  }
  std::vector<std::string> sentences;
  for (const Options& load : deck.list("Loads").entries()) {
    if (load.text("Type") != "Gravity" || weightless.empty()) continue;
    sentences.push_back("Gravity '" + load.name() + "' does not pull " + join(weightless, ", ") +
                        ": there is no density or mass");
  }
  return sentences;
}

}  // namespace culm::simulation
