#include "imperfections.hpp"

#include <culm/base/error.hpp>
#include <culm/output/recorded_shape.hpp>

#include <Eigen/Core>

#include <algorithm>
#include <utility>

namespace culm::simulation {

Schema imperfections_schema() {
  Schema shape("Shape", "A mode or buckling shape of another run, as deviation of the geometry.");
  shape.add(text("Run", "Results folder, or run.h5, of a run with the same structures."))
      .add(text("Analysis", "Name of the analysis that found the shape."))
      .add(integer("Shape", "Number of the shape, from 1.").at_least(1).optional(1))
      .add(number("Amplitude", "m", "Largest displacement of a node; its sign turns the shape."));
  return Schema("Imperfections", "Deviations of the stress-free geometry by name; several add up.")
      .entries(std::move(shape));
}

model::Imperfection read_imperfections(const Options& list) {
  model::Imperfection imperfection;
  for (const Options& entry : list.entries()) {
    const output::RecordedShape shape = output::find_recorded_shape(
        entry.text("Run"), entry.text("Analysis"), entry.integer("Shape"));
    double largest = 0.0;
    for (const auto& [structure, numbers] : shape) {
      for (std::size_t i = 0; i + 5 < numbers.size(); i += 6) {
        largest = std::max(largest, Eigen::Map<const Vec3>(&numbers[i]).norm());
      }
    }
    if (largest == 0.0) throw InputError(entry.where("Shape"), "is a shape that moves no node");
    const double factor = entry.number("Amplitude") / largest;
    for (const auto& [structure, numbers] : shape) {
      std::vector<Vec6> motions;
      for (std::size_t i = 0; i + 5 < numbers.size(); i += 6) {
        motions.emplace_back(factor * Eigen::Map<const Vec6>(&numbers[i]));
      }
      imperfection.add(structure, motions, entry.where());
    }
  }
  return imperfection;
}

}  // namespace culm::simulation
