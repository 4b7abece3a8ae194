#include "model_picture.hpp"

#include <culm/load/catenary_load.hpp>
#include <culm/load/link_load.hpp>

#include "load_watch.hpp"
#include "on_root.hpp"
#include "pictures.hpp"

#include <array>
#include <utility>
#include <vector>

namespace culm::simulation {
namespace {

// Enough to meet the pulses that a user wants to see.
constexpr int sampled_times = 64;

double size_of(const std::vector<Vec6>& actions) {
  double sum = 0.0;
  for (const Vec6& action : actions) sum += action.squaredNorm();
  return sum;
}

std::vector<Vec6> largest_actions(const assembly::System& system, model::Batch& load,
                                  model::State state, double end) {
  std::vector<Vec6> largest;
  double size = 0.0;
  for (int i = 0; i <= sampled_times; ++i) {
    state.time = end * i / sampled_times;
    std::vector<Vec6> actions = system.forces_of(load, state);
    if (size_of(actions) <= size) continue;
    size = size_of(actions);
    largest = std::move(actions);
  }
  return largest;
}

void add_load(const model::Model& model, const model::Batch& load, const std::vector<Vec6>& actions,
              std::vector<output::StructureMesh>& meshes) {
  const model::Effect& effect = load.effect();
  for (std::size_t s = 0; s < meshes.size(); ++s) {
    output::LoadedNodes loaded{effect.name, effect.type, {}, {}};
    const std::vector<int>& nodes = model.structures()[s].nodes;
    for (std::size_t i = 0; i < nodes.size(); ++i) {
      const Vec6& action = actions[static_cast<std::size_t>(nodes[i])];
      if (action.isZero(0.0)) continue;
      loaded.nodes.push_back(static_cast<int>(i));
      loaded.actions.push_back(action);
    }
    if (!loaded.nodes.empty()) meshes[s].loaded.push_back(std::move(loaded));
  }
}

void append(std::vector<double>& values, const std::array<Vec3, 2>& ends) {
  for (const Vec3& end : ends) values.insert(values.end(), end.begin(), end.end());
}

// Springs, dampers, drives and mooring lines: both ends of each.
std::vector<output::NamedArray> links_of(const model::Model& model) {
  std::vector<output::NamedArray> arrays;
  for (const auto& load : model.loads()) {
    std::vector<double> values;
    if (const auto* links = dynamic_cast<const load::LinkLoad*>(load.get())) {
      for (int i = 0; i < links->size(); ++i) {
        append(values, load::reference_ends(model.nodes(), links->link(i)));
      }
    } else if (const auto* lines = dynamic_cast<const load::CatenaryLoad*>(load.get())) {
      for (int i = 0; i < lines->size(); ++i) {
        const double length = lines->line(i).length;
        append(values, load::reference_ends(model.nodes(), lines->link(i), length));
      }
    }
    if (values.empty()) continue;
    const model::Effect& effect = load->effect();
    arrays.push_back({"link: " + effect.type + ": " + effect.name, 6, std::move(values)});
  }
  return arrays;
}

}  // namespace

void draw_model(const assembly::System& system, const output::RunInfo& info, double end,
                const std::filesystem::path& path) {
  const model::Model& model = system.model();
  const model::State state = model.initial_state();
  std::vector<output::StructureMesh> meshes = meshes_of(model, {});
  for (const auto& load : model.loads()) {
    if (!is_given(*load)) continue;
    const auto actions = largest_actions(system, *load, state, end);
    if (!actions.empty()) add_load(model, *load, actions, meshes);
  }
  output::Picture picture = picture_of(system, state.next);
  on_root(system.comm(), [&] {
    output::Recorder recorder(path, info, meshes, {});
    picture.arrays = links_of(model);
    recorder.record(meshes, picture);
    recorder.close();
  });
}

}  // namespace culm::simulation
