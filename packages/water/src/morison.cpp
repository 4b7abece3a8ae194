#include <culm/base/text.hpp>
#include <culm/joint/triad_nodes.hpp>
#include <culm/water/morison_load.hpp>
#include <culm/water/potential_load.hpp>
#include <culm/water/register_water.hpp>

#include "distribution.hpp"
#include "find_sea.hpp"
#include "potential_flow.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <memory>
#include <numbers>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace culm::water {
namespace {

// Parameters for one value and for one at each position.
struct Varied {
  const char *one, *several, *unit, *doc;
};
constexpr Varied varied[] = {
    {"Drag", "Drags", "1", "Coefficient of the drag across the axis, over the diameter."},
    {"Added Mass", "Added Masses", "1",
     "Water that moves along across the axis, over that in the volume."},
    {"Axial Drag", "Axial Drags", "1",
     "Coefficient of the friction along the axis, over the surface."},
    {"Axial Added Mass", "Axial Added Masses", "1", "As 'Added Mass', along the axis."},
    {"Growth", "Growths", "m", "Thickness of what has grown on the outside."}};

Schema geometry_schema() {
  return Schema("Morison")
      .add(text("Structure", "The beam that it acts on.").optional())
      .add(text("Node", "Instead, a node that carries a straight member.").optional())
      .add(model::vector_field("From", "m", "Of this member, from the node along its directors.")
               .optional())
      .add(model::vector_field("To", "m", "Likewise, its other end.").optional())
      .add(numbers("Range", "1", "Part of the length that water may reach, as fractions.")
               .between(0.0, 1.0)
               .size(2)
               .optional(std::vector<double>{0.0, 1.0}))
      .add(integer("Segments",
                   "Straight pieces of equal length, more where 'Positions' lie between; each is "
                   "wet up to the surface that cuts it.")
               .between(1, 100000)
               .optional(20))
      .add(numbers("Positions", "1",
                   "Fractions of the length at which the lists below have their values, linear in "
                   "between; where two are equal, values jump.")
               .min_size(2)
               .optional())
      .add(number("Diameter", "m", "Outer diameter, the same everywhere.").positive().optional())
      .add(numbers("Diameters", "m", "Outer diameters at the positions.").positive().optional())
      .add(number("Flooded Diameter", "m",
                  "Inner diameter of what is open to the water; none if absent.")
               .positive()
               .optional())
      .add(numbers("Flooded Diameters", "m", "The same at the positions; 0 where it is closed.")
               .non_negative()
               .optional());
}

bool has_ends(const Options& options) { return options.has("From") && options.has("To"); }

void check_place(const Options& options, InputIssues& issues) {
  if (options.has("Structure") == options.has("Node")) {
    issues.add(options.where(), "give one of 'Structure' and 'Node'");
  }
  if (options.has("Node") != has_ends(options) || options.has("From") != options.has("To")) {
    issues.add(options.where(), "'Node', 'From' and 'To' need each other");
  }
  const std::vector<double>& range = options.numbers("Range");
  if (range[0] >= range[1]) issues.add(options.where("Range"), "must rise");
  if (options.has("Diameter") == options.has("Diameters")) {
    issues.add(options.where(), "give one of 'Diameter' and 'Diameters'");
  }
  if (options.has("Flooded Diameter") && options.has("Flooded Diameters")) {
    issues.add(options.where(), "give one of 'Flooded Diameter' and 'Flooded Diameters'");
  }
}

std::vector<std::string> tables_of(const Options& options) {
  std::vector<std::string> tables;
  const auto add = [&](const char* name) {
    if (options.has(name)) tables.emplace_back(name);
  };
  add("Diameters");
  add("Flooded Diameters");
  for (const Varied& one : varied) add(one.several);
  return tables;
}

void check_tables(const Options& options, InputIssues& issues) {
  const std::vector<std::string> tables = tables_of(options);
  if (tables.empty() == options.has("Positions")) {
    issues.add(options.where(), tables.empty() ? "'Positions' needs lists with values there"
                                               : fmt::format("'{}' needs 'Positions'", tables[0]));
    return;
  }
  if (tables.empty()) return;
  const std::vector<double>& positions = options.numbers("Positions");
  if (positions.front() != 0.0 || positions.back() != 1.0 || !std::ranges::is_sorted(positions)) {
    issues.add(options.where("Positions"),
               "must rise from 0 to 1, as fractions of the length of the member");
  }
  for (const std::string& table : tables) {
    const std::size_t count = options.numbers(table).size();
    if (count == positions.size()) continue;
    issues.add(options.where(table),
               fmt::format("must have one value for each of {} positions, got {}", positions.size(),
                           count));
  }
}

void check_growth(const Options& options, InputIssues& issues) {
  if (options.has("Growth Density")) return;
  const bool grows = options.has("Growths") || options.number("Growth") > 0.0;
  if (grows) issues.add(options.where(), "'Growth' needs 'Growth Density'");
}

void check_pull(const Options& options, InputIssues& issues) {
  if (options.flag("Pull") || !options.flag("Buoyancy")) return;
  issues.add(options.where("Pull"),
             "must be true where 'Buoyancy' is true, which is the whole pressure");
}

void check_faces(const Options& options, InputIssues& issues) {
  for (const auto& [one, several] :
       {std::pair{"End Drag", "End Drags"}, {"End Added Mass", "End Added Masses"}}) {
    if (!options.given(one) || !options.given(several)) continue;
    issues.add(options.where(several), fmt::format("give one of '{}' and '{}'", one, several));
  }
}

Schema morison_schema() {
  Schema schema("Morison",
                "Waves, current and buoyancy on members with circular sections: the pressure of "
                "the undisturbed water, drag and added mass, up to the surface.");
  schema.add_all(geometry_schema()).add(flow::flow_field()).add(model::function_field("Constant"));
  for (const Varied& one : varied) {
    const std::string name = one.one;
    const double usual = name == "Drag" || name == "Added Mass" ? 1.0 : 0.0;
    schema.add(number(one.one, one.unit, one.doc).non_negative().optional(usual))
        .add(
            numbers(one.several, one.unit, "The same at the positions.").non_negative().optional());
  }
  return schema
      .add(number("Growth Density", "kg/m^3", "Mass of the growth per volume.")
               .positive()
               .optional())
      .add(flag("Buoyancy",
                "Whether the pressure of the water acts with weight and along the axis, beside its "
                "pull across.")
               .optional(true))
      .add(flag("Pull",
                "Whether waves pull across the axis by their acceleration; false, with 'Buoyancy' "
                "false, where 'Potential Flow' acts on the body.")
               .optional(true))
      .add(texts("Dry Ends",
                 "Ends whose face no water touches: in the soil, or inside of another member.")
               .one_of({"first", "last"})
               .optional(std::vector<std::string>{}))
      .add(number("End Drag", "1", "Coefficient of the drag of the wet end faces along the axis.")
               .non_negative()
               .optional(0.0))
      .add(numbers("End Drags", "1", "The same of the first and the last face.")
               .size(2)
               .non_negative()
               .optional())
      .add(number("End Added Mass", "1",
                  "Water that moves along with wet end faces, over that in a half sphere.")
               .non_negative()
               .optional(0.0))
      .add(numbers("End Added Masses", "1", "The same of the first and the last face.")
               .size(2)
               .non_negative()
               .optional())
      .check(check_place)
      .check(check_tables)
      .check(check_growth)
      .check(check_faces)
      .check(check_pull);
}

// The ends of a straight piece of the axis between two fractions of its length.
using Piece = std::array<model::Marker, 2>;

struct Member {
  std::function<Piece(double, double)> piece;
  double length = 0.0;  // [m]
};

// The ends of the line that meets a curve in the two Gauss points of a piece: there a bent beam
// moves as the piece does, so that what is summed over them converges with the fourth order.
Piece through_gauss_points(const model::Structure& line, double begin, double end) {
  const double distance = 1.0 / std::sqrt(3.0);
  const double middle = 0.5 * (begin + end), half = 0.5 * (end - begin);
  Piece points;
  points[0] = *model::marker_at_fraction(line, middle - distance * half);
  points[1] = *model::marker_at_fraction(line, middle + distance * half);
  const double near = 0.5 * (1.0 + 1.0 / distance), far = 1.0 - near;
  Piece ends;
  for (std::size_t e = 0; e < 2; ++e) {
    for (std::size_t p = 0; p < 2; ++p) {
      for (std::size_t a = 0; a < points[p].nodes.size(); ++a) {
        ends[e].nodes.push_back(points[p].nodes[a]);
        ends[e].weights.push_back((e == p ? near : far) * points[p].weights[a]);
      }
    }
  }
  return ends;
}

std::optional<Member> member_on_line(const Options& options, model::BuildContext& context) {
  const model::Structure* structure = model::select_structure(options, context);
  if (structure == nullptr) return {};
  Member member;
  member.length += structure->line_points.length();
  member.piece = [structure](double begin, double end) {
    return through_gauss_points(*structure, begin, end);
  };
  if (model::marker_at_fraction(*structure, 0.0)) return member;
  context.issues.add(options.where("Structure"),
                     "structure '" + structure->name + "' is not a line: it has no axis");
  return {};
}

std::optional<Member> member_on_node(const Options& options, model::BuildContext& context) {
  const std::vector<int> nodes = model::select_nodes(options, "Node", context);
  if (nodes.empty() || !joint::have_triads(nodes, "Node", options, context)) return {};
  if (nodes.size() > 1) {
    context.issues.add(
        options.where("Node"),
        fmt::format("must be one node, which carries the member, got {}", nodes.size()));
    return {};
  }
  const Vec3 from = model::vector(options, "From"), to = model::vector(options, "To");
  if ((to - from).norm() <= 0.0) {
    context.issues.add(options.where("To"), "must not be the same place as 'From'");
    return {};
  }
  const auto piece = [node = nodes.front(), from, to](double begin, double end) {
    Piece ends = {model::marker_at(node), model::marker_at(node)};
    ends[0].offset = (1.0 - begin) * from + begin * to;
    ends[1].offset = (1.0 - end) * from + end * to;
    return ends;
  };
  return Member{piece, (to - from).norm()};
}

// Ends of segments: equal parts of the range, and the positions within. What is flat as a disk has
// as much of the water as a few of it: moments of pressure act by pairs of forces on the ends,
// which would shear thin ones apart.
std::vector<double> divide(const Options& options, double length, double diameter) {
  constexpr double flat = 0.01;  // of the diameter
  const std::vector<double>& range = options.numbers("Range");
  const double most = (range[1] - range[0]) * length / (flat * diameter);
  const int count = most < options.integer("Segments") ? std::max(1, static_cast<int>(most))
                                                       : options.integer("Segments");
  std::vector<double> ends;
  for (int i = 0; i <= count; ++i) ends.push_back(std::lerp(range[0], range[1], double(i) / count));
  if (options.has("Positions")) {
    for (const double s : options.numbers("Positions")) {
      if (s > range[0] && s < range[1]) ends.push_back(s);
    }
  }
  std::ranges::sort(ends);
  constexpr double same = 1e-9;
  const auto [first, last] =
      std::ranges::unique(ends, [](double a, double b) { return b - a < same; });
  ends.erase(first, last);
  ends.back() = range[1];
  return ends;
}

// Reads the sections along a member.
class Sections {
 public:
  explicit Sections(const Options& options)
      : diameter_(options, "Diameter", "Diameters"),
        flooded_(options, "Flooded Diameter", "Flooded Diameters"),
        density_(options.has("Growth Density") ? options.number("Growth Density") : 0.0) {
    for (const Varied& one : varied) values_.emplace_back(options, one.one, one.several);
  }
  WetSection at(double place, double middle) const {
    const auto value = [&](std::size_t i) { return values_[i].at(place, middle); };
    const double bare = diameter_.at(place, middle), growth = value(4);
    const double grown = bare + 2.0 * growth;
    return {grown,
            flooded_.at(place, middle),
            value(0),
            value(1),
            value(2),
            value(3),
            density_ * 0.25 * std::numbers::pi * (grown * grown - bare * bare)};
  }

 private:
  Distribution diameter_, flooded_;
  std::vector<Distribution> values_;
  double density_;
};

std::array<Face, 2> read_faces(const Options& options) {
  std::array<Face, 2> faces = {Face::wet, Face::wet};
  for (const std::string& end : options.texts("Dry Ends")) faces[end == "last"] = Face::dry;
  return faces;
}

std::vector<Segment> segments_of(const Options& options, const Member& member) {
  const Sections sections(options);
  const std::vector<double>& range = options.numbers("Range");
  const double middle_of_all = 0.5 * (range[0] + range[1]);
  const std::vector<double> ends =
      divide(options, member.length, sections.at(middle_of_all, middle_of_all).diameter);
  std::vector<Segment> segments;
  for (std::size_t i = 0; i + 1 < ends.size(); ++i) {
    const double middle = 0.5 * (ends[i] + ends[i + 1]);
    Segment segment;
    segment.length = (ends[i + 1] - ends[i]) * member.length;
    segment.ends = member.piece(ends[i], ends[i + 1]);
    for (std::size_t end = 0; end < 2; ++end) {
      segment.sections[end] = sections.at(ends[i + end], middle);
    }
    segments.push_back(std::move(segment));
  }
  const std::array<Face, 2> faces = read_faces(options);
  segments.front().faces[0] = faces[0];
  segments.back().faces[1] = faces[1];
  segments.front().goes_on[0] = ends.front() > 0.0;
  segments.back().goes_on[1] = ends.back() < 1.0;
  return segments;
}

Vec3 place_of(const model::Marker& point, const model::NodeTable& nodes) {
  Vec3 place = Vec3::Zero();
  for (std::size_t a = 0; a < point.nodes.size(); ++a) {
    const auto slots = model::NodeTable::slots(nodes.reference(), point.nodes[a]);
    place += point.weights[a] * (slots.col(0) + slots.rightCols<3>() * point.offset);
  }
  return place;
}

bool is_sound(const std::vector<Segment>& segments, const Sea& sea, const Options& options,
              model::BuildContext& context) {
  const double bed = -sea.site().depth;
  double lowest = 0.0;
  for (const Segment& segment : segments) {
    for (std::size_t end = 0; end < 2; ++end) {
      const WetSection& section = segment.sections[end];
      if (section.flooded_diameter >= section.diameter) {
        const char* name =
            options.has("Flooded Diameters") ? "Flooded Diameters" : "Flooded Diameter";
        context.issues.add(options.where(name),
                           fmt::format("must be below the outer diameter, {:g} m, got {:g} m",
                                       section.diameter, section.flooded_diameter));
        return false;
      }
      const Vec3 place = place_of(segment.ends[end], context.model.nodes());
      lowest = std::min(lowest, sea.height(place) - bed);
    }
  }
  if (lowest >= -1e-6 * sea.site().depth) return true;
  context.issues.add(options.where(),
                     fmt::format("the member reaches {:.4g} m below the bed of '{}'; let 'Range' "
                                 "end at the bed, and name this end in 'Dry Ends'",
                                 -lowest, options.text("Flow")));
  return false;
}

// A name for what the member of the load is.
std::string name_of_member(const Options& options) {
  if (options.has("Structure")) return options.text("Structure");
  const Vec3 from = model::vector(options, "From"), to = model::vector(options, "To");
  return fmt::format("{} {} {} {} {} {} {}", options.text("Node"), from[0], from[1], from[2], to[0],
                     to[1], to[2]);
}

// Whether no other load of the water acts on the same part of a member.
bool is_alone(const MorisonLoad& load, const Options& options, model::BuildContext& context) {
  for (const auto& batch : context.model.loads()) {
    const auto* other = dynamic_cast<const MorisonLoad*>(batch.get());
    if (other == nullptr || !load.meets(*other)) continue;
    context.issues.add(options.where(options.has("Structure") ? "Structure" : "Node"),
                       fmt::format("{} acts on the same part of this member: two loads would carry "
                                   "the water twice; give each its 'Range'",
                                   other->effect().quoted()));
    return false;
  }
  return true;
}

// Adds an issue where linear potential flow acts on a body that carries the member, unless the deck
// says what of the water the member has all the same, as one that the files do not know.
void refuse_unsaid_beside_bodies(const Options& options, const std::vector<int>& nodes,
                                 flow::FluidContext& context) {
  std::vector<std::string> unsaid;
  const bool presses = options.flag("Buoyancy");
  if (presses && !options.given("Buoyancy")) unsaid.emplace_back("'Buoyancy'");
  if (options.flag("Pull") && !options.given("Pull") && !(presses && unsaid.empty())) {
    unsaid.emplace_back("'Pull'");
  }
  if (!options.has("Added Masses") && !options.given("Added Mass")) {
    unsaid.emplace_back("'Added Mass'");
  }
  if (unsaid.empty()) return;
  context.after_all_loads([&options, nodes, unsaid, &context] {
    for (const auto& batch : context.build.model.loads()) {
      const auto* body = dynamic_cast<const PotentialLoad*>(batch.get());
      if (body == nullptr || std::ranges::count(nodes, body->node()) == 0) continue;
      context.build.issues.add(
          options.where(),
          fmt::format("{} acts on the body that carries this member: say {}; false and 0 where its "
                      "files know the member, whose water would act twice",
                      body->effect().quoted(), join(unsaid, ", ")));
      return;
    }
  });
}

// What the first and the last face of a member have.
std::array<double, 2> of_faces(const char* one, const char* several, const Options& options) {
  if (!options.has(several)) return {options.number(one), options.number(one)};
  const std::vector<double>& values = options.numbers(several);
  return {values[0], values[1]};
}

void make_morison(const Options& options, flow::FluidContext& context) {
  model::BuildContext& build = context.build;
  const auto sea = find_sea(options, context);
  const auto function = model::find_function(options, build);
  const auto member =
      options.has("Structure") ? member_on_line(options, build) : member_on_node(options, build);
  if (!sea || !function || !member) return;
  std::vector<Segment> segments = segments_of(options, *member);
  if (!is_sound(segments, *sea, options, build)) return;
  const MorisonModel model{options.flag("Buoyancy"), of_faces("End Drag", "End Drags", options),
                           of_faces("End Added Mass", "End Added Masses", options),
                           options.flag("Pull")};
  auto load = std::make_unique<MorisonLoad>(model::Effect("Morison", options.name()),
                                            build.model.nodes(), *function, sea, model);
  const std::vector<double>& range = options.numbers("Range");
  load->cover(name_of_member(options), range[0], range[1]);
  if (!is_alone(*load, options, build)) return;
  std::vector<int> nodes;
  for (Segment& segment : segments) {
    for (const model::Marker& end : segment.ends) {
      nodes.insert(nodes.end(), end.nodes.begin(), end.nodes.end());
    }
    load->add(std::move(segment));
  }
  flow::refuse_rotating_frame(options, nodes, context);
  refuse_unsaid_beside_bodies(options, nodes, context);
  for (const auto& batch : build.model.loads()) {
    if (auto* other = dynamic_cast<MorisonLoad*>(batch.get())) load->join(*other);
  }
  build.model.add_load(std::move(load));
}

}  // namespace

void register_water_loads(flow::FluidLoadRegistry& registry) {
  registry.add("Morison", morison_schema(), make_morison);
  register_potential_flow(registry);
}

}  // namespace culm::water
