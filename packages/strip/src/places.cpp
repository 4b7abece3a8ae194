#include "places.hpp"

#include <culm/joint/triad_nodes.hpp>
#include <culm/strip/shared_chord.hpp>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <string>
#include <utility>

namespace culm::strip {
namespace {

std::size_t count_of(const Options& options, const char* table) {
  return std::string(table) == "Airfoils" ? options.texts(table).size()
                                          : options.numbers(table).size();
}

void check_tables(const Options& options, std::initializer_list<const char*> tables,
                  InputIssues& issues) {
  const bool any = std::ranges::any_of(tables, [&](auto table) { return options.has(table); });
  if (any != options.has("Positions")) {
    const std::string names = fmt::format("'{}'", fmt::join(tables, "', '"));
    issues.add(options.where(),
               any ? names + " need 'Positions'" : "'Positions' needs one of " + names);
    return;
  }
  if (!any) return;
  const std::vector<double>& positions = options.numbers("Positions");
  if (positions.front() != 0.0 || positions.back() != 1.0 ||
      !std::is_sorted(positions.begin(), positions.end())) {
    issues.add(options.where("Positions"),
               "must rise from 0 to 1, as fractions of the length of the line");
  }
  for (const char* table : tables) {
    if (!options.has(table) || count_of(options, table) == positions.size()) continue;
    issues.add(options.where(table),
               fmt::format("must have one value for each of {} positions, got {}", positions.size(),
                           count_of(options, table)));
  }
}

std::vector<Place> places_on_line(const Options& options, model::BuildContext& context) {
  const model::Structure* structure = model::select_structure(options, context);
  if (structure == nullptr) return {};
  const int count = options.integer("Stations");
  double length = 0.0;
  length += structure->line_points.length();
  std::vector<Place> places;
  for (int i = 0; i < count; ++i) {
    const double s = (i + 0.5) / count;
    const auto point = model::marker_at_fraction(*structure, s);
    if (!point) {
      context.issues.add(options.where("Structure"),
                         "structure '" + structure->name + "' is not a line: it has no span");
      return {};
    }
    places.push_back({*point, length / count, s});
  }
  if (!joint::have_triads(places.front().point.nodes, "Structure", options, context)) return {};
  return places;
}

// One chord takes one load of the air; loads with functions may take turns, which a run looks at.
void refuse_second_load(const Options& options, const StripLoad& load,
                        model::BuildContext& context) {
  if (!load.amplitude().is_constant()) return;
  for (const auto& earlier : context.model.loads()) {
    const auto* other = dynamic_cast<const StripLoad*>(earlier.get());
    if (other == nullptr || !other->amplitude().is_constant() ||
        !count_twice(load, *other, {}, Stencil::statics()) ||
        !share_chord(load, *other, context.model)) {
      continue;
    }
    const char* on = options.has("Structure") ? "Structure" : "Node";
    context.issues.add(options.where(on), "'" + options.text(on) + "' has the strips '" +
                                              other->effect().name +
                                              "' in the same place: the air would act on it twice");
    return;
  }
}

void stand_in_frame(const Options& options, StripLoad& load, model::BuildContext& context) {
  std::vector<int> nodes;
  for (const Station& station : load.stations()) {
    nodes.insert(nodes.end(), station.point.nodes.begin(), station.point.nodes.end());
  }
  const auto frames = model::rotations_of(context.model, nodes);
  if (frames.empty()) return;
  const bool all_turn =
      std::ranges::all_of(nodes, [&](int node) { return frames.front()->turns(node); });
  if (frames.size() > 1 || !all_turn) {
    context.issues.add(options.where(),
                       frames.size() > 1 ? "stands in more than one rotating frame"
                                         : "stands in a rotating frame with a part only: name all "
                                           "of its structure there, or nothing of it");
    return;
  }
  load.stand_in(*frames.front(), options.where("Flow"));
}

}  // namespace

Between find_between(const std::vector<double>& positions, double s) {
  const auto above = std::upper_bound(positions.begin() + 1, positions.end() - 1, s);
  const auto index = static_cast<std::size_t>(above - positions.begin()) - 1;
  const double length = positions[index + 1] - positions[index];
  const double share = length > 0.0 ? (s - positions[index]) / length : 1.0;
  return {index, std::clamp(share, 0.0, 1.0)};
}

Distribution::Distribution(const Options& options, const char* one, const char* several) {
  if (options.has(several)) {
    values_ = options.numbers(several);
    positions_ = options.numbers("Positions");
  } else {
    values_ = {options.number(one)};
  }
}

double Distribution::at(double s) const {
  if (values_.size() == 1) return values_.front();
  const Between place = find_between(positions_, s);
  return (1.0 - place.share) * values_[place.index] + place.share * values_[place.index + 1];
}

void add_place_fields(Schema& schema) {
  schema.add(text("Structure", "The beam that it acts on.").optional())
      .add(text("Node", "A node, instead, whose third director is the span.").optional())
      .add(number("Length", "m", "Span that the node stands for.").positive().optional())
      .add(flow::flow_field())
      .add(model::function_field("Constant"))
      .add(integer("Stations", "Sections at which the flow acts, each in the middle of its part.")
               .between(1, 100000)
               .optional(20))
      .add(numbers("Positions", "1",
                   "Fractions of the length at which the lists below have their values.")
               .min_size(2)
               .optional());
}

void check_one_of(const char* one, const char* several, const Options& options,
                  InputIssues& issues) {
  if (options.has(one) != options.has(several)) return;
  issues.add(options.where(), fmt::format("give one of '{}' and '{}'", one, several));
}

void check_places(const Options& options, std::initializer_list<const char*> tables,
                  InputIssues& issues) {
  check_one_of("Structure", "Node", options, issues);
  if (options.has("Node") != options.has("Length")) {
    issues.add(options.where(), "'Node' and 'Length' need each other");
  }
  check_tables(options, tables, issues);
}

std::vector<Place> places_of(const Options& options, model::BuildContext& context) {
  if (options.has("Structure")) return places_on_line(options, context);
  std::vector<Place> places;
  const std::vector<int> nodes = model::select_nodes(options, "Node", context);
  if (!joint::have_triads(nodes, "Node", options, context)) return {};
  for (const int node : nodes) {
    places.push_back({model::marker_at(node), options.number("Length"), 0.5});
  }
  return places;
}

flow::SharedFlow find_wind(const Options& options, StripContext& context) {
  flow::SharedFlow flow = flow::find_flow(options, context.fluids);
  if (flow && options.has("Structure") && options.text("Structure") == flow->stands_about()) {
    return flow->without_structure();
  }
  return flow;
}

std::optional<model::Amplitude> find_time_function(const Options& options,
                                                   model::BuildContext& context) {
  auto function = model::find_function(options, context);
  if (!function || function->signal() == nullptr) return function;
  context.issues.add(options.where("Function"), "must be a function of time, not a signal");
  return {};
}

void add_strips(const Options& options, std::unique_ptr<StripLoad> load, StripContext& context) {
  refuse_second_load(options, *load, context.fluids.build);
  // frames may stand behind the strips in the deck
  context.fluids.after_all_loads([&options, &strips = *load, &context] {
    stand_in_frame(options, strips, context.fluids.build);
  });
  context.fluids.build.model.add_load(std::move(load));
}

}  // namespace culm::strip
