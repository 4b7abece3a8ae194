/// Everything a run leaves on disk.
#pragma once

#include <culm/analysis/analysis.hpp>
#include <culm/base/snapshot.hpp>
#include <culm/output/history_csv.hpp>
#include <culm/output/recorder.hpp>
#include <culm/output/vtu.hpp>
#include <culm/output/xdmf.hpp>
#include <culm/simulation/quantity.hpp>

#include <cstddef>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace culm::simulation {

/// What to show of the layers of shells, in each recorded state.
struct LayerSettings {
  bool stresses = false;
  bool strains = false;
  std::vector<int> layers = {};  ///< numbers from the bottom, from 0; all if empty
};

/// Reads the list Output / Shell. Throws InputError for layers that no shell has.
LayerSettings read_layer_settings(const Options& shell, const model::Model& model);

/// How far the result file was that belongs to a checkpoint of ResultFiles::save().
output::RecordMark restore_mark(const Snapshot& snapshot);

/// What to write, and how often.
struct ResultSettings {
  std::filesystem::path folder;  ///< which is there
  output::RunInfo info;
  std::vector<std::string> analyses;  ///< their names
  int every = 1;
  bool pictures = true;
  std::size_t most_pictures = 0;  ///< of an analysis, beside its last; 0 for all
  LayerSettings layers = {};
  bool velocities = false;         ///< in each recorded state
  bool constraint_forces = false;  ///< likewise, of steps
};

class PicturePart;
class SharedStates;

/// Writes states, of which each rank has its part, and what rank 0 knows of a run. All functions
/// are called on all ranks, and throw FileError on all of them; record() and add_results()
/// NonFiniteError, too.
class ResultFiles {
 public:
  /// @param drawn  is the geometry of the mesh in the files
  /// @param from   checkpoint of an earlier run, to go on with its files as they were then
  ResultFiles(assembly::System& system, const model::Model& drawn, ResultSettings settings,
              const std::vector<WatchedQuantity>& watched, const Snapshot* from);

  ~ResultFiles();

  /// Goes on with another system of the same structures, and its quantities of the same names.
  void use(assembly::System& system, const std::vector<WatchedQuantity>& watched);

  /// How much there is, under "output/" with checksums, and whose it is, under "run/".
  void save(Snapshot& snapshot);

  /// That of the present analysis.
  const model::Model& model() const { return system_->model(); }
  /// Goes back to what the watched quantities remember, such as turns that were counted, where an
  /// analysis starts from another state than the last one.
  void restore_memories(std::span<const double> memories);

  /// Whether a snapshot is one of save(), by this object or one that it goes on from.
  bool has_saved(const Snapshot& snapshot) const;

  /// Cuts the files back to what there was when this was saved, by this object.
  void go_back(const Snapshot& saved);

  /// The columns of the history.
  std::vector<output::HistoryColumn> columns() const;
  /// The watched quantities of a state.
  std::vector<double> evaluate(model::State& state) const;
  /// What is doubtful about these numbers, in sentences.
  std::vector<std::string> doubts() const { return doubts_of(*watched_); }
  /// Adds a row to the history.
  void add_history(const output::HistoryRow& row);
  /// Brings history.csv up to date, which waits for more rows where they come fast.
  void show_history();
  /// Whether one of the accepted steps behind `before`, up to `step`, is to be recorded.
  bool is_due(int before, int step) const {
    return step / settings_.every > before / settings_.every;
  }
  /// Records a state.
  /// @param analysis, step  as in output::HistoryRow
  /// @param was_solved      whether the last evaluation was that of this state, so that forces of
  ///                        constraints are known
  void record(double time, int analysis, int step, const model::State& state, bool was_solved);
  /// Records what an analysis says at its end; its pictures and tables go to a folder of its name.
  void add_results(const std::string& name, const analysis::AnalysisReport& report,
                   const model::State& state);
  /// Ends the files with the report of the run.
  void finish(const std::string& report, const std::vector<output::NamedScalar>& scalars,
              const std::vector<output::NamedTable>& tables, const std::vector<Finding>& findings);
  /// Paths of the files that a user opens, a line each, and what is not in them.
  std::string listing() const;

 private:
  /// The files; on rank 0 only.
  struct Files {
    output::Recorder recorder;
    output::XdmfFile xdmf;
    output::HistoryCsv history;
    std::optional<output::Pictures> pictures;
    std::optional<output::Pictures> fluid;  ///< what loads in flows show
  };

  std::vector<output::StructureMesh> meshes_in(const model::Model& model) const;
  void make_part();
  void refuse(const output::Picture& picture);
  void draw(output::Picture picture);
  void draw_last();
  void restore_counts(const Snapshot& saved);
  std::optional<output::Pictures> open_pictures(std::vector<output::StructureMesh> meshes) const;
  std::optional<output::Pictures> open_fluid() const;
  void add_fluid(int index, double time, const model::State& state);
  void open(std::vector<output::StructureMesh> meshes);
  void reopen(std::vector<output::StructureMesh> meshes, const output::RecordMark& mark);

  assembly::System* system_;
  const model::Model* drawn_;
  ResultSettings settings_;
  const std::vector<WatchedQuantity>* watched_;
  std::optional<std::vector<int>> read_nodes_;  ///< by what is watched; none: everything
  bool shows_fluid_ = false;                    ///< in pictures of their own
  std::unique_ptr<PicturePart> part_;
  std::unique_ptr<SharedStates> states_;
  std::optional<output::Picture> last_;  ///< this rank's part of a state that has no picture yet
  std::unique_ptr<Files> files_;
  std::vector<std::filesystem::path> analysis_files_;  ///< for listing()
  std::size_t frames_ = 0;
  std::size_t rows_ = 0;  ///< of the history
};

}  // namespace culm::simulation
