/// A deck as a running model.
#pragma once

#include <culm/analysis/stepper.hpp>
#include <culm/base/ledger.hpp>
#include <culm/base/log.hpp>
#include <culm/base/options.hpp>
#include <culm/parallel/comm.hpp>
#include <culm/port/faces.hpp>
#include <culm/port/register_port.hpp>
#include <culm/simulation/catalogue.hpp>
#include <culm/simulation/memory.hpp>
#include <culm/simulation/read_deck.hpp>
#include <culm/simulation/stop_request.hpp>

#include <filesystem>
#include <memory>
#include <span>
#include <string>
#include <vector>

namespace culm::simulation {

struct Phase;
class Checkpoints;
class CoupledRun;
class ResultFiles;
class RunObserver;
class ServedRun;

/// Where another program comes to that leads the run.
struct ServeSettings {
  std::string address;      ///< as of coupling::listen, or 'mpi:RANK'; nobody leads if empty
  std::string port;         ///< the only one of the deck if empty
  double patience = 600.0;  ///< how long it may be silent [s]
};

/// How a run talks and where it writes.
struct RunSettings {
  std::filesystem::path folder;  ///< for results
  bool quiet = false;
  bool terminal = false;  ///< standard output is a terminal
  bool strict = false;    ///< warnings count as broken promises
  std::filesystem::path replay =
      {};                    ///< record of a coupling, or folder of such, whose loads act instead
  ServeSettings serve = {};  ///< whom the run follows
};

/// Builds the model of a deck and runs its analyses. The same on all ranks.
class Simulation {
 public:
  /// Builds the model. Throws InputError with all mistakes.
  /// @param deck validated with Catalogue::deck_schema
  /// @param source what it was read from, for checkpoints
  /// @param memory what the model may need on a machine [B]
  Simulation(const parallel::Comm& comm, const Catalogue& catalogue, Options deck,
             DeckSource source, const Log& log, double memory = machine_memory());
  /// The same from a file, with all types that culm has. Collective; throws FileError, UsageError
  /// for an override that is no assignment, and InputError.
  /// @param overrides  such as "Structures/beam/Curve/Elements=32"; what is missing is created
  /// @param log        where messages go; nothing else is printed
  static Simulation open(const std::string& path, std::vector<std::string> overrides = {},
                         const Log& log = Log(LogLevel::quiet),
                         const parallel::Comm& comm = parallel::Comm());
  /// The same without a file: all that a deck would say, as assignments such as
  /// "Structures/beam/Type=Beam". Messages name them as those of the command line.
  static Simulation make(std::vector<std::string> assignments,
                         const Log& log = Log(LogLevel::quiet),
                         const parallel::Comm& comm = parallel::Comm());
  Simulation(Simulation&&) noexcept;
  ~Simulation();

  const Options& deck() const;

  /// Runs all analyses and writes results. On NumericalError or NonFiniteError the files hold
  /// everything up to the last accepted step, and the post-mortem as report. Throws Stopped when a
  /// signal or the end of the time allowed stopped the run, and PromiseBroken when it came to its
  /// end but not all that culm promises holds. Throws FileError with nothing changed if another
  /// process writes into the folder, if an input of the deck would be overwritten, or if the
  /// checkpoint belongs to another model or to other results.
  /// @param from  checkpoint of an earlier run in this folder, to go on with
  void run(const RunSettings& settings, const StopRequest& request, const Snapshot* from = nullptr);

  // --- step by step, by another program ---------------------------------------------------------
  /// Writes results of the analyses that begin() takes up, as run() does: of each step when it is
  /// accepted, and cut back where a snapshot is restored. Nothing is written without it. Before the
  /// first begin(); collective. Throws UsageError later, FileError as run() does.
  void write_results(const std::filesystem::path& folder);
  bool writes_results() const;
  /// Ends the analysis that was taken up, and the files with a report. Throws UsageError if there
  /// are none. What was written before is sound without it.
  /// @return costs, balance and convergence, and which files there are, as a run says them
  std::string close_results();
  /// Takes up an analysis of the deck that makes steps, the first one if no name is given: from
  /// where the deck says, ready for its first attempt. What was taken up before ends. Throws
  /// UsageError if there is no such analysis, else what run() throws before a first step.
  /// @return to be driven by the caller; lives until the next begin()
  analysis::Stepper& begin(const std::string& analysis = {});
  /// What begin() took up; null where nothing was, or where a later begin() found its analysis but
  /// could not take it up.
  analysis::Stepper* stepper();
  /// How often begin() found its analysis; what belongs to an earlier one is gone.
  long taken_up() const;
  /// Sets the load of type 'External' of this name for all attempts from now on. Call it on all
  /// ranks alike. Throws UsageError for an unknown name or another number of values, NonFiniteError
  /// for a value that is no number.
  /// @param values  by node, as `nodes` names them: force [N] and moment about the node [N m]
  void set_load(const std::string& name, const std::vector<double>& values);
  /// Sets the signal of type 'External' of this name for all attempts from now on, between steps. A
  /// snapshot that is restored brings back the value of its time. Call it on all ranks alike.
  /// Throws UsageError for an unknown name, NonFiniteError for a value that is no number.
  void set_signal(const std::string& name, double value);
  /// Adds a port at the points of a partner, beside those of the deck; before the first begin().
  /// Throws UsageError where the name is taken, where points belong to no structure, or later.
  void add_port(const std::string& name, port::Cloud cloud);
  std::vector<std::string> port_names() const;
  /// Of the analysis that was taken up, or of the first one. Throws UsageError for an unknown name.
  const port::Port& port(const std::string& name) const;
  /// A quantity of all points of a port at state(), point after point; collective.
  std::vector<double> read_port(const std::string& name, port::Quantity quantity);
  /// Sets forces and moments at all points of a port for all attempts from now on, also of other
  /// analyses. Call it on all ranks alike. Throws what Port::set_loads throws.
  void set_port(const std::string& name, std::span<const double> forces,
                std::span<const double> moments = {});
  /// Sets the forces at a port to those of pressure and traction on faces between its points, mean
  /// over the open step as it was last attempted; where none is open, as the points are. Throws
  /// UsageError for faces that do not belong to the port or other numbers of values, NonFiniteError
  /// for no number. @see port::face_forces
  void set_port_pressure(const std::string& name, std::span<const port::Face> faces,
                         std::span<const double> pressure, std::span<const double> traction = {});
  /// What the loads of a port did in the open step; collective.
  port::Exchange exchange(const std::string& name);
  /// Writes the points of a port in the reference for ParaView: a VTU file with the structure, the
  /// lever from it, and what is doubtful. Collective; throws FileError.
  void write_port(const std::string& name, const std::filesystem::path& path) const;
  /// Names the promises that did not hold in the analyses so far, in one line; empty if all do.
  std::string broken_promises() const;
  /// The nodes of a name such as 'beam/last' or 'beam', or of a load that set_load knows, by
  /// number.
  std::vector<int> nodes(const std::string& name) const;
  /// Position of a node at state() [m], and its velocity at the last accepted one [m/s];
  /// collective.
  Vec3 position(int node);
  Vec3 velocity(int node);
  /// The state of the stepper, up to date on all ranks: of the last attempt if one is open.
  const model::State& state();
  /// What the deck's history watches, and its values: those of an open attempt as it would be
  /// accepted, else those of the last accepted step, or of the start.
  std::vector<output::HistoryColumn> quantity_columns() const;
  std::vector<double> quantities();
  /// The model of the analysis that was taken up.
  const model::Model& model() const;

  /// Structures, masses, unknowns and effects, for `culm check`.
  std::string summary() const;

  /// Does what analyses that start from the reference do before their first step, and throws what
  /// run() would throw there: NumericalError of a mechanism. With a note instead where a
  /// factorisation is long work.
  void examine();

  /// Writes a result file with nothing but the reference, its constraints and its loads, for
  /// pictures of a model that is not solved yet. Collective; throws FileError.
  void write_model(const std::filesystem::path& path);

 private:
  void run_analyses(model::State& state, RunObserver& observer, ResultFiles& files,
                    CoupledRun* coupled, ServedRun* served, const Snapshot* from);
  /// @param from  checkpoint to go on with, within this analysis
  analysis::AnalysisReport run_analysis(const Options& entry, analysis::Context& context,
                                        model::State& state, RunObserver& observer,
                                        CoupledRun* coupled, ServedRun* served,
                                        const Snapshot* from);
  bool has_type(std::size_t first, bool inspects) const;
  void start_analysis(std::size_t number, model::State& state);
  Snapshot read_state(const Options& analysis, Phase& phase, model::State& state);
  void move_state(std::size_t number, model::State& state);
  void keep_state(const std::string& name, model::State& state);
  /// Of those that begin() takes up.
  void end_analysis();
  /// state(), with the start of the step as well up to date on all ranks; collective.
  const model::State& both_ends();
  void write_last_checkpoint(RunObserver& observer) const;

  struct Parts;
  struct Results;
  /// @param checkpoints  null: there are none
  std::unique_ptr<Results> open_results(const RunSettings& settings, Checkpoints* checkpoints,
                                        const Snapshot* from);
  static Simulation of(DeckSource source, const Log& log, const parallel::Comm& comm);
  explicit Simulation(std::unique_ptr<Parts> parts);
  std::unique_ptr<Parts> parts_;
};

}  // namespace culm::simulation
