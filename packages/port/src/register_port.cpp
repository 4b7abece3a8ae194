#include <culm/model/find_point.hpp>
#include <culm/port/point_motion.hpp>
#include <culm/port/register_port.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <numeric>
#include <utility>

namespace culm::port {
namespace {

int number_of(const model::Structure* structure, const model::Model& model) {
  const auto& all = model.structures();
  const auto found = std::find_if(all.begin(), all.end(),
                                  [&](const model::Structure& one) { return &one == structure; });
  return found == all.end() ? -1 : static_cast<int>(found - all.begin());
}

// A marker with an offset in its directors.
Place place_of(model::Marker marker, const Vec3& offset, const model::Model& model) {
  Place place;
  place.structure = number_of(model.structure_of(marker.nodes.front()), model);
  marker.offset = offset;
  place.distance = (directors(marker, model.nodes().reference()) * marker.offset).norm();
  place.marker = std::move(marker);
  return place;
}

Field offset_field() {
  return model::vector_field("Offset", "m",
                             "From each point to where it is seen, in its directors.")
      .optional({0.0, 0.0, 0.0});
}

// A node of a shell has one director.
bool refuse_offset(const Options& options, const std::vector<Place>& places,
                   model::BuildContext& context) {
  if (model::vector(options, "Offset").tail<2>().isZero(0.0)) return false;
  for (const Place& place : places) {
    if (kind_of(place.marker, context.model.nodes()) != NodeKind::node6) continue;
    context.issues.add(options.where("Offset"),
                       "a point of a shell has one director: only the first component may differ "
                       "from zero");
    return true;
  }
  return false;
}

void register_points(PortRegistry& registry) {
  registry.add("Points",
               Schema("Points", "Nodes and points of lines by name.")
                   .add(texts("Points",
                              "Nodes as 'structure/set', 'structure/number', 'structure' or a node "
                              "set, and points of lines as 'beam@0.35'.")
                            .min_size(1))
                   .add(offset_field()),
               [](const Options& options, model::BuildContext& context) {
                 const Vec3 offset = model::vector(options, "Offset");
                 const Where& where = options.where("Points");
                 std::vector<Place> places;
                 for (const std::string& name : options.texts("Points")) {
                   if (name.find('@') != std::string::npos) {
                     auto marker = model::find_point(name, where, context);
                     if (marker) places.push_back(place_of(*marker, offset, context.model));
                     continue;
                   }
                   for (const int node : model::find_nodes(name, where, context)) {
                     places.push_back(place_of(model::marker_at(node), offset, context.model));
                   }
                 }
                 if (refuse_offset(options, places, context)) places.clear();
                 return places;
               });
}

void register_stations(PortRegistry& registry) {
  registry.add(
      "Stations",
      Schema("Stations", "Points of a line at equal parts of its length, from end to end.")
          .add(model::structure_field())
          .add(integer("Number", "How many, both ends included.").at_least(2))
          .add(offset_field()),
      [](const Options& options, model::BuildContext& context) {
        std::vector<Place> places;
        const model::Structure* structure = model::select_structure(options, context);
        if (structure == nullptr) return places;
        const int number = options.integer("Number");
        for (int i = 0; i < number; ++i) {
          auto marker =
              model::marker_at_fraction(*structure, static_cast<double>(i) / (number - 1));
          if (!marker) {
            context.issues.add(options.where("Structure"),
                               "structure '" + structure->name + "' is no line");
            break;
          }
          places.push_back(place_of(*marker, model::vector(options, "Offset"), context.model));
        }
        return places;
      });
}

Schema elements_schema() {
  return Schema("Elements", "Points of elements at natural coordinates.")
      .add(model::structure_field())
      .add(integers("Elements", "The element of each point, by its number from 0.")
               .at_least(0)
               .min_size(1))
      .add(numbers("Natural", "1", "xi and eta of each point, from -1 to 1; eta is 0 on a line.")
               .between(-1.0, 1.0)
               .size_multiple_of(2))
      .add(numbers("Offsets", "m",
                   "Offset of each point in its directors, three numbers; of a shell the first "
                   "counts. Zero if absent.")
               .size_multiple_of(3)
               .optional())
      .check([](const Options& options, InputIssues& issues) {
        const std::size_t count = options.integers("Elements").size();
        const auto compare = [&](const char* name, std::size_t each) {
          if (!options.has(name) || options.numbers(name).size() == each * count) return;
          issues.add(options.where(name),
                     fmt::format("needs {} numbers for {} elements, got {}", each * count, count,
                                 options.numbers(name).size()));
        };
        compare("Natural", 2);
        compare("Offsets", 3);
      });
}

std::vector<Place> make_element_points(const Options& options, model::BuildContext& context) {
  std::vector<Place> places;
  const model::Structure* structure = model::select_structure(options, context);
  if (structure == nullptr) return places;
  const std::vector<int>& elements = options.integers("Elements");
  for (std::size_t i = 0; i < elements.size(); ++i) {
    const auto count = static_cast<int>(structure->numbered_cells());
    if (elements[i] >= count) {
      context.issues.add(options.where("Elements"),
                         fmt::format("structure '{}' has elements 0 to {}, got {}", structure->name,
                                     count - 1, elements[i]));
      return {};
    }
    const std::vector<int> cells = structure->cells_of(elements[i]);
    if (cells.size() > 1) {
      context.issues.add(options.where(),
                         "natural coordinates mean nothing in elements that 'Refinement' divides; "
                         "use 'Stations' or 'Cloud'");
      return {};
    }
    const Vec3 offset =
        options.has("Offsets")
            ? Vec3(Eigen::Map<const Vec3>(options.numbers("Offsets").data() + 3 * i))
            : Vec3::Zero();
    places.push_back(place_in_cell(
        context.model, number_of(structure, context.model), cells.front(),
        Eigen::Map<const Eigen::Vector2d>(options.numbers("Natural").data() + 2 * i), offset));
  }
  return places;
}

void register_cloud(PortRegistry& registry) {
  registry.add(
      "Cloud",
      Schema("Cloud",
             "Points in space, such as a wetted surface: each is attached to the nearest structure "
             "in the reference and moves with its cross-section, face or body.")
          .add(numbers("Points", "m", "x, y, z of each point.").size_multiple_of(3).min_size(3))
          .add(texts("Structures", "Structures that they may lie on; all if absent.")
                   .optional(std::vector<std::string>{}))
          .add(number("Reach", "m",
                      "How far a point may be from axis, mid-surface or node; any distance if "
                      "absent.")
                   .positive()
                   .optional())
          .add(choice("Weights", {"Elements", "Smooth"},
                      "How points between the nodes of lines move with them: by the functions of "
                      "the elements, or by cubics through neighbouring nodes, which keep a surface "
                      "smooth.")
                   .optional("Elements")),
      [](const Options& options, model::BuildContext& context) {
        Cloud cloud{options.numbers("Points"), options.texts("Structures")};
        if (options.has("Reach")) cloud.reach = options.number("Reach");
        if (options.text("Weights") == "Smooth") cloud.weights = Weights::smooth;
        std::string issue;
        auto places = attach(cloud, context.model, issue);
        if (!issue.empty()) context.issues.add(options.where(), issue);
        return places;
      });
}

}  // namespace

std::vector<Place> attach(const Cloud& cloud, const model::Model& model, std::string& issue) {
  std::vector<int> structures;
  if (cloud.structures.empty()) {
    structures.resize(model.structures().size());
    std::iota(structures.begin(), structures.end(), 0);
  }
  for (const std::string& name : cloud.structures) {
    const model::Structure* structure = model.find_structure(name);
    if (structure == nullptr) {
      std::vector<std::string> names;
      for (const model::Structure& one : model.structures()) names.push_back(one.name);
      issue = "unknown structure '" + name + "'" + did_you_mean(name, names);
      return {};
    }
    structures.push_back(number_of(structure, model));
  }
  Projection found = project(model, cloud.points, structures, cloud.weights);
  std::vector<std::size_t> lost = found.lost;
  for (std::size_t p = 0; p < found.places.size(); ++p) {
    if (found.places[p].distance > cloud.reach) lost.push_back(p);
  }
  if (lost.empty()) return found.places;
  const std::size_t first = *std::min_element(lost.begin(), lost.end());
  const double* x = cloud.points.data() + 3 * first;
  issue = fmt::format(
      "{} of {} points belong to no structure, the first of them point {} at ({:g}, "
      "{:g}, {:g})",
      lost.size(), found.places.size(), first, x[0], x[1], x[2]);
  issue += found.places[first].marker.nodes.empty()
               ? ", more than half an element past the rim"
               : fmt::format(", {:g} m away where at most {:g} m are allowed",
                             found.places[first].distance, cloud.reach);
  return {};
}

std::unique_ptr<Port> add_port(const std::string& name, std::vector<Place> places,
                               model::Model& model) {
  std::vector<model::Marker> points;
  for (const Place& place : places) points.push_back(place.marker);
  auto load =
      std::make_unique<PortLoad>(model::Effect("Port", name), model.nodes(), std::move(points));
  auto port = std::make_unique<Port>(name, model.nodes(), std::move(places), *load);
  model.add_load(std::move(load));
  return port;
}

void register_ports(PortRegistry& registry) {
  register_points(registry);
  register_stations(registry);
  registry.add("Elements", elements_schema(), make_element_points);
  register_cloud(registry);
}

}  // namespace culm::port
