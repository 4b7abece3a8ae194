#include <culm/joint/triad_nodes.hpp>
#include <culm/soil/api_curves.hpp>
#include <culm/soil/layer.hpp>
#include <culm/soil/register_soil.hpp>
#include <culm/soil/soil_load.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <string>
#include <utility>

namespace culm::soil {
namespace {

LayerRegistry layer_types() {
  LayerRegistry registry;
  register_layers(registry);
  return registry;
}

void check_layers(const Options& options, InputIssues& issues) {
  const auto& layers = options.list("Layers").entries();
  if (layers.empty()) {
    issues.add(options.list("Layers").where(), "must have at least one layer");
    return;
  }
  for (std::size_t i = 1; i < layers.size(); ++i) {
    if (layers[i].number("Top") > layers[i - 1].number("Top")) continue;
    issues.add(layers[i].where("Top"), "must be below the top of the layer before it");
  }
}

Schema soil_schema() {
  Schema tip("Tip", "Resistance under the tip of the pile, Q-z, against motions downward only.");
  tip.add(number("Resistance", "N", "The largest force.").positive());
  Schema schema("Soil",
                "Soil around a pile, a beam that is partly in the ground: lateral and axial "
                "springs along it, and one at its tip.");
  return schema.add(model::structure_field())
      .add(model::vector_field("Ground", "m", "A point of the surface of the ground.")
               .optional({0.0, 0.0, 0.0}))
      .add(model::vector_field("Down", "1", "Direction in which depth is counted.")
               .optional({0.0, 0.0, -1.0}))
      .add(number("Diameter", "m", "Outer diameter of the pile.").positive())
      .add(integer("Stations",
                   "Places along the part in the ground, each in the middle of its share.")
               .between(1, 100000)
               .optional(40))
      .add(flag("Cyclic", "Whether laws of clay and sand are those for cyclic loads.")
               .optional(false))
      .add(flag("Hysteresis",
                "Whether soil slides and loses energy as the pile moves to and fro, or gives back "
                "all that it takes.")
               .optional(false))
      .list(
          "Layers",
          Schema("Layers", "Layers by name, from above.").entries_by_type(layer_types().variants()))
      .list("Tip", fractions_schema(std::move(tip)), Presence::optional)
      .check(check_layers)
      .check([](const Options& options, InputIssues& issues) {
        if (model::vector(options, "Down").norm() > 0.0) return;
        issues.add(options.where("Down"), "must not be zero");
      });
}

// The layers with their tops and weights.
class Ground {
 public:
  explicit Ground(const Options& list) {
    const LayerRegistry types = layer_types();
    for (const Options& entry : list.entries()) {
      tops_.push_back(entry.number("Top"));
      layers_.push_back(types.make(entry.text("Type"), entry));
      weights_.push_back(entry.has("Unit Weight") ? entry.number("Unit Weight") : 0.0);
    }
    for (std::size_t i = weights_.size() - 1; i-- > 0;) {
      if (weights_[i] == 0.0) weights_[i] = weights_[i + 1];
    }
  }
  /// Nothing above the first layer.
  std::optional<Grip> at(double depth, const Pile& pile) const {
    for (std::size_t i = tops_.size(); i-- > 0;) {
      if (depth > tops_[i]) return layers_[i]({depth, weight_above(depth) / depth}, pile);
    }
    return {};
  }

 private:
  // Of all soil down to a depth, per area [N/m^2]; what is missing above the first layer counts.
  double weight_above(double depth) const {
    double weight = 0.0;
    for (std::size_t i = 0; i < tops_.size() && (i == 0 || tops_[i] < depth); ++i) {
      const double from = i == 0 ? 0.0 : tops_[i];
      const double to = i + 1 < tops_.size() ? std::min(depth, tops_[i + 1]) : depth;
      weight += weights_[i] * (to - from);
    }
    return weight;
  }

  std::vector<double> tops_;
  std::vector<double> weights_;  // [N/m^3]; what says none has that of the next below
  std::vector<Layer> layers_;
};

// A line of points seen from the ground.
class PileLine {
 public:
  PileLine(const model::Structure& structure, const model::NodeTable& nodes, const Vec3& ground,
           const Vec3& down)
      : structure_(structure), nodes_(nodes), ground_(ground), down_(down.normalized()) {
    length_ += structure.line_points.length();
  }

  model::Marker point(double s) const { return *model::marker_at_fraction(structure_, s); }
  Vec3 place(double s) const {
    const model::Marker marker = point(s);
    Vec3 sum = Vec3::Zero();
    for (std::size_t a = 0; a < marker.nodes.size(); ++a) {
      sum +=
          marker.weights[a] * model::NodeTable::slots(nodes_.reference(), marker.nodes[a]).col(0);
    }
    return sum;
  }
  double depth(double s) const { return down_.dot(place(s) - ground_); }
  double length() const { return length_; }
  /// Of the line at a fraction, from above to below.
  Vec3 along(double s) const {
    constexpr double step = 1e-4;
    const Vec3 way = place(std::min(1.0, s + step)) - place(std::max(0.0, s - step));
    return (way.dot(down_) < 0.0 ? -1.0 : 1.0) * way.normalized();
  }
  /// The fraction at which the depth is zero, between one above and one below.
  double surface(double above, double below) const {
    for (int i = 0; i < 60; ++i) {
      const double middle = 0.5 * (above + below);
      (depth(middle) > 0.0 ? below : above) = middle;
    }
    return 0.5 * (above + below);
  }

 private:
  const model::Structure& structure_;
  const model::NodeTable& nodes_;
  Vec3 ground_;
  Vec3 down_;
  double length_ = 0.0;
};

// Takes the curves of a station for sliders. @return what objects to that, empty if nothing does
std::string make_remember(Station& station) {
  for (const bool is_lateral : {true, false}) {
    SharedCurve& curve = is_lateral ? station.lateral : station.axial;
    if (curve == nullptr) continue;
    auto sliders = sliders_of(*curve);
    if (!sliders) {
      return is_lateral ? "a lateral curve that falls or becomes stiffer, as that of cyclic clay"
                        : "a curve of the shaft that falls or becomes stiffer; in clay 'Residual' "
                          "= 1 does not";
    }
    if (sliders->size() > SoilLoad::max_sliders) {
      return fmt::format("a curve of more than {} points", SoilLoad::max_sliders);
    }
    (is_lateral ? station.lateral_sliders : station.axial_sliders) = std::move(*sliders);
    curve = nullptr;
  }
  return {};
}

// @return whether all is sound; an issue if not
bool add_stations(const PileLine& line, const Options& options, SoilLoad& load,
                  InputIssues& issues) {
  const Pile pile{options.number("Diameter"), options.flag("Cyclic")};
  const Ground ground(options.list("Layers"));
  const double deep = line.depth(0.0) > line.depth(1.0) ? 0.0 : 1.0;
  const double high = 1.0 - deep;
  const double begin = line.depth(high) > 0.0 ? high : line.surface(high, deep);
  const int count = options.integer("Stations");
  const double length = std::abs(deep - begin) * line.length() / count;
  for (int i = 0; i < count; ++i) {
    const double s = begin + (i + 0.5) / count * (deep - begin);
    const auto grip = ground.at(line.depth(s), pile);
    if (!grip) continue;
    Station station{line.point(s), line.along(s), length, grip->lateral, grip->axial};
    station.begin = s * line.length() - 0.5 * length;
    station.end = station.begin + length;
    if (options.flag("Hysteresis")) {
      const std::string objection = make_remember(station);
      if (!objection.empty()) {
        issues.add(
            options.where("Hysteresis"),
            fmt::format("cannot be: at a depth of {:.4g} m soil has {}", line.depth(s), objection));
        return false;
      }
    }
    load.add(std::move(station));
  }
  if (!options.has_list("Tip")) return true;
  const Options& list = options.list("Tip");
  const ShaftTable table = tip(pile.diameter);
  Station station{line.point(deep), line.along(deep), 1.0, nullptr,
                  fractions_curve(list, table.displacements, table.fractions,
                                  list.number("Resistance"), TableCurve::Sides::positive)};
  station.begin = station.end = deep * line.length();
  load.add(std::move(station));
  return true;
}

// Whether no other load of soil holds the same part of the pile; an issue if one does.
bool is_alone(const SoilLoad& load, const PileLine& line, const Options& options,
              model::BuildContext& context) {
  for (const auto& batch : context.model.loads()) {
    const auto* other = dynamic_cast<const SoilLoad*>(batch.get());
    const Station* shared = other == nullptr ? nullptr : load.meets(*other);
    if (shared == nullptr) continue;
    const double middle = 0.5 * (shared->begin + shared->end) / line.length();
    context.issues.add(
        options.where("Structure"),
        fmt::format("{} holds the same pile {} as well, at a depth of {:.4g} m and elsewhere: two "
                    "loads would be twice the ground; name all layers in one",
                    other->effect().quoted(), shared->holds_across() ? "across" : "along",
                    line.depth(middle)));
    return false;
  }
  return true;
}

void build(const Options& options, model::BuildContext& context) {
  const model::Structure* structure = model::select_structure(options, context);
  if (structure == nullptr) return;
  const Where where = options.where("Structure");
  const auto end = model::marker_at_fraction(*structure, 0.0);
  if (!end) {
    context.issues.add(where, "structure '" + structure->name + "' is not a line");
    return;
  }
  if (!joint::have_triads(end->nodes, "Structure", options, context)) return;
  const PileLine line(*structure, context.model.nodes(), model::vector(options, "Ground"),
                      model::vector(options, "Down"));
  if (line.depth(0.0) <= 0.0 && line.depth(1.0) <= 0.0) {
    context.issues.add(where, "structure '" + structure->name + "' has no end in the ground");
    return;
  }
  auto load =
      std::make_unique<SoilLoad>(model::Effect("Soil", options.name()), context.model.nodes());
  if (!add_stations(line, options, *load, context.issues)) return;
  load->set_pile(structure->name);
  if (!is_alone(*load, line, options, context)) return;
  if (options.flag("Hysteresis")) load->book_under("soil");
  if (load->size() == 0) {
    context.issues.add(options.list("Layers").where(),
                       "begin below the tip of '" + structure->name + "'");
    return;
  }
  context.model.add_load(std::move(load));
}

}  // namespace

void register_soil(model::BuilderRegistry& registry) { registry.add("Soil", soil_schema(), build); }

}  // namespace culm::soil
