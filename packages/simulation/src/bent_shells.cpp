#include "bent_shells.hpp"

#include <culm/model/layer_source.hpp>
#include <culm/shell/element_batches.hpp>

#include <Eigen/Geometry>
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <span>
#include <utility>
#include <vector>

namespace culm::simulation {
namespace {

using ShellBatch = model::ElementBatch<shell::LinearShell>;

constexpr double notable_share = 0.2;    // of the largest strain
constexpr double smallest_error = 1e-9;  // an error of strains that nothing comes of
constexpr double notable_growth = 1.02;  // a turn that grows by less is not looked up

// None for other structures.
const ShellBatch* batch_of(const model::Structure& structure) {
  if (structure.cells.empty()) return nullptr;
  return dynamic_cast<const ShellBatch*>(structure.cells.front().source);
}

// Of the middle of an element: one along its first side, the third normal to it.
Mat3 axes_of(const model::Cell& cell, const model::Coordinates& q) {
  const auto at = [&](std::size_t a) {
    return Vec3(model::NodeTable::slots(q, cell.nodes[a]).col(0));
  };
  Mat3 axes;
  axes.col(2) = (at(2) - at(0)).cross(at(3) - at(1)).normalized();
  const Vec3 side = at(1) - at(0);
  axes.col(0) = (side - axes.col(2).dot(side) * axes.col(2)).normalized();
  axes.col(1) = axes.col(2).cross(axes.col(0));
  return axes;
}

Mat3 seen_from(int frame, const Mat3& axes, const model::Coordinates& q) {
  return model::NodeTable::slots(q, frame).rightCols<3>().transpose() * axes;
}

// 1 - cos of the largest turn of elements of this rank against the frame, since the reference.
double largest_error(const model::Structure& structure, const ShellBatch& batch,
                     const model::Coordinates& reference, const model::Coordinates& q) {
  double error = 0.0;
  for (const model::Cell& cell : structure.cells) {
    if (!batch.owns(cell.item)) continue;
    const int frame = batch.nodes(cell.item)[0];
    const Mat3 before = seen_from(frame, axes_of(cell, reference), reference);
    const Mat3 now = seen_from(frame, axes_of(cell, q), q);
    error = std::max(error, 0.5 * (3.0 - before.cwiseProduct(now).sum()));
  }
  return error;
}

double largest_strain(const model::Structure& structure, const model::Coordinates& q) {
  double largest = 0.0;
  for (std::size_t i = 0; i < structure.cells.size(); ++i) {
    const auto cell = static_cast<int>(i);
    if (!structure.layers->owns(cell)) continue;
    for (const model::LayerState& state : structure.layers->states(cell, q)) {
      largest = std::max(largest, state.strain.cwiseAbs().maxCoeff());
    }
  }
  return largest;
}

}  // namespace

void BentShells::begin(const model::Model& model) {
  linear_.clear();
  for (const model::Structure& structure : model.structures()) {
    if (batch_of(structure) != nullptr) linear_.push_back(&structure);
  }
}

void BentShells::step(const assembly::System& system, const model::State& state,
                      const std::string& analysis) {
  const model::Coordinates& reference = system.model().nodes().reference();
  for (const model::Structure* structure : linear_) {
    const double error =
        system.comm().max(largest_error(*structure, *batch_of(*structure), reference, state.next));
    Worst& worst = shells_[structure->name];
    if (error <= std::max(smallest_error, notable_growth * worst.looked_at)) continue;
    worst.looked_at = error;
    const double strain = system.comm().max(largest_strain(*structure, state.next));
    if (error <= worst.share() * strain) continue;
    worst = {error, error, strain, state.time, analysis};
  }
}

void BentShells::report(double time, Findings& findings) const {
  for (const auto& [name, worst] : shells_) {
    if (worst.share() <= notable_share) continue;
    findings.warn(
        "bent linear shell",
        fmt::format("shell '{}', of fidelity 'Linear', is bent by {:.3g} rad against its frame at "
                    "{:.6g} of '{}': strains are wrong by up to {:.2g} then, {:.2g} % of the "
                    "largest one, and what stiffens in such a bend is left out; take 'Fidelity' = "
                    "Full, which is good for any turn",
                    name, std::acos(1.0 - worst.error), worst.time, worst.analysis, worst.error,
                    100.0 * worst.share()),
        time);
  }
}

void BentShells::save(Snapshot& snapshot) const {
  std::vector<double> numbers;
  for (const auto& [name, worst] : shells_) {
    const std::string at = "run/bent shells/" + std::to_string(numbers.size());
    snapshot.set_text(at, name);
    snapshot.set_text(at + " in", worst.analysis);
    numbers.insert(numbers.end(), {worst.looked_at, worst.error, worst.strain, worst.time});
  }
  snapshot.set("run/bent shells", std::move(numbers));
}

void BentShells::restore(const Snapshot& snapshot) {
  shells_.clear();
  if (!snapshot.has("run/bent shells")) return;
  const std::span<const double> numbers = snapshot.numbers("run/bent shells");
  for (std::size_t i = 0; i + 4 <= numbers.size(); i += 4) {
    const std::string at = "run/bent shells/" + std::to_string(i);
    shells_[snapshot.text(at)] = {numbers[i], numbers[i + 1], numbers[i + 2], numbers[i + 3],
                                  snapshot.text(at + " in")};
  }
}

}  // namespace culm::simulation
