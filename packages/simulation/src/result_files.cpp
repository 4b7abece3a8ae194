#include <culm/base/error.hpp>
#include <culm/simulation/result_files.hpp>

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

std::vector<output::StructureMesh> meshes_of(const model::Model& model) {
  std::vector<output::StructureMesh> meshes;
  for (const model::Structure& structure : model.structures()) {
    meshes.push_back(mesh_of(structure, model.nodes().reference()));
  }
  return meshes;
}

}  // namespace

ResultFiles::ResultFiles(assembly::System& system, ResultSettings settings,
                         const std::vector<WatchedQuantity>& watched)
    : system_(system), settings_(std::move(settings)), watched_(watched) {
  on_root([this] { open(); });
}

// Runs on rank 0; an error there is an error everywhere.
template <class Work>
void ResultFiles::on_root(Work work) const {
  std::string error;
  if (system_.comm().is_root()) {
    try {
      work();
    } catch (const FileError& e) {
      error = e.what();
    }
  }
  if (system_.comm().size() > 1) error = system_.comm().broadcast(error);
  if (!error.empty()) throw FileError(error);
}

void ResultFiles::open() {
  std::error_code failure;
  std::filesystem::create_directories(settings_.folder, failure);
  if (failure) throw FileError(settings_.folder.string(), failure.message());
  const std::filesystem::path& folder = settings_.folder;
  const auto meshes = meshes_of(system_.model());
  output::Recorder recorder(folder / "run.h5", settings_.info, meshes, columns());
  output::XdmfFile xdmf(folder / "run.xdmf", "run.h5", meshes);
  output::HistoryCsv history(folder / "history.csv", columns());
  std::optional<output::Pictures> pictures;
  if (settings_.pictures) pictures.emplace(folder, "run", meshes);
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
  frame.index = frames_;
  frame.time = time;
  for (const model::Structure& structure : system_.model().structures()) {
    output::StructureState s;
    read_nodes(structure, state.next, s.positions, s.triads);
    for (const model::Cell& cell : structure.cells) {
      s.resultants.emplace_back();
      if (cell.source != nullptr)
        cell.source->resultants(cell.item, state.next, s.resultants.back());
    }
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
  on_root([&] {
    files_->recorder.add_history(time, numbers);
    files_->history.add(time, numbers);
  });
}

void ResultFiles::record(double time, model::State& state) {
  system_.synchronise(state);
  on_root([&] {
    const output::Frame f = frame(time, state);
    files_->recorder.record(f);
    files_->xdmf.add_step(f.index, time);
    if (files_->pictures) files_->pictures->add(f);
  });
  ++frames_;
}

void ResultFiles::finish(const std::string& report,
                         const std::vector<output::NamedScalar>& scalars) {
  on_root([&] {
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
