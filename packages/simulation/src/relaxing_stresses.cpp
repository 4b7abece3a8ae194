#include "relaxing_stresses.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <string_view>

namespace culm::simulation {
namespace {

constexpr std::array<std::string_view, 4> stresses = {"Stress Resultants", "Section Loads",
                                                      "Section Stress", "Layer Stress"};

bool has_branches(const Options& entry) {
  return std::ranges::any_of(entry.lists(), [](const Options& list) {
    return list.name() == "Relaxation" && !list.entries().empty();
  });
}

bool relaxes(const Options& deck, const Options& structure) {
  if (has_branches(structure)) return true;
  if (structure.text("Type") != "Shell") return false;
  std::vector<std::string> names;
  if (structure.has("Materials")) names = structure.texts("Materials");
  if (structure.has("Material")) names.push_back(structure.text("Material"));
  return std::ranges::any_of(deck.list("Materials").entries(), [&](const Options& material) {
    return has_branches(material) && std::ranges::find(names, material.name()) != names.end();
  });
}

}  // namespace

std::vector<std::string> stresses_without_branches(const Options& deck, const Options& analysis) {
  if (analysis.text("Type") != "Dynamic") return {};
  std::vector<std::string> sentences;
  for (const Options& quantity : deck.list("Output").list("History").entries()) {
    const std::string& type = quantity.text("Type");
    if (std::ranges::find(stresses, type) == stresses.end()) continue;
    for (const Options& structure : deck.list("Structures").entries()) {
      if (structure.name() != quantity.text("Structure") || !relaxes(deck, structure)) continue;
      sentences.push_back(fmt::format(
          "{} '{}' is that of the lasting stiffness of '{}': what its branches of 'Relaxation' "
          "carry is not in it; a 'Reaction' has both",
          type, quantity.name(), structure.name()));
    }
  }
  return sentences;
}

}  // namespace culm::simulation
