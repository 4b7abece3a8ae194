#include "phase.hpp"

#include <culm/analysis/dynamics.hpp>
#include <culm/base/error.hpp>
#include <culm/base/nearest.hpp>
#include <culm/solver/fill.hpp>

#include "earlier_states.hpp"
#include "model_builder.hpp"
#include "silent_quantity.hpp"

#include <algorithm>
#include <map>
#include <optional>
#include <utility>

namespace culm::simulation {
namespace {

Inactive read_inactive(const Options& deck, const Options& analysis) {
  std::vector<std::string> known;
  std::map<std::string, std::vector<std::string>> lists;  // by the names of their entries
  for (const char* list : {"Loads", "Constraints", "Imperfections"}) {
    for (const Options& entry : deck.list(list).entries()) {
      known.push_back(entry.name());
      lists[entry.name()].emplace_back(list);
    }
  }
  Inactive inactive;
  for (const std::string& name : analysis.texts("Inactive")) {
    const auto found = lists.find(name);
    if (found == lists.end()) {
      throw InputError(analysis.where("Inactive"),
                       "there is no load, constraint or imperfection '" + name + "'" +
                           did_you_mean(name, known));
    }
    if (found->second.size() > 1) {
      throw InputError(analysis.where("Inactive"),
                       "'" + name + "' stands in the lists " + found->second[0] + " and " +
                           found->second[1] + ", and both would not act; rename one of them");
    }
    inactive.insert(name);
  }
  return inactive;
}

// Something that a name occurs several times with, such as the nodes of one support: name and
// count.
template <class Name>
using Occurrence = std::pair<Name, int>;

template <class Name>
class Occurrences {
 public:
  Occurrence<Name> next(const Name& name) { return {name, counts_[name]++}; }

 private:
  std::map<Name, int> counts_;
};

// The analysis whose last state an analysis starts from, if it is one of this run.
std::optional<std::size_t> origin_of(const std::vector<Options>& analyses, std::size_t i) {
  if (!analyses[i].has("Start From")) return i == 0 ? std::nullopt : std::optional(i - 1);
  for (std::size_t earlier = 0; earlier < i; ++earlier) {
    if (analyses[earlier].name() == analyses[i].text("Start From")) return earlier;
  }
  return {};
}

struct Range {
  std::size_t first = 0;
  std::size_t size = 0;
};

template <class Name>
using Ranges = std::map<Occurrence<Name>, Range>;

Ranges<std::string> multipliers_of(const model::Model& model) {
  Ranges<std::string> ranges;
  Occurrences<std::string> occurrences;
  for (std::size_t i = 0; i < model.equations().size(); ++i) {
    const model::UnknownTable& unknowns = model.unknowns();
    const model::Block block = unknowns.block(unknowns.constraint_block(static_cast<int>(i)));
    ranges[occurrences.next(model.equations()[i].name)] = {
        static_cast<std::size_t>(block.first_value), static_cast<std::size_t>(block.shape.width)};
  }
  return ranges;
}

Ranges<std::string> own_of(const model::Model& model) {
  Ranges<std::string> ranges;
  Occurrences<std::string> occurrences;
  for (const model::OwnBlock& block : model.own_blocks()) {
    ranges[occurrences.next(block.name)] = {static_cast<std::size_t>(block.first),
                                            block.unknowns.size()};
  }
  return ranges;
}

Ranges<model::Effect> memories_of(const model::Model& model) {
  Ranges<model::Effect> ranges;
  Occurrences<model::Effect> occurrences;
  std::size_t first = 0;
  for (const model::Batch* batch : model.batches()) {
    ranges[occurrences.next(batch->effect())] = {first, batch->memory_size()};
    first += batch->memory_size();
  }
  return ranges;
}

template <class Name>
std::size_t size_of(const Ranges<Name>& ranges) {
  std::size_t size = 0;
  for (const auto& [name, range] : ranges) size += range.size;
  return size;
}

// `moved` has what is new at its beginning.
template <class Name>
std::vector<double> move_ranges(std::span<const double> values, const Ranges<Name>& from,
                                const Ranges<Name>& to, std::vector<double> moved) {
  for (const auto& [name, range] : to) {
    const auto found = from.find(name);
    if (found == from.end() || found->second.size != range.size) continue;
    std::copy_n(values.begin() + static_cast<std::ptrdiff_t>(found->second.first), range.size,
                moved.begin() + static_cast<std::ptrdiff_t>(range.first));
  }
  return moved;
}

// Of the memory, that a model takes by its elements where its factors may take all.
constexpr double noticeable_share = 0.1;

// Columns are told apart by name and unit alone.
void refuse_equal_columns(const std::vector<Options>& entries,
                          const std::vector<WatchedQuantity>& watched, InputIssues& issues) {
  const std::vector<output::HistoryColumn> columns = columns_of(watched);
  std::map<std::string, std::size_t> owners;
  auto column = columns.begin();
  for (std::size_t i = 0; i < watched.size(); ++i) {
    for (std::size_t left = watched[i].quantity->columns().size(); left > 0; --left, ++column) {
      const std::string heading = column->name + " [" + column->unit + "]";
      const auto [first, is_new] = owners.emplace(heading, i);
      if (is_new || first->second == i) continue;
      issues.add(entries[i].where(), "its column '" + heading + "' is called as one of '" +
                                         entries[first->second].name() +
                                         "', which stands before it; rename one of the two");
    }
  }
}

}  // namespace

double factors_by_graph(const Phase& phase, const parallel::Comm& comm,
                        model::Processes processes) {
  const double all =
      phase.linear.is_iterative
          ? phase.linear.bytes
          : sizeof(double) * solver::predict_fill(*phase.system->matrix(), comm).entries;
  return phase.linear.is_shared ? all * processes.here / processes.all : all;
}

Phases::Phases(const Catalogue& catalogue, const Options& deck, const Imperfections& imperfections,
               const Log& log, double memory, model::Processes processes)
    : catalogue_(catalogue),
      deck_(deck),
      imperfections_(imperfections),
      log_(log),
      memory_(memory),
      processes_(processes) {
  const std::vector<Options>& analyses = deck.list("Analyses").entries();
  for (std::size_t i = 0; i < analyses.size(); ++i) {
    const std::string& type = analyses[i].text("Type");
    Setting setting{read_inactive(deck, analyses[i]),
                    catalogue.analyses.follows_path.contains(type)};
    setting.inactive.merge(imperfections.unknown_in(i));
    // what looks at a state has the loads that led there
    const std::optional<std::size_t> origin = origin_of(analyses, i);
    if (origin && catalogue.analyses.inspections.contains(type))
      setting.is_path = of(*origin).setting.is_path;
    by_analysis_.push_back(&find_or_build(setting));
  }
  refuse_jumps();
  complete_columns();
}

bool Phases::leaves_path(std::size_t analysis) const {
  const std::optional<std::size_t> origin = origin_of(deck_.list("Analyses").entries(), analysis);
  return origin && of(*origin).setting.is_path && !of(analysis).setting.is_path;
}

Phase& Phases::find_or_build(const Setting& setting) {
  for (Phase& phase : phases_) {
    if (phase.setting == setting) return phase;
  }
  Phase& phase = phases_.emplace_back();
  phase.setting = setting;
  phase.bent_by = imperfections_.acting(setting.inactive);
  build(phase);
  return phase;
}

void Phases::build(Phase& phase) const {
  phase.watched.clear();
  phase.ports.clear();
  phase.model = std::make_unique<model::Model>();
  BuiltWith built = build_model(catalogue_, deck_, imperfections_, phase.setting, log_, memory_,
                                processes_, *phase.model);
  phase.watched = std::move(built.watched);
  phase.ports = std::move(built.ports);
  phase.need = built.need;
  for (const auto& [name, cloud] : clouds_) attach(name, cloud, phase);
}

void Phases::attach(const std::string& name, const port::Cloud& cloud, Phase& phase) {
  std::string issue;
  auto places = port::attach(cloud, *phase.model, issue);
  if (!issue.empty()) throw UsageError("port '" + name + "': " + issue);
  phase.ports.push_back(port::add_port(name, std::move(places), *phase.model));
}

void Phases::add_port(const std::string& name, port::Cloud cloud) {
  for (Phase& phase : phases_) {
    attach(name, cloud, phase);
    phase.system.reset();  // its graph and its batches are others now
  }
  clouds_.emplace_back(name, std::move(cloud));
}

// A state of one geometry would be under stress in another.
void Phases::refuse_jumps() const {
  const std::vector<Options>& analyses = deck_.list("Analyses").entries();
  InputIssues issues;
  for (std::size_t i = 0; i < analyses.size(); ++i) {
    const std::optional<std::size_t> origin = origin_of(analyses, i);
    if (!origin || of(*origin).bent_by == of(i).bent_by) continue;
    issues.add(analyses[i].where("Start From"),
               "imperfections give it another stress-free geometry than '" +
                   analyses[*origin].name() + "' has; start it from 'Reference'");
  }
  issues.throw_if_any();
}

// At what time or level an analysis ends, where the deck says so.
std::optional<double> Phases::end_of(std::size_t analysis) const {
  const std::vector<Options>& analyses = deck_.list("Analyses").entries();
  const Options& entry = analyses[analysis];
  const std::string& type = entry.text("Type");
  if (type == "Static") return entry.number("Final Level");
  if (type == "Dynamic") return entry.number("End Time");
  if (!catalogue_.analyses.inspections.contains(type)) return {};
  const std::optional<std::size_t> origin = origin_of(analyses, analysis);
  return origin ? end_of(*origin) : std::nullopt;
}

void Phases::refuse_late_starts() const {
  const std::vector<Options>& analyses = deck_.list("Analyses").entries();
  InputIssues issues;
  for (std::size_t i = 0; i < analyses.size(); ++i) {
    const Options& entry = analyses[i];
    if (entry.text("Type") != "Dynamic" || entry.has("Start Time")) continue;
    const std::optional<std::size_t> origin = origin_of(analyses, i);
    const std::optional<double> start = origin ? end_of(*origin) : std::nullopt;
    if (!start || *start < entry.number("End Time")) continue;
    issues.add(entry.where("End Time"), analysis::late_start(*start, entry.number("End Time")));
  }
  issues.throw_if_any();
}

// Where a load does not act, the columns of its quantity are known from where it does.
void Phases::complete_columns() {
  const Options& history = deck_.list("Output").list("History");
  InputIssues issues;
  for (std::size_t i = 0; i < history.entries().size(); ++i) {
    const Quantity* sounding = nullptr;
    for (const Phase& phase : phases_) {
      const Quantity* quantity = phase.watched[i].quantity.get();
      if (dynamic_cast<const SilentQuantity*>(quantity) == nullptr) sounding = quantity;
    }
    if (sounding == nullptr) {
      issues.add(history.entries()[i].where(), "watches what acts in none of the analyses");
      continue;
    }
    for (Phase& phase : phases_) {
      if (auto* silent = dynamic_cast<SilentQuantity*>(phase.watched[i].quantity.get())) {
        silent->set_columns(sounding->columns());
      }
    }
  }
  issues.throw_if_any();
  if (!phases_.empty()) refuse_equal_columns(history.entries(), phases_.front().watched, issues);
  issues.throw_if_any();
  for (Phase& phase : phases_) {
    phase.samples =
        find_sampled_signals(deck_.list("Signals"), *phase.model, phase.watched, issues);
  }
  issues.throw_if_any();
}

Phase& Phases::enter(std::size_t analysis, const parallel::Comm& comm, Ledger& ledger) {
  Phase& phase = *by_analysis_[analysis];
  if (phase.system != nullptr) return phase;
  if (!phase.bent_by.empty()) {
    build(phase);  // it was straight as long as nobody knew the shapes
    complete_columns();
  }
  phase.system = std::make_unique<assembly::System>(*phase.model, comm, ledger);
  if (!phase.samples.empty()) {
    phase.system->set_sampler([&phase](model::State& state) {
      sample(phase.samples, phase.watched, *phase.system, state);
    });
  }
  assembly::System& system = *phase.system;
  phase.linear = solver::choose_linear_solver(deck_.list("Solver").text("Linear Solver"),
                                              system.matrix(), comm,
                                              {[&system] { return system.node_motions(); },
                                               (memory_ - phase.need.elements) / processes_.here});
  if (phase.linear.is_iterative) system.watch_tangents();
  // the order in which a solver eliminates is found a second time, so only where it may matter
  if (phase.need.total() > noticeable_share * memory_) {
    phase.need.factors = factors_by_graph(phase, comm, processes_);
    model::refuse_above(memory_, phase.need, "the model", deck_.list("Structures").where());
  }
  if (phases_.size() > 1 || EarlierStates::wants_reference(deck_.list("Analyses"))) {
    model::State state = phase.model->initial_state();
    phase.system->save(state, phase.reference);
  }
  return phase;
}

// All phases have the same ports in the same order.
void hand_over_loads(const Phase& from, Phase& to) {
  if (&from == &to) return;
  for (std::size_t i = 0; i < to.ports.size(); ++i) to.ports[i]->take_loads(*from.ports[i]);
}

Snapshot hand_over(const Snapshot& saved, const Phase& from, const Phase& to) {
  Snapshot moved = saved;
  if (&from != &to) {
    const Ranges<std::string> multipliers = multipliers_of(*to.model);
    moved.set("state/multipliers",
              move_ranges(saved.numbers("state/multipliers"), multipliers_of(*from.model),
                          multipliers, std::vector<double>(size_of(multipliers), 0.0)));
    moved.set("state/own", move_ranges(saved.numbers("state/own"), own_of(*from.model),
                                       own_of(*to.model), to.reference.copy("state/own")));
    moved.set("system/batches",
              move_ranges(saved.numbers("system/batches"), memories_of(*from.model),
                          memories_of(*to.model), to.reference.copy("system/batches")));
  }
  moved.set("system/carried", std::vector<double>{});
  return moved;
}

}  // namespace culm::simulation
