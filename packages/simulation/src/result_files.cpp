#include <culm/base/error.hpp>
#include <culm/model/layer_source.hpp>
#include <culm/output/checkpoint_file.hpp>
#include <culm/simulation/result_files.hpp>

#include "checkpoints.hpp"
#include "on_root.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <unordered_map>

namespace culm::simulation {
namespace {

using model::NodeTable;

void read_nodes(const model::Structure& structure, const model::Coordinates& q,
                std::vector<Vec3>& positions, std::vector<Mat3>& triads) {
  const bool is_shell = !structure.faces.empty();
  for (int node : structure.nodes) {
    const auto slots = NodeTable::slots(q, node);
    positions.emplace_back(slots.col(0));
    triads.emplace_back(slots.rightCols<3>());
    // the one director of a shell node points through the thickness: pictures expect it as d3
    if (is_shell) triads.back().col(2).swap(triads.back().col(0));
  }
}

output::CellType cell_type(std::size_t nodes, bool is_shell) {
  if (is_shell) return output::CellType::quad4;
  return nodes == 1 ? output::CellType::vertex : output::CellType::line;
}

output::StructureMesh mesh_of(const model::Structure& structure,
                              const model::Coordinates& reference) {
  output::StructureMesh mesh;
  mesh.name = structure.name;
  const bool is_shell = !structure.faces.empty();
  mesh.type = is_shell ? "Shell" : structure.nodes.size() == 1 ? "Body" : "Beam";
  if (is_shell) mesh.directors = output::Directors::single;
  mesh.outlines = structure.outlines;
  read_nodes(structure, reference, mesh.positions, mesh.triads);
  std::unordered_map<int, int> number;  // of a node within the structure
  for (int node : structure.nodes) number.emplace(node, static_cast<int>(number.size()));
  for (const model::Cell& cell : structure.cells) {
    output::Cell picture;
    picture.type = cell_type(cell.nodes.size(), is_shell);
    for (int node : cell.nodes) picture.nodes.push_back(number.at(node));
    mesh.cells.push_back(picture);
    if (cell.source != nullptr) mesh.resultant_names = cell.source->resultant_names();
  }
  return mesh;
}

std::vector<int> shown_layers(const model::Structure& structure, const LayerSettings& settings) {
  std::vector<int> shown;
  const bool wanted = settings.stresses || settings.strains;
  for (int layer = 0; wanted && structure.layers != nullptr && layer < structure.layers->layers();
       ++layer) {
    const auto& chosen = settings.layers;
    if (chosen.empty() || std::find(chosen.begin(), chosen.end(), layer) != chosen.end()) {
      shown.push_back(layer);
    }
  }
  return shown;
}

std::vector<output::CellArray> layer_arrays(const model::Structure& structure,
                                            const LayerSettings& settings) {
  std::vector<output::CellArray> arrays;
  for (int layer : shown_layers(structure, settings)) {
    for (const char* height : model::layer_heights) {
      const auto add = [&](const char* what) {
        arrays.push_back({fmt::format("{} layer {} {}", what, layer, height),
                          {"11", "22", "33", "23", "13", "12"}});
      };
      if (settings.stresses) add("stress");
      if (settings.strains) add("strain");
    }
  }
  return arrays;
}

// The numbers of those arrays.
std::vector<std::vector<double>> layer_values(const model::Structure& structure,
                                              const LayerSettings& settings,
                                              const model::Coordinates& q) {
  const std::vector<int> shown = shown_layers(structure, settings);
  std::vector<std::vector<double>> values;
  if (shown.empty()) return values;
  values.resize(layer_arrays(structure, settings).size());
  for (std::size_t cell = 0; cell < structure.cells.size(); ++cell) {
    const std::vector<model::LayerState> states =
        structure.layers->states(static_cast<int>(cell), q);
    auto array = values.begin();
    const auto add = [&](const Vec6& v) {
      array->insert(array->end(), v.begin(), v.end()), ++array;
    };
    for (int layer : shown) {
      for (std::size_t height = 0; height < model::layer_heights.size(); ++height) {
        const model::LayerState& state =
            states[static_cast<std::size_t>(layer) * model::layer_heights.size() + height];
        if (settings.stresses) add(state.stress);
        if (settings.strains) add(state.strain);
      }
    }
  }
  return values;
}

}  // namespace

LayerSettings read_layer_settings(const Options& shell, const model::Model& model) {
  LayerSettings settings{shell.flag("Stresses"), shell.flag("Strains")};
  if (!shell.has("Layers")) return settings;
  settings.layers = shell.integers("Layers");
  int most = 0;
  for (const model::Structure& structure : model.structures()) {
    if (structure.layers != nullptr) most = std::max(most, structure.layers->layers());
  }
  for (int layer : settings.layers) {
    if (layer < most) continue;
    throw InputError(
        shell.where("Layers"),
        fmt::format("no shell has more than {} layers, numbered from 0, got {}", most, layer));
  }
  return settings;
}

std::vector<output::StructureMesh> ResultFiles::meshes() const {
  const model::Model& model = system_.model();
  std::vector<output::StructureMesh> meshes;
  for (const model::Structure& structure : model.structures()) {
    meshes.push_back(mesh_of(structure, model.nodes().reference()));
    meshes.back().cell_arrays = layer_arrays(structure, settings_.layers);
  }
  return meshes;
}

ResultFiles::ResultFiles(assembly::System& system, ResultSettings settings,
                         const std::vector<WatchedQuantity>& watched, const Snapshot* from)
    : system_(system), settings_(std::move(settings)), watched_(watched) {
  if (from != nullptr) {
    frames_ = static_cast<std::size_t>(from->integer("output/states"));
    rows_ = static_cast<std::size_t>(from->integer("output/rows"));
  }
  on_root(system_.comm(), [&] { from == nullptr ? open() : reopen(); });
}

void ResultFiles::save(Snapshot& snapshot) const {
  snapshot.set("output/states", static_cast<double>(frames_));
  snapshot.set("output/rows", static_cast<double>(rows_));
}

void ResultFiles::open() {
  const std::filesystem::path& folder = settings_.folder;
  std::error_code failure;
  std::filesystem::create_directories(folder, failure);
  if (failure) throw FileError(folder.string(), failure.message());
  // those of an earlier run do not belong to the files to come
  const std::filesystem::path checkpoint = checkpoint_path(folder);
  std::filesystem::remove(checkpoint, failure);
  std::filesystem::remove(output::previous_checkpoint(checkpoint), failure);
  const auto meshes = this->meshes();
  output::Recorder recorder(folder / "run.h5", settings_.info, meshes, columns());
  output::XdmfFile xdmf(folder / "run.xdmf", "run.h5", meshes);
  output::HistoryCsv history(folder / "history.csv", columns());
  std::optional<output::Pictures> pictures;
  if (settings_.pictures) pictures.emplace(folder, "run", meshes);
  files_ = std::make_unique<Files>(
      Files{std::move(recorder), std::move(xdmf), std::move(history), std::move(pictures)});
}

// The result file is cut to the time of the checkpoint; the others are made again from it.
void ResultFiles::reopen() {
  const std::filesystem::path& folder = settings_.folder;
  const auto meshes = this->meshes();
  const auto recorded = output::find_recorded(folder / "run.h5", frames_, rows_);
  output::Recorder recorder(folder / "run.h5", settings_.info, meshes, columns(), recorded);
  output::XdmfFile xdmf(folder / "run.xdmf", "run.h5", meshes);
  output::HistoryCsv history(folder / "history.csv", columns(), recorded.history);
  std::optional<output::Pictures> pictures;
  if (settings_.pictures) pictures.emplace(folder, "run", meshes);
  for (const auto& step : recorded.steps) {
    xdmf.add_step(step.index, step.time);
    if (pictures) pictures->add_earlier(step.index, step.time);
  }
  files_ = std::make_unique<Files>(
      Files{std::move(recorder), std::move(xdmf), std::move(history), std::move(pictures)});
}

std::vector<output::HistoryColumn> ResultFiles::columns() const {
  std::vector<output::HistoryColumn> all;
  for (const WatchedQuantity& watched : watched_) {
    for (output::HistoryColumn column : watched.quantity->columns()) {
      column.name = column.name.empty() ? watched.name : watched.name + " " + column.name;
      all.push_back(std::move(column));
    }
  }
  return all;
}

output::Frame ResultFiles::frame(double time, const model::State& state) const {
  output::Frame frame;
  frame.index = static_cast<int>(frames_);
  frame.time = time;
  for (const model::Structure& structure : system_.model().structures()) {
    output::StructureState s;
    read_nodes(structure, state.next, s.positions, s.triads);
    for (const model::Cell& cell : structure.cells) {
      s.resultants.emplace_back();
      if (cell.source != nullptr)
        cell.source->resultants(cell.item, state.next, s.resultants.back());
    }
    s.cell_values = layer_values(structure, settings_.layers, state.next);
    frame.structures.push_back(std::move(s));
  }
  return frame;
}

void ResultFiles::add_history(double time, model::State& state) {
  system_.synchronise(state);
  std::vector<double> numbers;
  for (const WatchedQuantity& watched : watched_) {
    watched.quantity->evaluate(system_, state, numbers);
  }
  on_root(system_.comm(), [&] {
    files_->recorder.add_history(time, numbers);
    files_->history.add(time, numbers);
  });
  ++rows_;
}

void ResultFiles::record(double time, model::State& state) {
  system_.synchronise(state);
  on_root(system_.comm(), [&] {
    const output::Frame f = frame(time, state);
    files_->recorder.record(f);
    files_->xdmf.add_step(f.index, time);
    if (files_->pictures) files_->pictures->add(f);
  });
  ++frames_;
}

void ResultFiles::finish(const std::string& report,
                         const std::vector<output::NamedScalar>& scalars) {
  on_root(system_.comm(), [&] {
    files_->recorder.write_report(report, scalars);
    files_->recorder.close();
    files_->xdmf.write();
    if (files_->pictures) files_->pictures->write();
  });
}

std::vector<std::filesystem::path> ResultFiles::paths() const {
  std::vector<std::filesystem::path> paths;
  for (const char* name : {"run.h5", "run.xdmf", "history.csv", "run.pvd", "run_skin.pvd"}) {
    const std::filesystem::path path = settings_.folder / name;
    // pictures are written on demand, and skins only where there are outlines
    if (system_.comm().is_root() && std::filesystem::exists(path)) paths.push_back(path);
  }
  return paths;
}

}  // namespace culm::simulation
