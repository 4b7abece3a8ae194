#include "turbine_base.hpp"

#include <culm/base/text.hpp>

#include "tower_bending.hpp"
#include "turbine_cantilevers.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <numbers>

namespace culm::openfast {

namespace {

constexpr const char* freedoms[] = {"surge", "sway", "heave", "roll", "pitch", "yaw"};

// Lengths above a hand's breadth count.
constexpr double least_height = 0.1;

double lowest(const ElastoDyn& turbine) { return std::min(turbine.platform.reference.z(), 0.0); }

std::vector<std::string> free_names(const Platform& platform) {
  std::vector<std::string> names;
  for (std::size_t i = 0; i < platform.free.size(); ++i) {
    if (platform.free[i]) names.emplace_back(freedoms[i]);
  }
  return names;
}

double hertz(double omega) { return omega / (2.0 * std::numbers::pi); }

// Clamped, and on what can be said of the base.
std::vector<std::string> estimate(const ElastoDyn& turbine) {
  const Platform& platform = turbine.platform;
  const Cantilever tower = tower_cantilever(turbine, &TowerStation::fore_aft);
  const double clamped = first_bending(tower);
  std::vector<std::string> lines{
      fmt::format("first fore-aft bending of the tower with the mass of its head as a point, "
                  "without weight: {:.4f} Hz clamped at its base",
                  hertz(clamped))};
  if (platform.free[0] && platform.free[4] && platform.mass > 0.0) {
    const double depth = turbine.tower_base - platform.centre.z();
    const double afloat =
        first_bending(tower, FloatingBase{platform.mass, platform.inertia.y(), depth});
    lines.push_back(
        fmt::format("  {:.4f} Hz on the platform of {:g} kg afloat, without water and "
                    "moorings ({:+.0f} %)",
                    hertz(afloat), platform.mass, 100.0 * (afloat / clamped - 1.0)));
  }
  const double below = turbine.tower_base - lowest(turbine);
  if (below > least_height && free_names(platform).empty()) {
    const double longer = first_bending(extended(tower, below));
    lines.push_back(
        fmt::format("  {:.4f} Hz if its lowest section went down to z = {:g} m and were "
                    "clamped there ({:+.0f} %); soil makes it softer",
                    hertz(longer), lowest(turbine), 100.0 * (longer / clamped - 1.0)));
  }
  return lines;
}

}  // namespace

bool stands_on_more(const ElastoDyn& turbine) {
  const Platform& platform = turbine.platform;
  if (turbine.substructure || turbine.floater) return !platform.modules.empty();
  return turbine.tower_base - lowest(turbine) > least_height || platform.mass > 0.0 ||
         !free_names(platform).empty() || !platform.modules.empty();
}

std::vector<std::string> describe_base(const ElastoDyn& turbine) {
  const Platform& platform = turbine.platform;
  if (turbine.substructure || turbine.floater) {
    return {"modules that carry it, not imported: " + join(platform.modules, ", ")};
  }
  std::vector<std::string> lines{
      fmt::format("the tower is clamped at its base, z = {:g} m", turbine.tower_base)};
  if (turbine.tower_base - lowest(turbine) > least_height) {
    lines.push_back(fmt::format("what is between there and z = {:g} m is not in ElastoDyn's files",
                                lowest(turbine)));
  }
  if (const auto names = free_names(platform); !names.empty()) {
    lines.push_back("the platform moves in " + join(names, ", ") +
                    ": held here, for what restores it (water, moorings, soil) is not imported");
  }
  if (!platform.modules.empty()) {
    lines.push_back("modules that carry it, not imported: " + join(platform.modules, ", "));
  }
  if (platform.mass > 0.0) {
    lines.push_back(
        fmt::format("the platform of {:g} kg is the body 'platform', held by the "
                    "constraint 'foundation': put springs in its place",
                    platform.mass));
  }
  const auto numbers = estimate(turbine);
  lines.insert(lines.end(), numbers.begin(), numbers.end());
  return lines;
}

void write_platform(const ElastoDyn& turbine, DeckWriter& deck) {
  const Platform& platform = turbine.platform;
  if (!(platform.mass > 0.0)) return;
  deck.open("platform", "Rigid Body");
  deck.set("Position", platform.reference);
  deck.set("Mass", platform.mass);
  deck.set("Centre", Vec3(platform.centre - platform.reference));
  deck.set("Inertia", platform.inertia);
  deck.close();
}

}  // namespace culm::openfast
