#include "box.hpp"
#include "mann_files.hpp"
#include "mean_wind.hpp"
#include "tower_influence.hpp"

#include <fmt/format.h>

#include <cmath>

namespace culm::flow {
namespace {

// Of one component over the whole box.
double deviation(const TurbulenceGrid& grid, std::size_t component) {
  double sum = 0.0;
  double squares = 0.0;
  for (std::size_t i = component; i < grid.values.size(); i += 3) {
    sum += grid.values[i];
    squares += static_cast<double>(grid.values[i]) * grid.values[i];
  }
  const double count = static_cast<double>(grid.values.size()) / 3.0;
  const double mean = sum / count;
  return std::sqrt(std::max(squares / count - mean * mean, 0.0));
}

// By which the components have the deviations that are wanted.
std::vector<double> factors_to(const std::vector<double>& wanted, const Where& where,
                               const TurbulenceGrid& grid) {
  std::vector<double> factors;
  for (std::size_t c = 0; c < wanted.size(); ++c) {
    const double found = deviation(grid, c);
    if (found == 0.0 && wanted[c] > 0.0) {
      throw InputError(where, fmt::format("component {} of the box does not vary, so it cannot be "
                                          "scaled",
                                          c + 1));
    }
    factors.push_back(found > 0.0 ? wanted[c] / found : 0.0);
  }
  return factors;
}

void scale(const std::vector<double>& factors, const Where& where, TurbulenceGrid& grid) {
  for (std::size_t i = 0; i < grid.values.size(); ++i) {
    const double scaled = factors[i % factors.size()] * grid.values[i];
    grid.values[i] = static_cast<float>(scaled);
    if (!std::isfinite(grid.values[i])) {
      throw InputError(where, fmt::format("component {} of the box cannot be scaled to {:g} m/s",
                                          i % factors.size() + 1, scaled));
    }
  }
}

// What a point has on the average over the box, along the wind.
void remove_means(TurbulenceGrid& grid) {
  const std::size_t plane = grid.values.size() / static_cast<std::size_t>(grid.planes);
  for (std::size_t point = 0; point < plane; point += 3) {
    double sum = 0.0;
    for (std::size_t i = point; i < grid.values.size(); i += plane) sum += grid.values[i];
    const double mean = sum / grid.planes;
    for (std::size_t i = point; i < grid.values.size(); i += plane) {
      grid.values[i] = static_cast<float>(grid.values[i] - mean);
    }
  }
}

SharedFlow make_mann_box(const Options& options, model::BuildContext&) {
  const std::vector<int>& n = options.integers("Points");
  const std::vector<double>& d = options.numbers("Spacing");
  TurbulenceGrid grid = read_mann(options.texts("File Names"), options.where("File Names"),
                                  {n[0], n[1], n[2]}, {d[0], d[1], d[2]}, options.number("Speed"));
  if (options.has("Factors")) scale(options.numbers("Factors"), options.where("Factors"), grid);
  if (options.has("Deviations")) {
    const Where& where = options.where("Deviations");
    scale(factors_to(options.numbers("Deviations"), where, grid), where, grid);
  }
  if (options.flag("Without Means")) remove_means(grid);
  return add_mean_wind(options, options.number("Speed"), make_box(options, std::move(grid)));
}

}  // namespace

void register_mann_box(FlowRegistry& registry) {
  add_wind(
      registry, "Mann Box",
      box_schema("Mann Box",
                 "Turbulence of three files as HAWC2 and Mann's generator write them, added to a "
                 "mean wind. The box repeats itself along the wind.")
          .add(number("Speed", "m/s", "Mean speed at 'Height', with which the box moves.")
                   .positive())
          .add(number("Height", "m", "Height above the origin, along 'Up', at which 'Speed' holds.")
                   .positive())
          .add_all(mean_profile_schema())
          .add(texts("File Names",
                     "Binary files of the components along the wind, across it and upwards, "
                     "relative to the deck.")
                   .size(3))
          .add(integers("Points", "Points of the box along the wind, across it and upwards.")
                   .size(3)
                   .at_least(2))
          .add(numbers("Spacing", "m", "Distances between them.").size(3).positive())
          .add(numbers("Deviations", "m/s",
                       "Standard deviations of the components over the box, to which they are "
                       "scaled; as the files have them if absent.")
                   .size(3)
                   .non_negative()
                   .optional())
          .add(numbers("Factors", "1", "Factors on the components of the files, instead.")
                   .size(3)
                   .non_negative()
                   .optional())
          .add(flag("Without Means",
                    "Whether the component along the wind loses its mean over the length of the "
                    "box at each point across it, after it was scaled.")
                   .optional(false))
          .check([](const Options& options, InputIssues& issues) {
            if (!options.has("Factors") || !options.has("Deviations")) return;
            issues.add(options.where("Factors"),
                       "stands in place of 'Deviations'; give one of them");
          }),
      make_mann_box);
}

}  // namespace culm::flow
