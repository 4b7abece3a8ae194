#include <culm/base/error.hpp>
#include <culm/model/layer_source.hpp>
#include <culm/output/checkpoint_file.hpp>
#include <culm/simulation/result_files.hpp>

#include "analysis_files.hpp"
#include "checkpoints.hpp"
#include "constraint_forces.hpp"
#include "finite.hpp"
#include "fluid_pictures.hpp"
#include "memories.hpp"
#include "on_root.hpp"
#include "other_run.hpp"
#include "pictures.hpp"
#include "shared_states.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cstdint>
#include <string>

namespace culm::simulation {

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

namespace {

// What a collection of pictures lacks.
std::string remark_on(const output::Pictures& pictures) {
  if (pictures.shown() == pictures.added()) return {};
  return fmt::format(" ({} of {} states, see 'Most Pictures'; run.xdmf has all)", pictures.shown(),
                     pictures.added());
}

// A checkpoint holds doubles, which have fewer digits than a checksum.
void save_mark(const output::RecordMark& mark, Snapshot& snapshot) {
  const auto set = [&](const std::string& name, std::uint64_t sum) {
    snapshot.set_text("output/sum of " + name, std::to_string(sum));
  };
  set("head", mark.head_sum);
  set("states", mark.steps_sum);
  set("history", mark.history_sum);
  snapshot.set("output/results", static_cast<double>(mark.results.size()));
  std::size_t i = 0;
  for (const auto& [name, sum] : mark.results) {
    snapshot.set_text(fmt::format("output/result {}", i), name);
    set(fmt::format("result {}", i++), sum);
  }
}

}  // namespace

output::RecordMark restore_mark(const Snapshot& snapshot) {
  const auto sum = [&](const std::string& name) {
    return std::stoull(snapshot.text("output/sum of " + name));
  };
  output::RecordMark mark;
  mark.steps = static_cast<std::size_t>(snapshot.integer("output/states"));
  mark.rows = static_cast<std::size_t>(snapshot.integer("output/rows"));
  mark.head_sum = sum("head");
  mark.steps_sum = sum("states");
  mark.history_sum = sum("history");
  for (int i = 0; i < snapshot.integer("output/results"); ++i) {
    mark.results[snapshot.text(fmt::format("output/result {}", i))] =
        sum(fmt::format("result {}", i));
  }
  return mark;
}

ResultFiles::ResultFiles(assembly::System& system, const model::Model& drawn,
                         ResultSettings settings, const std::vector<WatchedQuantity>& watched,
                         const Snapshot* from)
    : system_(&system),
      drawn_(&drawn),
      settings_(std::move(settings)),
      watched_(&watched),
      read_nodes_(nodes_of(watched)),
      shows_fluid_(settings_.pictures && !fluid_meshes(system.model()).empty()) {
  if (from != nullptr) restore_counts(*from);
  on_root(system_->comm(), [&] {
    from == nullptr ? open(meshes_in(drawn)) : reopen(meshes_in(drawn), restore_mark(*from));
  });
  make_part();
  states_ = std::make_unique<SharedStates>(system_->comm(), settings_.folder / "run.h5");
}

ResultFiles::~ResultFiles() = default;

void ResultFiles::make_part() {
  part_.reset();  // the one before need not be there as well
  part_ = std::make_unique<PicturePart>(*system_, *drawn_, settings_.layers, settings_.velocities);
}

void ResultFiles::restore_counts(const Snapshot& saved) {
  frames_ = static_cast<std::size_t>(saved.integer("output/states"));
  rows_ = static_cast<std::size_t>(saved.integer("output/rows"));
  restore_memories(saved.numbers(memories_key, memories_of(*watched_).size()));
}

void ResultFiles::restore_memories(std::span<const double> memories) {
  simulation::restore_memories(*watched_, memories);
}

bool ResultFiles::has_saved(const Snapshot& snapshot) const {
  return snapshot.has("run/id") && snapshot.text("run/id") == settings_.info.run;
}

void ResultFiles::go_back(const Snapshot& saved) {
  last_.reset();  // save() has drawn what belongs to the snapshot
  on_root(system_->comm(), [&] {
    const output::RecordMark present = files_->recorder.commit();
    files_.reset();
    try {
      reopen(meshes_in(*drawn_), restore_mark(saved));
    } catch (const FileError& error) {
      reopen(meshes_in(*drawn_), present);
      throw UsageError(
          "the results that belong to the snapshot are gone: one of before was restored since, and "
          "cut them back (" +
          std::string(error.what()) + ")");
    }
  });
  states_ = std::make_unique<SharedStates>(system_->comm(), settings_.folder / "run.h5");
  restore_counts(saved);
}

void ResultFiles::save(Snapshot& snapshot) {
  draw_last();
  snapshot.set("output/states", static_cast<double>(frames_));
  snapshot.set("output/rows", static_cast<double>(rows_));
  snapshot.set_text("run/id", settings_.info.run);
  snapshot.set_text("run/deck", settings_.info.deck);
  snapshot.set_text("run/model", settings_.info.model);
  if (files_ != nullptr) {
    save_mark(files_->recorder.commit(), snapshot);
    files_->history.write();
  }
  snapshot.set(memories_key, memories_of(*watched_));
  save_watched(*watched_, snapshot);
}

void ResultFiles::use(assembly::System& system, const std::vector<WatchedQuantity>& watched) {
  hand_over_memories(*watched_, watched);
  draw_last();
  system_ = &system;
  watched_ = &watched;
  make_part();
  read_nodes_ = nodes_of(watched);
}

std::optional<output::Pictures> ResultFiles::open_fluid() const {
  if (!shows_fluid_) return {};
  return output::Pictures(settings_.folder, "run_fluid", fluid_meshes(system_->model()));
}

std::optional<output::Pictures> ResultFiles::open_pictures(
    std::vector<output::StructureMesh> meshes) const {
  if (!settings_.pictures) return {};
  return output::Pictures(settings_.folder, "run", std::move(meshes), settings_.analyses,
                          settings_.most_pictures);
}

std::vector<output::StructureMesh> ResultFiles::meshes_in(const model::Model& model) const {
  std::vector<output::StructureMesh> meshes = meshes_of(model, settings_.layers);
  if (settings_.velocities) show_velocities(meshes);
  return meshes;
}

void ResultFiles::open(std::vector<output::StructureMesh> meshes) {
  const std::filesystem::path& folder = settings_.folder;
  std::error_code failure;
  // those of an earlier run do not belong to the files to come
  const std::filesystem::path checkpoint = checkpoint_path(folder);
  std::filesystem::remove(checkpoint, failure);
  std::filesystem::remove(output::previous_checkpoint(checkpoint), failure);
  output::Recorder recorder(folder / "run.h5", settings_.info, meshes, columns());
  output::XdmfFile xdmf(folder / "run.xdmf", "run.h5", meshes);
  output::HistoryCsv history(folder / "history.csv", columns());
  std::optional<output::Pictures> pictures = open_pictures(std::move(meshes));
  files_ = std::make_unique<Files>(Files{std::move(recorder), std::move(xdmf), std::move(history),
                                         std::move(pictures), open_fluid()});
}

// The result file is cut to the time of the checkpoint; the others are made again from it.
void ResultFiles::reopen(std::vector<output::StructureMesh> meshes,
                         const output::RecordMark& mark) {
  const std::filesystem::path& folder = settings_.folder;
  const auto recorded = output::find_recorded(folder / "run.h5", settings_.info.run, mark);
  output::Recorder recorder(folder / "run.h5", settings_.info, meshes, columns(), mark, recorded);
  output::XdmfFile xdmf(folder / "run.xdmf", "run.h5", meshes);
  output::HistoryCsv history(folder / "history.csv", columns(), recorded.history);
  std::optional<output::Pictures> pictures = open_pictures(std::move(meshes));
  std::optional<output::Pictures> fluid = open_fluid();
  for (const auto& step : recorded.steps) {
    xdmf.add_step(step.index, step.time);
    if (pictures) pictures->add_earlier(step.index, step.time, step.analysis);
    if (fluid) fluid->add_earlier(step.index, step.time);
  }
  files_ = std::make_unique<Files>(Files{std::move(recorder), std::move(xdmf), std::move(history),
                                         std::move(pictures), std::move(fluid)});
}

std::vector<output::HistoryColumn> ResultFiles::columns() const { return columns_of(*watched_); }

std::vector<double> ResultFiles::evaluate(model::State& state) const {
  if (read_nodes_) {
    system_->synchronise(state, *read_nodes_);
  } else {
    system_->synchronise(state);
  }
  return simulation::evaluate(*watched_, *system_, state);
}

void ResultFiles::add_history(const output::HistoryRow& row) {
  on_root(system_->comm(), [&] {
    files_->recorder.add_history(row);
    files_->history.add(row);
  });
  ++rows_;
}

void ResultFiles::show_history() {
  on_root(system_->comm(), [&] { files_->history.write(); });
}

void ResultFiles::record(double time, int analysis, int step, const model::State& state,
                         bool was_solved) {
  output::Picture picture = part_->draw(state.next);
  if (&system_->model() != drawn_) part_->add_reference(picture);
  if (settings_.velocities) part_->add_velocities(state, picture);
  picture.index = static_cast<int>(frames_);
  picture.time = time;
  picture.analysis = analysis;
  picture.step = step;
  const bool shows_forces = settings_.constraint_forces && was_solved;
  if (shows_forces || shows_fluid_) {
    const model::State whole = system_->gather(state);
    on_root(system_->comm(), [&] {
      if (shows_forces) picture.arrays = constraint_forces(*system_, whole);
      if (files_->fluid) add_fluid(picture.index, time, whole);
    });
  }
  if (system_->comm().max(is_finite(picture) ? 0 : 1) != 0) refuse(picture);
  states_->record(*part_, picture, files_ ? &files_->recorder : nullptr);
  on_root(system_->comm(), [&] { files_->xdmf.add_step(picture.index, time); });
  if (settings_.pictures) draw(std::move(picture));
  ++frames_;
}

void ResultFiles::refuse(const output::Picture& picture) {
  const output::Picture whole = part_->gather(picture);
  on_root(system_->comm(), [&] { refuse_infinite(meshes_in(system_->model()), whole); });
}

// Shows a state, or keeps it until it is known whether it is the last of its analysis.
void ResultFiles::draw(output::Picture picture) {
  const parallel::Comm& comm = system_->comm();
  output::Pictures* const pictures = files_ ? &*files_->pictures : nullptr;
  int answer = 0;
  if (pictures != nullptr && pictures->lacks_last_before(picture.analysis)) answer += 1;
  if (pictures != nullptr && pictures->shows_next(picture.analysis)) answer += 2;
  answer = comm.max(answer);
  if ((answer & 1) != 0) draw_last();
  last_.reset();
  const bool is_shown = (answer & 2) != 0;
  if (is_shown) picture = part_->gather(std::move(picture));
  on_root(comm, [&] { pictures->add(picture); });
  if (!is_shown) last_ = std::move(picture);
}

void ResultFiles::draw_last() {
  if (!last_) return;
  const output::Picture whole = part_->gather(std::move(*last_));
  last_.reset();
  on_root(system_->comm(), [&] { files_->pictures->draw(whole); });
}

// Analyses without the loads that show something have no such picture.
void ResultFiles::add_fluid(int index, double time, const model::State& state) {
  output::Picture picture = fluid_picture(system_->model(), state);
  if (picture.structures.empty()) return;
  picture.index = index;
  picture.time = time;
  files_->fluid->add(picture);
}

void ResultFiles::add_results(const std::string& name, const analysis::AnalysisReport& report,
                              const model::State& state) {
  if (report.tables.empty() && report.shapes.empty() && report.matrices.empty()) return;
  const model::State whole = system_->gather(state);
  on_root(system_->comm(), [&] {
    output::AnalysisResults results = results_of(system_->model(), name, report);
    results.state = static_cast<int>(frames_) - 1;
    files_->recorder.write_results(results);
  });
  const auto written =
      write_analysis_files(*system_, name, report, whole, settings_.folder, settings_.pictures);
  analysis_files_.insert(analysis_files_.end(), written.begin(), written.end());
}

void ResultFiles::finish(const std::string& report, const std::vector<output::NamedScalar>& scalars,
                         const std::vector<output::NamedTable>& tables,
                         const std::vector<Finding>& findings) {
  draw_last();
  on_root(system_->comm(), [&] {
    files_->recorder.write_report(report, scalars, tables, findings);
    files_->recorder.close();
    files_->history.write();
    files_->xdmf.write();
    if (files_->pictures) files_->pictures->write();
    if (files_->fluid) files_->fluid->write();
    // whole files of an earlier analysis, which nobody looked at since
    for (const auto& name : analysis_files_) output::FileIdentity(settings_.folder / name);
  });
}

std::string ResultFiles::listing() const {
  std::string text;
  if (!system_->comm().is_root()) return text;
  std::vector<std::filesystem::path> names = {"run.h5",  "run.xdmf",     "history.csv",
                                              "run.pvd", "run_skin.pvd", "run_fluid.pvd"};
  names.insert(names.end(), analysis_files_.begin(), analysis_files_.end());
  for (const auto& name : names) {
    const std::filesystem::path path = settings_.folder / name;
    // pictures are written on demand, and skins only where there are outlines
    if (!std::filesystem::exists(path)) continue;
    text += "\n  " + path.string();
    if (name == "run.pvd" && files_->pictures) text += remark_on(*files_->pictures);
  }
  return text;
}

}  // namespace culm::simulation
