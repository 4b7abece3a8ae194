#include "gravity_and_sea.hpp"

#include <culm/math/types.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace culm::simulation {
namespace {

constexpr double largest_angle = 0.01;  // [rad]
constexpr double largest_difference = 0.01;

bool is_sea(const Options& flow) {
  return std::ranges::any_of(flow.parameters(),
                             [](const auto& one) { return one.name == "Gravity"; });
}

Vec3 vector(const Options& options, const char* name) { return Vec3(options.numbers(name).data()); }

std::string objection(const Options& load, const Options& sea) {
  const Vec3 pull = vector(load, "Acceleration");
  if (pull.isZero(0.0)) return {};
  const Vec3 down = Vec3::Zero() - vector(sea, "Up").normalized();
  const std::string who =
      fmt::format("Loads / {} pulls with {:.6g} m/s^2", load.name(), pull.norm());
  if ((pull.normalized() - down).norm() > largest_angle) {
    return fmt::format(
        "{} along ({:.4g}, {:.4g}, {:.4g}), but in Flows / {} ({:.4g}, {:.4g}, "
        "{:.4g}) is down: weight and buoyancy do not act along one line",
        who, pull[0], pull[1], pull[2], sea.name(), down[0], down[1], down[2]);
  }
  const double gravity = sea.number("Gravity");
  if (std::abs(pull.norm() - gravity) <= largest_difference * gravity) return {};
  return fmt::format("{}, but Flows / {} has Gravity = {:.6g}: weight and buoyancy do not match",
                     who, sea.name(), gravity);
}

}  // namespace

std::vector<std::string> weights_that_miss_seas(const Options& deck, const Options& analysis) {
  const std::vector<std::string>& inactive = analysis.texts("Inactive");
  std::vector<std::string> sentences;
  for (const Options& load : deck.list("Loads").entries()) {
    if (load.text("Type") != "Gravity") continue;
    if (std::ranges::find(inactive, load.name()) != inactive.end()) continue;
    for (const Options& flow : deck.list("Flows").entries()) {
      if (!is_sea(flow)) continue;
      std::string sentence = objection(load, flow);
      if (!sentence.empty()) sentences.push_back(std::move(sentence));
    }
  }
  return sentences;
}

}  // namespace culm::simulation
