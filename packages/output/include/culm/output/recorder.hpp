#pragma once

#include <culm/base/findings.hpp>
#include <culm/output/analysis_results.hpp>
#include <culm/output/picture_mesh.hpp>
#include <culm/output/recorded.hpp>

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace culm::output {

/// What identifies a run in its result file.
struct RunInfo {
  std::string title;
  std::string version;     ///< of the program
  std::string deck_xml;    ///< the deck with all variables and defaults resolved
  std::string run = {};    ///< identity of the run: no other one has it
  std::string deck = {};   ///< identity of the deck
  std::string model = {};  ///< identity of the model
};

/// Writes the result file of a run, run.h5:
///
/// - attributes run, deck, model: identities
/// - /deck: xml; attributes title, version
/// - /mesh/<structure>: position, director1..3, cell_types, cell_offsets, connectivity,
///   outline_of_node, outline_ends, outline_points; constraints/<number>: nodes, attributes name,
///   type; loads/<number>: nodes, actions, the same attributes; fields, tables and field_rows: what
///   each state holds of the structure, in which table and there from which row to which
/// - /topologies/<group>: cells of structures of one type with the same fields, as XDMF wants them
/// - /steps/000000: tables position, displacement, director1..3, resultants, node and cell arrays,
///   of all structures that have them, one after the other; attributes index, time, number of the
///   analysis, step; if numbers of columns differ there is
///   more than one, as resultants%2F2; whatever Picture::arrays holds in /steps/000000/%arrays
/// - /history/values: one row per add_history(); attributes names, units; first column time, the
/// last
///   two the number of the analysis and the step
/// - /report: text, scalars/<name>, and tables, attributes as below; findings/<number>, with
///   attributes grade ("broken", "warning"), kind, text, analysis, time
/// - /analyses/<analysis>: attributes state, content_sum (a checksum of the rest); one table per
/// name, attributes names, remarks
/// - .../shapes/<structure>: (shape, node, displacement and rotation); imaginary parts in
///   .../shapes_imaginary/<structure>; matrices by their entries row, column, value
///
/// A number that is `absent` stands for none; tables have it as attribute _FillValue.
///
/// In names the characters / : % | are written as %XX.
///
/// What was added takes effect in the file as a whole, by commits: one with each report and each
/// result of an analysis, otherwise one for all that came in a tenth of a second, so that slow
/// steps have one each. A killed process loses what it added since. If it is killed in the
/// microseconds of a commit, run.h5.journal holds the rest of it and recover_run() brings it home.
/// Viewers may read the file meanwhile. Call it on one process only. All functions throw FileError
/// with path and reason.
class Recorder {
 public:
  /// Replaces a file of this name, but only when deck, mesh and empty tables are complete.
  Recorder(const std::filesystem::path& path, const RunInfo& info,
           const std::vector<StructureMesh>& meshes, const std::vector<HistoryColumn>& history);
  /// Goes on with the file of an earlier run, of the same model and history: what is in it up to
  /// the mark is copied to a new file, which then takes its place. Throws FileError if the model is
  /// another one; then nothing has changed.
  /// @param recorded  from find_recorded()
  Recorder(const std::filesystem::path& path, const RunInfo& info,
           const std::vector<StructureMesh>& meshes, const std::vector<HistoryColumn>& history,
           const RecordMark& mark, const Recorded& recorded);
  Recorder(Recorder&&) noexcept;
  Recorder& operator=(Recorder&&) noexcept;
  /// Brings the file up to date and closes it; use close() to learn whether that worked.
  ~Recorder();

  /// Writes one step. Its index must not have been used before.
  /// @param meshes  those that the recorder was made with
  void record(const std::vector<StructureMesh>& meshes, const Picture& picture);

  /// The same of a state that lies on many processes: first what the picture says beside its
  /// structures; then each table of StateTables, by put(), or by the processes that have its rows,
  /// which write them into its room in the file, little-endian, and note(); then the end.
  void begin(const Picture& picture);
  /// Where a table begins in the file [bytes]; none where others must not write.
  std::optional<std::uint64_t> room_of(std::size_t table) const;
  void put(std::size_t table, std::span<const double> values);
  /// @param sum  of the numbers in the room, by sum_of_numbers(); all of them are there
  void note(std::size_t table, std::uint64_t sum);
  void end();

  /// Adds a row to the history.
  void add_history(const HistoryRow& row);

  /// Writes what an analysis found beside its steps, or replaces it.
  void write_results(const AnalysisResults& results);

  /// Writes the final report, or replaces the one that is there.
  /// @param tables  beside it, by their names
  void write_report(const std::string& text, std::span<const NamedScalar> scalars,
                    std::span<const NamedTable> tables = {},
                    std::span<const Finding> findings = {});

  /// Brings the file up to date, and says what it holds then.
  const RecordMark& commit();

  /// Closes the file; nothing can be recorded afterwards.
  void close();

 private:
  class File;
  std::unique_ptr<File> file_;
};

/// Completes the last commit of a run that was killed, from the journal beside its file; to be
/// called before such a file is read. Does nothing if there is no need or if the run is alive.
/// Returns whether it changed the file. Throws FileError.
bool recover_run(const std::filesystem::path& path);

}  // namespace culm::output
