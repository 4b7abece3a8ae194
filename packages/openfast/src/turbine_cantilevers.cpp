#include "turbine_cantilevers.hpp"

#include <culm/math/quadrature.hpp>

#include "blade_axis.hpp"
#include "headings.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <numbers>

namespace culm::openfast {

namespace {

constexpr double two_pi = 2.0 * std::numbers::pi;

// Linear between stations.
template <class Station, class Place, class Value>
std::function<double(double)> along(const std::vector<Station>& stations, Place place,
                                    Value value) {
  return [=](double x) {
    std::size_t i = 1;
    while (i + 1 < stations.size() && place(stations[i]) < x) ++i;
    const double a = place(stations[i - 1]);
    const double t = (x - a) / (place(stations[i]) - a);
    return (1.0 - t) * value(stations[i - 1]) + t * value(stations[i]);
  };
}

double span_of(const BladeStation& station) { return station.span; }
double height_of(const TowerStation& station) { return station.height; }

// The time by which stress runs ahead of strain, so that the first mode has its damping:
// zeta = eta omega / 2. Of the second mode the report tells what that makes of it.
double find_damping(const Cantilever& cantilever, const FileModes& modes, const std::string& what,
                    Report& report) {
  const double omega = rayleigh(cantilever, modes.first);
  const double eta = 2.0 * modes.first.damping / omega;
  report.add(frequencies,
             fmt::format("{}, {}: {:.4f} Hz; damping {:.4g} of the critical one, "
                         "eta = {:.4g} s",
                         what, modes.first.name, omega / two_pi, modes.first.damping, eta));
  if (modes.second && eta > 0.0) {
    const double higher = rayleigh(cantilever, *modes.second);
    report.add(frequencies, fmt::format("{}, {}: {:.4f} Hz; damping {:.4g} in the file, {:.4g} by "
                                        "this eta",
                                        what, modes.second->name, higher / two_pi,
                                        modes.second->damping, 0.5 * eta * higher));
  }
  return eta;
}

}  // namespace

Cantilever blade_cantilever(const BeamDyn& beam, int bending) {
  Cantilever cantilever;
  cantilever.length = (beam.key_points.back().position - beam.key_points.front().position).norm();
  for (const BladeStation& station : beam.blade.stations) cantilever.places.push_back(station.span);
  cantilever.mass = along(beam.blade.stations, span_of,
                          [](const BladeStation& station) { return station.mass(0, 0); });
  cantilever.stiffness = along(beam.blade.stations, span_of, [=](const BladeStation& station) {
    return station.stiffness(bending, bending);
  });
  return cantilever;
}

Cantilever tower_cantilever(const ElastoDyn& turbine, double TowerStation::*stiffness) {
  Cantilever cantilever;
  cantilever.length = turbine.tower_top - turbine.tower_base;
  for (const TowerStation& station : turbine.tower.stations) {
    cantilever.places.push_back(station.height);
  }
  cantilever.mass = along(turbine.tower.stations, height_of,
                          [](const TowerStation& station) { return station.mass; });
  cantilever.stiffness = along(turbine.tower.stations, height_of,
                               [=](const TowerStation& station) { return station.*stiffness; });
  cantilever.tip_mass = head_mass(turbine);
  return cantilever;
}

double blade_mass(const BeamDyn& beam) {
  return integrate_mass(BladeAxis(beam.key_points), beam.blade.stations).mass;
}

double head_mass(const ElastoDyn& turbine) {
  double mass = turbine.yaw_bearing_mass + turbine.nacelle_mass + turbine.hub_mass;
  for (const ElastoDynBlade& blade : turbine.blades) mass += blade_mass(blade.beam);
  for (const double tip : turbine.tip_masses) mass += tip;
  return mass;
}

double torsion_of(const TowerStation& station) {
  constexpr double nu = 0.3;
  return station.torsion.value_or((station.fore_aft + station.side_side) / (2.0 * (1.0 + nu)));
}

double torsion_stiffness(const ElastoDyn& turbine) {
  const auto& stations = turbine.tower.stations;
  const double height = turbine.tower_top - turbine.tower_base;
  const auto torsion = along(stations, height_of, torsion_of);
  double compliance = 0.0;
  for (std::size_t i = 0; i + 1 < stations.size(); ++i) {
    const double half = 0.5 * (stations[i + 1].height - stations[i].height);
    for (const QuadraturePoint& point : gauss_legendre(6)) {
      const double x = stations[i].height + half * (1.0 + point.xi);
      compliance += half * point.weight * height / torsion(x);
    }
  }
  return 1.0 / compliance;
}

void find_blade_damping(ElastoDyn& turbine, Report& report) {
  report.add(frequencies,
             "Rayleigh quotients of the mode shapes in the files, without rotation and "
             "weight; blades clamped, tower with the mass of its head");
  for (std::size_t i = 0; i < turbine.blades.size(); ++i) {
    ElastoDynBlade& blade = turbine.blades[i];
    const std::string name = fmt::format("blade {}", i + 1);
    const double edge = find_damping(blade_cantilever(blade.beam, 3), blade.edge, name, report);
    const double flap = find_damping(blade_cantilever(blade.beam, 4), blade.flap, name, report);
    auto& damping = blade.beam.blade.damping;
    const bool given =
        std::any_of(damping.begin(), damping.end(), [](double d) { return d != 0.0; });
    const double other = std::min(edge, flap);
    if (!given) damping = {other, other, other, edge, flap, other};
  }
  report.add(assumed,
             "blades: stretch, shear and twist, of whose damping ElastoDyn says nothing, by the "
             "smaller factor of both bendings");
}

std::vector<double> find_tower_damping(const ElastoDyn& turbine, Report& report) {
  const auto& tower = turbine.tower;
  const double fa = find_damping(tower_cantilever(turbine, &TowerStation::fore_aft), tower.fore_aft,
                                 "tower", report);
  const double ss = find_damping(tower_cantilever(turbine, &TowerStation::side_side),
                                 tower.side_side, "tower", report);
  const double other = std::min(fa, ss);
  report.add(
      assumed,
      "tower: damping of fore-aft and side-to-side bending fits the first modes; higher ones "
      "are damped in proportion to their frequency, stretch, shear and twist by the smaller "
      "factor");
  if (other == 0.0 && fa == ss) return {};
  return {other, other, other, ss, fa, other};
}

}  // namespace culm::openfast
