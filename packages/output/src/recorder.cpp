#include <culm/base/absent.hpp>
#include <culm/base/error.hpp>
#include <culm/output/checksum.hpp>
#include <culm/output/recorder.hpp>
#include <culm/output/state_tables.hpp>

#include "content_sum.hpp"
#include "hdf5_copy.hpp"
#include "hdf5_read.hpp"
#include "history_table.hpp"
#include "mesh_group.hpp"
#include "mesh_tables.hpp"
#include "names.hpp"
#include "replace_file.hpp"

#include <chrono>
#include <utility>

namespace culm::output {

namespace {

// Version of the layout of the file, for readers.
constexpr int format_version = 4;

// Of tables: the number that stands for none, as netCDF has it.
constexpr const char* fill_value = "_FillValue";

void write_deck(Hdf5File& file, const RunInfo& info) {
  const Handle group = file.make_group(file.id(), "deck");
  file.set_attribute(group.id(), "title", info.title);
  file.set_attribute(group.id(), "version", info.version);
  file.write(group.id(), "xml", info.deck_xml);
}

Handle make_history(Hdf5File& file, const std::vector<HistoryColumn>& columns) {
  std::vector<std::string> names{"time"};
  std::vector<std::string> units{"s"};
  for (const HistoryColumn& column : columns) {
    names.push_back(column.name);
    units.push_back(column.unit);
  }
  for (const char* place : {"analysis", "step"}) {
    names.emplace_back(place);
    units.emplace_back();
  }
  const Handle group = file.make_group(file.id(), "history");
  Handle table = file.make_growing_table(group.id(), "values", names.size());
  file.set_attribute(table.id(), "names", names);
  file.set_attribute(table.id(), "units", units);
  file.set_attribute(table.id(), fill_value, absent);
  return table;
}

Shape table_shape(std::size_t size, int columns) {
  const auto width = static_cast<hsize_t>(columns);
  return columns == 1 ? Shape{size} : Shape{size / width, width};
}

// Removes a file that was never finished.
class Cleanup {
 public:
  explicit Cleanup(std::filesystem::path path) : path_(std::move(path)) {}
  Cleanup(const Cleanup&) = delete;
  Cleanup& operator=(const Cleanup&) = delete;
  ~Cleanup() {
    std::error_code ignored;
    if (!path_.empty()) std::filesystem::remove(path_, ignored);
  }
  void disarm() { path_.clear(); }

 private:
  std::filesystem::path path_;
};

}  // namespace

/// The open file, its meshes and the place where the history ends.
class Recorder::File {
 public:
  File(const std::filesystem::path& path, const RunInfo& info,
       const std::vector<StructureMesh>& meshes, const std::vector<HistoryColumn>& history)
      : File(temporary_name(path), info, meshes, history, Unnamed{}) {
    give_name(path);
  }

  File(const std::filesystem::path& path, const RunInfo& info,
       const std::vector<StructureMesh>& meshes, const std::vector<HistoryColumn>& history,
       const RecordMark& mark, const Recorded& recorded)
      : File(temporary_name(path), info, meshes, history, Unnamed{}) {
    if (mark_.head_sum != mark.head_sum) {
      throw FileError(path.string(), "is of another model: its meshes or its columns differ");
    }
    copy(Hdf5File::open(path), mark, recorded);
    mark_ = mark;
    give_name(path);
  }

  void begin(const Picture& picture) {
    file_.take_sum();
    const Handle step = file_.make_group(steps_.id(), step_name(picture.index));
    file_.set_attribute(step.id(), "time", picture.time);
    file_.set_attribute(step.id(), "index", picture.index);
    file_.set_attribute(step.id(), "analysis", picture.analysis);
    file_.set_attribute(step.id(), "step", picture.step);
    for (const StateTable& table : tables_.tables()) {
      open_tables_.push_back(file_.make_table(step.id(), table.name, shape_of(table)));
    }
    if (!picture.arrays.empty()) write_arrays(step.id(), picture.arrays);
  }

  std::optional<std::uint64_t> room_of(std::size_t table) const {
    return file_.room_of(open_tables_[table]);
  }

  void put(std::size_t table, std::span<const double> values) {
    file_.fill(open_tables_[table], values);
    note(table, sum_of_numbers(values));
  }

  void note(std::size_t table, std::uint64_t sum) {
    file_.add_to_sum(tables_.tables()[table].name, shape_of(tables_.tables()[table]), sum);
  }

  void end() {
    open_tables_.clear();
    ++mark_.steps;
    mark_.steps_sum += file_.take_sum();
    if (is_due()) commit();
  }

  void add_history(const HistoryRow& row) {
    internal_check(row.values.size() == columns_, "one value per history column");
    pack_history(row, pending_);
    ++mark_.rows;
    mark_.history_sum =
        chain(mark_.history_sum, std::as_bytes(std::span(pending_).last(history_width(columns_))));
    if (is_due()) commit();
  }

  // Brings the file up to date.
  void commit() {
    const std::size_t width = history_width(columns_);
    const std::size_t rows = pending_.size() / width;
    if (rows > 0) file_.append_rows(history_.id(), mark_.rows - rows, width, pending_);
    pending_.clear();
    file_.flush();
    committed_at_ = Clock::now();
  }

  void write_report(const std::string& text, std::span<const NamedScalar> scalars,
                    std::span<const NamedTable> tables, std::span<const Finding> findings) {
    file_.remove_if_present(file_.id(), "report");
    const Handle report = file_.make_group(file_.id(), "report");
    file_.write(report.id(), "text", text);
    const Handle group = file_.make_group(report.id(), "scalars");
    for (const NamedScalar& scalar : scalars) {
      const std::string name = link_name(scalar.name);
      file_.write(group.id(), name, std::span(&scalar.value, 1), {});
      const Handle dataset(
          file_.check(H5Dopen2(group.id(), name.c_str(), H5P_DEFAULT), "open dataset " + name),
          H5Dclose);
      file_.set_attribute(dataset.id(), "unit", scalar.unit);
    }
    for (const NamedTable& table : tables) write_table(report.id(), table);
    write_findings(report.id(), findings);
    commit();
  }

  void write_results(const AnalysisResults& results) {
    const Handle all = has_link(file_, file_.id(), "analyses")
                           ? open_group(file_, file_.id(), "analyses")
                           : file_.make_group(file_.id(), "analyses");
    const std::string name = link_name(results.name);
    file_.remove_if_present(all.id(), name);
    file_.take_sum();
    const Handle group = file_.make_group(all.id(), name);
    file_.set_attribute(group.id(), "state", results.state);
    for (const NamedTable& table : results.tables) write_table(group.id(), table);
    if (!results.shapes.empty()) write_shapes(group.id(), results);
    for (const SparseMatrix& matrix : results.matrices) {
      const Handle entries = file_.make_group(group.id(), link_name(matrix.name));
      file_.set_attribute(entries.id(), "rows", matrix.rows);
      file_.set_attribute(entries.id(), "columns", matrix.columns);
      file_.write(entries.id(), "row", matrix.row);
      file_.write(entries.id(), "column", matrix.column);
      file_.write(entries.id(), "value", matrix.value, {matrix.value.size()});
    }
    const std::uint64_t sum = file_.take_sum();
    file_.set_attribute(group.id(), sum_attribute, sum_text(sum));
    mark_.results[results.name] = sum;
    commit();
  }

  const RecordMark& mark() const { return mark_; }
  const StateTables& tables() const { return tables_; }

  void close() {
    commit();
    file_.check(steps_.close(), "close steps");
    file_.check(history_.close(), "close history");
    file_.close();
  }

 private:
  using Clock = std::chrono::steady_clock;
  struct Unnamed {};

  // A commit takes as long as some steps of a small model.
  bool is_due() const { return Clock::now() - committed_at_ > std::chrono::milliseconds(100); }

  static Shape shape_of(const StateTable& table) {
    return table_shape(table.rows * static_cast<std::size_t>(table.columns), table.columns);
  }

  // A file that is not in its place yet, and goes if it does not come there.
  File(const std::filesystem::path& temporary, const RunInfo& info,
       const std::vector<StructureMesh>& meshes, const std::vector<HistoryColumn>& history, Unnamed)
      : tables_(fields_of(meshes)),
        columns_(history.size()),
        cleanup_(temporary),
        file_(Hdf5File::create(temporary)) {
    file_.set_attribute(file_.id(), "format", "culm run");
    file_.set_attribute(file_.id(), "format_version", format_version);
    file_.set_attribute(file_.id(), "run", info.run);
    file_.set_attribute(file_.id(), "deck", info.deck);
    file_.set_attribute(file_.id(), "model", info.model);
    write_deck(file_, info);
    file_.take_sum();
    const Handle mesh_group = file_.make_group(file_.id(), "mesh");
    int number = 0;
    for (const StructureMesh& mesh : meshes) {
      write_mesh(file_, mesh_group.id(), mesh, number++, tables_);
    }
    const Handle topologies = file_.make_group(file_.id(), "topologies");
    number = 0;
    for (const StateGroup& group : tables_.groups()) {
      file_.write(topologies.id(), step_name(number++), StateTables::topology(group, meshes));
    }
    steps_ = file_.make_group(file_.id(), "steps");
    history_ = make_history(file_, history);
    mark_.head_sum = file_.take_sum();
    file_.flush();
  }

  void give_name(const std::filesystem::path& path) {
    file_.flush();
    file_.move_to(path);
    cleanup_.disarm();
  }

  void copy(const Hdf5File& from, const RecordMark& mark, const Recorded& recorded) {
    const Handle steps = open_group(from, from.id(), "steps");
    for (const Recorded::Step& step : recorded.steps) {
      copy_group(from, steps.id(), file_, steps_.id(), step_name(step.index));
    }
    const std::size_t width = history_width(columns_);
    if (mark.rows > 0) {
      file_.append_rows(history_.id(), 0, width,
                        std::span(recorded.history).first(mark.rows * width));
    }
    if (mark.results.empty()) return;
    const Handle analyses = open_group(from, from.id(), "analyses");
    const Handle own = file_.make_group(file_.id(), "analyses");
    for (const auto& [name, sum] : mark.results) {
      copy_group(from, analyses.id(), file_, own.id(), link_name(name));
    }
  }

  void write_table(hid_t where, const NamedTable& table) {
    const std::string name = link_name(table.name);
    file_.write(where, name, flatten_rows(table.rows), {table.rows.size(), table.columns.size()});
    const Handle dataset = open_dataset(file_, where, name);
    file_.set_attribute(dataset.id(), "names", table.columns);
    file_.set_attribute(dataset.id(), fill_value, absent);
    if (!table.remarks.empty()) file_.set_attribute(dataset.id(), "remarks", table.remarks);
  }

  void write_findings(hid_t where, std::span<const Finding> findings) {
    const Handle group = file_.make_group(where, "findings");
    int number = 0;
    for (const Finding& finding : findings) {
      const Handle one = file_.make_group(group.id(), step_name(number++));
      const bool is_broken = finding.grade == Finding::Grade::broken;
      file_.set_attribute(one.id(), "grade", std::string(is_broken ? "broken" : "warning"));
      file_.set_attribute(one.id(), "kind", finding.kind);
      file_.set_attribute(one.id(), "text", finding.text);
      file_.set_attribute(one.id(), "analysis", finding.analysis);
      file_.set_attribute(one.id(), "time", finding.time);
    }
  }

  void write_shapes(hid_t where, const AnalysisResults& results) {
    const Handle real = file_.make_group(where, "shapes");
    file_.set_attribute(real.id(), "names", results.shape_names);
    for (const StructureShapes& s : results.shapes) {
      file_.write(real.id(), link_name(s.structure), s.real, {s.shapes, s.nodes, 6});
    }
    if (results.shapes.front().imaginary.empty()) return;
    const Handle imaginary = file_.make_group(where, "shapes_imaginary");
    for (const StructureShapes& s : results.shapes) {
      file_.write(imaginary.id(), link_name(s.structure), s.imaginary, {s.shapes, s.nodes, 6});
    }
  }

  void write_arrays(hid_t step, const std::vector<NamedArray>& arrays) {
    // An array may have any name, so free ones stand in a place that no name makes.
    const Handle group = file_.make_group(step, "%arrays");
    for (const NamedArray& array : arrays) {
      file_.write(group.id(), link_name(array.name), array.values,
                  table_shape(array.values.size(), array.columns));
    }
  }

  StateTables tables_;
  std::size_t columns_;
  Cleanup cleanup_;
  Hdf5File file_;
  Handle steps_;
  Handle history_;
  std::vector<Handle> open_tables_;  // of the state that is being recorded
  std::vector<double> pending_;      // rows of the history that are not in the file yet
  Clock::time_point committed_at_;
  RecordMark mark_;
};

Recorder::Recorder(const std::filesystem::path& path, const RunInfo& info,
                   const std::vector<StructureMesh>& meshes,
                   const std::vector<HistoryColumn>& history) {
  check_meshes(meshes);
  const QuietHdf5 quiet;
  file_ = std::make_unique<File>(path, info, meshes, history);
}

Recorder::Recorder(const std::filesystem::path& path, const RunInfo& info,
                   const std::vector<StructureMesh>& meshes,
                   const std::vector<HistoryColumn>& history, const RecordMark& mark,
                   const Recorded& recorded) {
  check_meshes(meshes);
  const QuietHdf5 quiet;
  file_ = std::make_unique<File>(path, info, meshes, history, mark, recorded);
}

const RecordMark& Recorder::commit() {
  internal_check(file_ != nullptr, "the recorder is closed");
  const QuietHdf5 quiet;
  file_->commit();
  return file_->mark();
}

bool recover_run(const std::filesystem::path& path) { return Hdf5File::recover(path); }

Recorder::Recorder(Recorder&&) noexcept = default;
Recorder& Recorder::operator=(Recorder&&) noexcept = default;

Recorder::~Recorder() {
  if (!file_) return;
  const QuietHdf5 quiet;
  try {
    file_->commit();
  } catch (const Error&) {
    // The file keeps its last commit; a destructor has nobody to tell.
  }
  file_.reset();
}

void Recorder::record(const std::vector<StructureMesh>& meshes, const Picture& picture) {
  check_picture(meshes, picture);
  begin(picture);
  const StateTables& tables = file_->tables();
  for (std::size_t t = 0; t < tables.tables().size(); ++t) {
    put(t, tables.values(t, meshes, picture.structures));
  }
  end();
}

void Recorder::begin(const Picture& picture) {
  internal_check(file_ != nullptr, "the recorder is closed");
  const QuietHdf5 quiet;
  file_->begin(picture);
}

std::optional<std::uint64_t> Recorder::room_of(std::size_t table) const {
  const QuietHdf5 quiet;
  return file_->room_of(table);
}

void Recorder::put(std::size_t table, std::span<const double> values) {
  const QuietHdf5 quiet;
  file_->put(table, values);
}

void Recorder::note(std::size_t table, std::uint64_t sum) { file_->note(table, sum); }

void Recorder::end() {
  const QuietHdf5 quiet;
  file_->end();
}

void Recorder::add_history(const HistoryRow& row) {
  internal_check(file_ != nullptr, "the recorder is closed");
  const QuietHdf5 quiet;
  file_->add_history(row);
}

void Recorder::write_results(const AnalysisResults& results) {
  internal_check(file_ != nullptr, "the recorder is closed");
  const QuietHdf5 quiet;
  file_->write_results(results);
}

void Recorder::write_report(const std::string& text, std::span<const NamedScalar> scalars,
                            std::span<const NamedTable> tables, std::span<const Finding> findings) {
  internal_check(file_ != nullptr, "the recorder is closed");
  const QuietHdf5 quiet;
  file_->write_report(text, scalars, tables, findings);
}

void Recorder::close() {
  if (!file_) return;
  const QuietHdf5 quiet;
  file_->close();
  file_.reset();
}

}  // namespace culm::output
