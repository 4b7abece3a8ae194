#include "widths_in_media.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace culm::simulation {
namespace {

constexpr double largest_ratio = 1.5;  // a radius in place of a diameter is 2

struct Widths {
  double least = 0.0;
  double largest = 0.0;
};

// Across the centre of the outlines, from corner to corner.
Widths widths_of(const model::Structure& structure) {
  Widths widths;
  for (const std::vector<Eigen::Vector2d>& outline : structure.outlines) {
    if (outline.empty()) return {};
    Eigen::Vector2d centre = Eigen::Vector2d::Zero();
    for (const Eigen::Vector2d& corner : outline) centre += corner / double(outline.size());
    double radius = 0.0;
    for (const Eigen::Vector2d& corner : outline)
      radius = std::max(radius, (corner - centre).norm());
    widths.largest = std::max(widths.largest, 2.0 * radius);
    widths.least = widths.least == 0.0 ? 2.0 * radius : std::min(widths.least, 2.0 * radius);
  }
  return widths;
}

Widths diameters_of(const Options& load) {
  if (load.has("Diameter")) return {load.number("Diameter"), load.number("Diameter")};
  const std::vector<double>& all = load.numbers("Diameters");
  if (all.empty()) return {};
  return {*std::ranges::min_element(all), *std::ranges::max_element(all)};
}

}  // namespace

std::vector<std::string> widths_that_differ(const Options& deck, const Options& analysis,
                                            const model::Model& model) {
  const std::vector<std::string>& inactive = analysis.texts("Inactive");
  std::vector<std::string> sentences;
  for (const Options& load : deck.list("Loads").entries()) {
    const std::string& type = load.text("Type");
    if ((type != "Morison" && type != "Soil") || !load.has("Structure")) continue;
    if (std::ranges::find(inactive, load.name()) != inactive.end()) continue;
    const model::Structure* structure = model.find_structure(load.text("Structure"));
    if (structure == nullptr) continue;
    const Widths section = widths_of(*structure);
    const Widths told = diameters_of(load);
    if (section.largest == 0.0 || told.largest == 0.0) continue;
    const bool is_thick = told.largest > largest_ratio * section.largest;
    if (!is_thick && told.least * largest_ratio >= section.least) continue;
    sentences.push_back(fmt::format(
        "{} '{}' has a diameter of {:.4g} m, but the section of '{}' is {:.4g} m wide: is one of "
        "them a radius, or in another unit?",
        type, load.name(), is_thick ? told.largest : told.least, structure->name,
        is_thick ? section.largest : section.least));
  }
  return sentences;
}

}  // namespace culm::simulation
