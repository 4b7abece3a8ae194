#include <culm/parallel/owned_numbers.hpp>
#include <culm/simulation/quantity.hpp>

#include "place.hpp"

#include <Eigen/Geometry>

#include <algorithm>
#include <array>
#include <utility>

namespace culm::simulation {
namespace {

// Position and directors of a material point.
Eigen::Matrix<double, 3, 4> slots_at(const model::Marker& marker, const model::Coordinates& q) {
  Eigen::Matrix<double, 3, 4> slots = Eigen::Matrix<double, 3, 4>::Zero();
  for (std::size_t a = 0; a < marker.nodes.size(); ++a) {
    slots += marker.weights[a] * model::NodeTable::slots(q, marker.nodes[a]);
  }
  return slots;
}

// Force and moment in a section of a beam. The mean resultants of elements are those of their
// centres to second order; between them, and on to kinks and ends, the vectors in space are linear.
// Of an element between two kinks the force is that everywhere, and the moment has its arm.
class SectionLoads final : public Quantity {
 public:
  enum class Axes { section, space, frame };
  struct Source {
    model::Cell cell;
    model::Marker centre;
    double weight;
  };

  SectionLoads(std::vector<Source> sources, model::Marker station, Axes axes, int frame)
      : sources_(std::move(sources)), station_(std::move(station)), axes_(axes), frame_(frame) {}

  std::vector<output::HistoryColumn> columns() const override {
    std::vector<output::HistoryColumn> columns;
    for (const auto& [letter, unit] : {std::pair{"F", "N"}, {"M", "N m"}}) {
      for (const char* axis :
           axes_ == Axes::space ? std::array{"x", "y", "z"} : std::array{"1", "2", "3"}) {
        columns.push_back({std::string(letter) + axis, unit});
      }
    }
    return columns;
  }
  std::optional<std::vector<int>> nodes() const override {
    std::vector<int> nodes = station_.nodes;
    for (const Source& source : sources_) {
      nodes.insert(nodes.end(), source.centre.nodes.begin(), source.centre.nodes.end());
    }
    if (axes_ == Axes::frame) nodes.push_back(frame_);
    return nodes;
  }
  void evaluate(const assembly::System& system, const model::State& state,
                std::vector<double>& numbers) const override {
    const auto cell_of = [&](int i) -> const model::Cell& {
      return sources_[static_cast<std::size_t>(i)].cell;
    };
    const std::vector<double> resultants = parallel::share_owned(
        system.comm(), sources_.size(), 6,
        [&](int i) { return cell_of(i).source->owns(cell_of(i).item); },
        [&](int i, std::vector<double>& values) {
          cell_of(i).source->resultants(cell_of(i).item, state.next, values);
        });
    Vec3 force = Vec3::Zero();
    Vec3 moment = Vec3::Zero();
    for (std::size_t i = 0; i < sources_.size(); ++i) {
      const Source& source = sources_[i];
      const Mat3 directors = slots_at(source.centre, state.next).rightCols<3>();
      force += source.weight * directors * Vec3(resultants.data() + 6 * i);
      moment += source.weight * directors * Vec3(resultants.data() + 6 * i + 3);
    }
    if (sources_.size() == 1) {
      const Vec3 arm =
          (slots_at(sources_.front().centre, state.next) - slots_at(station_, state.next)).col(0);
      moment += arm.cross(force);
    }
    const Mat3 axes = axes_in(state.next);
    for (const Vec3& vector : {force, moment}) {
      const Vec3 shown = axes.transpose() * vector;
      numbers.insert(numbers.end(), shown.begin(), shown.end());
    }
  }

 private:
  Mat3 axes_in(const model::Coordinates& q) const {
    if (axes_ == Axes::space) return Mat3::Identity();
    if (axes_ == Axes::frame) return model::NodeTable::slots(q, frame_).rightCols<3>();
    return slots_at(station_, q).rightCols<3>();
  }

  std::vector<Source> sources_;
  model::Marker station_;
  Axes axes_;
  int frame_;
};

// Where elements end, as fractions of the length.
std::vector<double> ends_of(const model::Structure& beam) {
  const std::size_t per_element = beam.line_points.size() / beam.cells.size();
  std::vector<double> ends(beam.cells.size(), 0.0);
  double length = 0.0;
  for (std::size_t k = 0; k < beam.line_points.size(); ++k) {
    length += beam.line_points.length(k);
    ends[k / per_element] = length;
  }
  for (double& end : ends) end /= length;
  return ends;
}

// At a kink the next element has a node of its own.
bool go_on(const model::Cell& cell, const model::Cell& next) {
  return cell.nodes[cell.nodes.size() - 1] == next.nodes.front();
}

// Of which elements about a station.
enum class Side { both, before, after };

// The two elements whose centres lie about the station, or nearest to it on a side of it, and their
// weights; none is beyond a kink.
std::vector<SectionLoads::Source> find_sources(const model::Structure& beam, double station,
                                               Side side) {
  const std::vector<double> ends = ends_of(beam);
  const auto centre = [&](std::size_t i) { return 0.5 * ((i == 0 ? 0.0 : ends[i - 1]) + ends[i]); };
  const auto source = [&](std::size_t i, double weight) {
    return SectionLoads::Source{beam.cells[i], *marker_at_fraction(beam, centre(i)), weight};
  };
  const double sought = station + (side == Side::after ? 1e-12 : -1e-12);
  const auto here = static_cast<std::size_t>(
      std::lower_bound(ends.begin(), ends.end() - 1, sought) - ends.begin());
  const bool has_before =
      side != Side::after && here > 0 && go_on(beam.cells[here - 1], beam.cells[here]);
  const bool has_next = side != Side::before && here + 1 < ends.size() &&
                        go_on(beam.cells[here], beam.cells[here + 1]);
  if (!has_before && !has_next) return {source(here, 1.0)};
  const bool is_behind = has_before && (!has_next || station <= centre(here));
  const std::size_t i = is_behind ? here : here + 1;
  const double weight = (station - centre(i - 1)) / (centre(i) - centre(i - 1));
  return {source(i - 1, 1.0 - weight), source(i, weight)};
}

std::unique_ptr<Quantity> make_section_loads(const Options& options, model::BuildContext& context) {
  const model::Structure* beam = model::select_structure(options, context);
  if (beam == nullptr) return nullptr;
  const bool is_beam = !beam->line_points.empty() && beam->cells.front().source != nullptr;
  if (!is_beam || beam->cells.front().source->resultant_names().size() != 6) {
    context.issues.add(options.where("Structure"),
                       "structure '" + beam->name +
                           "' does not have the six stress resultants of a beam of 'Fidelity' Full "
                           "or Linear, with torsion");
    return nullptr;
  }
  int frame = -1;
  auto axes =
      options.text("Axes") == "Space" ? SectionLoads::Axes::space : SectionLoads::Axes::section;
  if (options.has("Frame")) {
    const std::optional<int> node = read_node(options, "Frame", context);
    if (!node || !has_triad(*node, "Frame", options, context)) return nullptr;
    frame = *node;
    axes = SectionLoads::Axes::frame;
  }
  const double station = options.number("Station");
  const std::string& named = options.text("Side");
  const Side side = named == "Before" ? Side::before : named == "After" ? Side::after : Side::both;
  return std::make_unique<SectionLoads>(find_sources(*beam, station, side),
                                        *marker_at_fraction(*beam, station), axes, frame);
}

}  // namespace

void register_section_loads(QuantityRegistry& registry) {
  Schema schema("Section Loads",
                "Force and moment in a section of a beam, by which the part beyond it, towards the "
                "last node, acts on the part before; linear between the centres of elements, not "
                "beyond kinks.");
  schema.add(model::structure_field())
      .add(number("Station", "",
                  "Place of the section as a fraction of the length: 0 at the first node, 1 at the "
                  "last.")
               .between(0.0, 1.0))
      .add(choice("Side", {"Both", "Before", "After"},
                  "Of which elements: those about the section, or, where a force, mass or joint at "
                  "a node makes a jump, those on one side of it.")
               .optional("Both"))
      .add(choice("Axes", {"Section", "Space"}, "The directors of the section, or space.")
               .optional("Section"))
      .add(text("Frame", "Or a node whose directors are the axes.").optional())
      .check([](const Options& options, InputIssues& issues) {
        if (options.has("Frame") && options.given("Axes")) {
          issues.add(options.where("Axes"), "'Frame' gives the axes already");
        }
      });
  registry.add("Section Loads", std::move(schema), make_section_loads);
}

}  // namespace culm::simulation
