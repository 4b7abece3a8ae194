#include "blade_lists.hpp"

#include "degree.hpp"
#include "headings.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace culm::openfast {

namespace {

std::vector<std::string> section_names(const std::string& name, std::size_t count) {
  std::vector<std::string> names;
  for (std::size_t i = 1; i <= count; ++i) names.push_back(fmt::format("{} {}", name, i));
  return names;
}

bool is_damped(const BeamDynBlade& blade) {
  return std::any_of(blade.damping.begin(), blade.damping.end(),
                     [](double value) { return value != 0.0; });
}

// Whether strains of different factors act on each other.
bool is_coupled(const BeamDynBlade& blade) {
  for (const BladeStation& station : blade.stations) {
    for (int i = 0; i < 6; ++i) {
      for (int j = 0; j < i; ++j) {
        if (station.stiffness(i, j) != 0.0 && blade.damping[static_cast<std::size_t>(i)] !=
                                                  blade.damping[static_cast<std::size_t>(j)]) {
          return true;
        }
      }
    }
  }
  return false;
}

std::vector<double> spans_of(const std::vector<BladeStation>& stations) {
  std::vector<double> spans;
  for (const BladeStation& station : stations) spans.push_back(station.span);
  return spans;
}

}  // namespace

void write_sections(const std::string& name, const BeamDynBlade& blade, DeckWriter& deck) {
  const auto names = section_names(name, blade.stations.size());
  for (std::size_t i = 0; i < names.size(); ++i) {
    const Mat6& mass = blade.stations[i].mass;
    deck.open(names[i], "Stiffness Matrix");
    deck.set_triangle("Stiffness", blade.stations[i].stiffness);
    deck.set("rhoA", mass(0, 0));
    deck.set("rhoI1", mass(3, 3));
    deck.set("rhoI2", mass(4, 4));
    if (mass(2, 3) != 0.0) deck.set("rhoS1", mass(2, 3));
    if (mass(2, 4) != 0.0) deck.set("rhoS2", -mass(2, 4));
    if (mass(3, 4) != 0.0) deck.set("rhoI12", -mass(3, 4));
    deck.close();
  }
}

void write_beam(const std::string& name, const std::string& sections, const BeamDyn& beam,
                const Placement& placement, const BladeMesh& mesh, DeckWriter& deck) {
  const BladeAxis axis(beam.key_points);
  const auto place = [&](const Vec3& x) -> Vec3 { return placement.root + placement.axes * x; };
  deck.open(name, "Beam");
  deck.set("Sections", section_names(sections, beam.blade.stations.size()));
  deck.set("Section Positions", spans_of(beam.blade.stations));
  deck.set("Order", mesh.order);
  const auto& damping = beam.blade.damping;
  if (is_damped(beam.blade)) {
    deck.set("Strain Damping", std::vector<double>(damping.begin(), damping.end()));
  }
  deck.open("Curve", axis.straight ? "Line" : "Spline");
  if (axis.straight) {
    deck.set("From", place(beam.key_points.front().position));
    deck.set("To", place(beam.key_points.back().position));
  } else {
    std::vector<double> points;
    for (const KeyPoint& point : beam.key_points) {
      const Vec3 x = place(point.position);
      points.insert(points.end(), x.data(), x.data() + 3);
    }
    deck.set("Points", points);
  }
  deck.set("Up", Vec3(placement.axes.col(0)));
  deck.set_degrees("Pre-Twist", axis.angles);
  deck.set("Pre-Twist Positions", axis.spans);
  deck.set("Elements", mesh.elements);
  deck.close();
  deck.close();
}

void report_conventions(Report& report) {
  for (const char* line :
       {"axes: x towards the suction side (flap, downwind), y towards the trailing edge (edge), z "
        "from root to tip; as in culm d1, d2, d3",
        "6x6 stiffness: shear x, shear y, stretch, bending about x (edge), about y (flap), twist; "
        "the order of culm, no sign changes",
        "6x6 mass: rhoI1 = entry (4, 4), rhoI2 = (5, 5), rhoS1 = m y_cm = (3, 4), rhoS2 = m x_cm = "
        "-(3, 5), rhoI12 = -(4, 5)",
        "initial_twist turns about -z: Pre-Twist = -initial_twist; linear between key points in "
        "culm, cubic over z in BeamDyn",
        "a curved axis is a natural cubic spline over chord length in culm, over z in BeamDyn; "
        "sections are normal to its tangent",
        "stations lie at fractions of the arc length; sections vary linearly between them"}) {
    report.add(conventions, line);
  }
}

void report_blade(const std::string& name, const BeamDyn& beam, Report& report) {
  const BladeAxis axis(beam.key_points);
  const BladeMass mass = integrate_mass(axis, beam.blade.stations);
  const Vec3 centre = mass.first / mass.mass;
  report.add(masses, fmt::format("{}: length {:.6g} m, mass {:.6g} kg", name, axis.curve.length(),
                                 mass.mass));
  report.add(masses, fmt::format("  centre of mass from the root, without offsets of sections: "
                                 "({:.5g}, {:.5g}, {:.5g}) m",
                                 centre.x(), centre.y(), centre.z()));
  report.add(masses, fmt::format("  about the root: first moment {:.6g} kg m, second {:.6g} kg m^2",
                                 mass.first.z(), mass.second));
  const auto [least, most] = std::minmax_element(axis.angles.begin(), axis.angles.end());
  report.add(checked,
             fmt::format("axis: {}, Pre-Twist from {:.5g} to {:.5g} degrees",
                         axis.straight ? "straight" : "curved", *least / degree, *most / degree));
  const auto& mu = beam.blade.damping;
  if (is_damped(beam.blade)) {
    report.add(checked,
               fmt::format("damping: ({:.4g}, {:.4g}, {:.4g}, {:.4g}, {:.4g}, {:.4g}) s for "
                           "shear x and y, stretch, bending about x and y, twist",
                           mu[0], mu[1], mu[2], mu[3], mu[4], mu[5]));
  }
  if (is_damped(beam.blade) && is_coupled(beam.blade)) {
    report.add(assumed,
               "damping of coupled sections: sqrt(mu) C sqrt(mu), which takes energy whatever the "
               "couplings; BeamDyn has mu C, the same on the diagonal");
  }
}

}  // namespace culm::openfast
