#include "turbine_report.hpp"

#include <culm/math/quadrature.hpp>

#include "headings.hpp"
#include "turbine_cantilevers.hpp"

#include <fmt/format.h>

#include <cmath>
#include <cstddef>
#include <numbers>

namespace culm::openfast {
namespace {

// ElastoDyn adds up the masses at the middles of equal parts, which makes the mass that its factor
// was chosen for.
void report_midpoint_mass(const ElastoDyn& turbine, Report& report) {
  for (std::size_t i = 0; i < turbine.blades.size() && turbine.blade_nodes > 0; ++i) {
    const Cantilever blade = blade_cantilever(turbine.blades[i].beam, 3);
    double sum = 0.0;
    for (int node = 0; node < turbine.blade_nodes; ++node) {
      sum += blade.mass((node + 0.5) / turbine.blade_nodes) * blade.length / turbine.blade_nodes;
    }
    report.add(masses, fmt::format("blade {}: ElastoDyn's sum over {} midpoints is {:.6g} kg",
                                   i + 1, turbine.blade_nodes, sum));
  }
}

}  // namespace

std::string why_locked(const ElastoDyn& turbine) {
  if (!turbine.yaw_is_free) return "Yaw is locked, as YawDOF says.";
  return turbine.yaw_drive
             ? "Yaw is locked although YawDOF is True: YawSpr is zero."
             : "Yaw is locked although YawDOF is True: its spring stands in ServoDyn's "
               "file, which was not given.";
}

void report_yaw(const ElastoDyn& turbine, const TurbineLayout& layout, Report& report) {
  constexpr double two_pi = 2.0 * std::numbers::pi;
  const double inertia = yaw_inertia(turbine, layout);
  const double tower = torsion_stiffness(turbine);
  const double locked = std::sqrt(tower / inertia) / two_pi;
  const std::string head = fmt::format(
      "head of {:.4g} kg m^2 about the yaw axis, rotor rigid, on the tower's torsion of "
      "{:.4g} N m/rad: {:.4g} Hz",
      inertia, tower, locked);
  if (turbine.yaws()) {
    const double spring = turbine.yaw_drive->stiffness;
    report.add(frequencies,
               fmt::format("{} with yaw locked, {:.4g} Hz with its spring, {:.4g} Hz by the spring "
                           "alone",
                           head, locked / std::sqrt(1.0 + tower / spring),
                           std::sqrt(spring / inertia) / two_pi));
    if (turbine.yaw != turbine.yaw_drive->neutral) {
      report.add(not_used, "NacYaw: the nacelle stands at YawNeut");
    }
    return;
  }
  report.add(frequencies, head + " with yaw locked");
  if (!turbine.yaw_is_free) {
    report.add(assumed, why_locked(turbine));
    return;
  }
  report.add(missing,
             fmt::format("{} Name it by --servodyn. A spring of {:.3g} N m/rad, as stiff as the "
                         "tower, would lower "
                         "this frequency by 29 % to {:.4g} Hz, and modes in which the rotor "
                         "yaws with it; one ten times as stiff by 5 %",
                         why_locked(turbine), tower, locked / std::sqrt(2.0)));
}

void report_masses(const ElastoDyn& turbine, Report& report) {
  double rotor = turbine.hub_mass;
  for (std::size_t i = 0; i < turbine.blades.size(); ++i) {
    rotor += blade_mass(turbine.blades[i].beam) + turbine.tip_masses[i];
  }
  const Cantilever cantilever = tower_cantilever(turbine, &TowerStation::fore_aft);
  double tower = 0.0;
  double moment = 0.0;
  const double height = turbine.tower_top - turbine.tower_base;
  const auto& stations = turbine.tower.stations;
  for (std::size_t i = 0; i + 1 < stations.size(); ++i) {
    const double half = 0.5 * (stations[i + 1].height - stations[i].height);
    for (const QuadraturePoint& point : gauss_legendre(2)) {  // exact for the moment
      const double x = stations[i].height + half * (1.0 + point.xi);
      tower += half * point.weight * height * cantilever.mass(x);
      moment += half * point.weight * height * height * x * cantilever.mass(x);
    }
  }
  report.add(masses, fmt::format("tower: {:.6g} kg, centre {:.5g} m above its base", tower,
                                 moment / tower));
  report.add(masses,
             fmt::format("nacelle {:g} kg, hub {:g} kg, rotor {:.6g} kg, head of the tower "
                         "{:.6g} kg",
                         turbine.nacelle_mass, turbine.hub_mass, rotor, head_mass(turbine)));
  report_midpoint_mass(turbine, report);
}

}  // namespace culm::openfast
