#include <culm/base/error.hpp>
#include <culm/base/text.hpp>
#include <culm/control/library_batch.hpp>

#include <algorithm>
#include <cmath>

namespace culm::control {
namespace {

// Of an interval: a step that ends so little before it has ended.
constexpr double slack = 1e-6;

}  // namespace

LibraryBatch::~LibraryBatch() {
  for (Item& item : items_) {
    if (item.calls == 0.0) continue;
    try {
      item.library->call(SwapLibrary::Status::last, item.last, 0.0);
    } catch (const NumericalError&) {
      // the motion is over, and nobody follows what it says now
    }
  }
}

void LibraryBatch::add(const std::string& name, std::unique_ptr<SwapLibrary> library,
                       double interval) {
  Item& item = items_.emplace_back();
  item.name = name;
  item.library = std::move(library);
  item.interval = interval;
}

bool LibraryBatch::has(const std::string& name) const {
  return std::ranges::find(items_, name, &Item::name) != items_.end();
}

std::vector<std::string> LibraryBatch::names() const {
  std::vector<std::string> names;
  for (const Item& item : items_) names.push_back(item.name);
  return names;
}

LibraryBatch::Item& LibraryBatch::find(const std::string& name) {
  const auto item = std::ranges::find(items_, name, &Item::name);
  internal_check(item != items_.end(), "a library that is not there");
  return *item;
}

model::Signal LibraryBatch::add_output(const std::string& name, double initial) {
  const int block =
      model_.add_own_block({name, {{"value", model::UnknownKind::algebraic, 1.0, initial}}});
  return model_.signal(block, 0);
}

void LibraryBatch::connect_output(const std::string& library, int record,
                                  const model::Signal& signal) {
  const double initial = model_.initial_state().own[static_cast<std::size_t>(signal.index)];
  find(library).outputs.push_back({record, signal, initial});
}

void LibraryBatch::connect_input(const std::string& library, int record, model::Amplitude value) {
  find(library).inputs.push_back({record, std::move(value)});
}

// Those of the outputs first; those of inputs, so that their values are known here.
std::vector<int> LibraryBatch::blocks(int item, const model::UnknownTable& unknowns) const {
  const Item& it = items_[static_cast<std::size_t>(item)];
  std::vector<int> result;
  for (const Output& output : it.outputs) {
    result.push_back(unknowns.own_block(output.signal.block));
  }
  for (const Input& input : it.inputs) {
    if (input.value.signal() == nullptr) continue;
    const int block = unknowns.own_block(input.value.signal()->block);
    if (std::ranges::find(result, block) == result.end()) result.push_back(block);
  }
  return result;
}

// What fails in accept is thrown here, between steps, where a run can still write its checkpoint.
void LibraryBatch::prepare(const model::State&, const Stencil& stencil) {
  is_in_time_ = stencil.step > 0.0;
  for (const Item& item : items_) {
    if (!item.failure.empty()) throw NumericalError(item.failure);
  }
}

Verdict LibraryBatch::assemble(const model::State& state, const Stencil&, Want want,
                               model::Target& target) {
  for (std::size_t i = 0; i < placement().items.size(); ++i) {
    const Item& item = items_[static_cast<std::size_t>(placement().items[i])];
    for (std::size_t k = 0; k < item.outputs.size(); ++k) {
      const Output& output = item.outputs[k];
      const double change =
          (state.own[static_cast<std::size_t>(output.signal.index)] - output.held) /
          output.signal.scale;
      const int at = static_cast<int>(k);
      if (want != Want::mass) {
        placement().scatter.add_residual(i, at, &change, target);
        // where nothing else is out of balance a new demand must be taken over all the same
        const double size = std::max(1.0, std::abs(output.held / output.signal.scale));
        target.constraint_violation =
            std::max(target.constraint_violation, std::abs(change) / size);
      }
      if (want == Want::residual) continue;
      placement().scatter.add_tangent(i, at, at, Mat<1, 1>(1.0), target);
    }
  }
  return Verdict::ok;
}

void LibraryBatch::accept(model::State& state) {
  if (!is_in_time_) return;
  for (const int number : placement().items) {
    Item& item = items_[static_cast<std::size_t>(number)];
    const double due = item.last + (1.0 - slack) * item.interval;
    if (item.calls == 0.0 || state.time >= due) call(item, state);
  }
}

void LibraryBatch::call(Item& item, const model::State& state) {
  Stencil end;
  end.theta = 1.0;
  for (const Input& input : item.inputs) {
    item.library->set(input.record, input.value.in_step(state, end));
  }
  const bool is_first = item.calls == 0.0;
  const double since = is_first ? state.time - state.time_prev : state.time - item.last;
  const auto status = is_first ? SwapLibrary::Status::first : SwapLibrary::Status::later;
  try {
    const std::string warning = item.library->call(status, state.time, since);
    if (!warning.empty() && item.warnings++ == 0) {
      item.warning = "'" + warning + "' at " + format_number(state.time) + " s";
    }
  } catch (const NumericalError& error) {
    item.failure = error.what();
  }
  item.calls += 1.0;
  item.last = state.time;
  for (Output& output : item.outputs) {
    const double demand = item.library->get(output.record);
    if (std::isfinite(demand)) {
      output.held = demand;
    } else if (item.failure.empty()) {
      item.failure = "the library '" + item.name + "' demands " + format_number(demand) +
                     " by record " + std::to_string(output.record) + " at " +
                     format_number(state.time) + " s";
    }
  }
}

std::size_t LibraryBatch::memory_size() const {
  std::size_t size = 0;
  for (const Item& item : items_) size += 2 + item.outputs.size();
  return size;
}

void LibraryBatch::save(model::Items which, std::span<double> values) const {
  std::vector<std::size_t> places(items_.size(), 0);
  for (std::size_t i = 1; i < items_.size(); ++i) {
    places[i] = places[i - 1] + 2 + items_[i - 1].outputs.size();
  }
  for (std::size_t i = 0; i < placement().items.size(); ++i) {
    if (which == model::Items::owned && !placement().owned[i]) continue;
    const auto number = static_cast<std::size_t>(placement().items[i]);
    const Item& item = items_[number];
    std::size_t place = places[number];
    values[place++] = item.calls;
    values[place++] = item.last;
    for (const Output& output : item.outputs) values[place++] = output.held;
  }
}

void LibraryBatch::restore(std::span<const double> values) {
  std::size_t place = 0;
  for (std::size_t i = 0; i < items_.size(); ++i) {
    Item& item = items_[i];
    const bool is_local =
        std::ranges::find(placement().items, static_cast<int>(i)) != placement().items.end();
    if (is_local && values[place] != item.calls) {
      throw UsageError(
          "library '" + item.name + "' has states of its own after " + format_number(item.calls) +
          " calls, which cannot become those after " + format_number(values[place]) +
          ": motions with a library can neither be resumed nor put back over a step in which it "
          "was called, nor go on in an analysis in which other things act");
    }
    place += 2;
    for (Output& output : item.outputs) output.held = values[place++];
  }
}

double LibraryBatch::range_used() const {
  const auto complains = [](const Item& item) {
    return item.warnings > 0 || !item.failure.empty();
  };
  return std::ranges::any_of(items_, complains) ? 2.0 : 0.0;
}

std::string LibraryBatch::range_warning(double) const {
  for (const Item& item : items_) {
    if (!item.failure.empty()) return item.failure;
    if (item.warnings == 0) continue;
    return "library '" + item.name + "' warned " + std::to_string(item.warnings) +
           " times, first " + item.warning;
  }
  return "a library warned";
}

std::string LibraryBatch::left_out_of_modes() const {
  return items_.empty() ? "" : "libraries: linear analyses see their demands as held";
}

}  // namespace culm::control
