#include <culm/water/doubts.hpp>
#include <culm/water/morison_load.hpp>
#include <culm/water/potential_load.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace culm::water {
namespace {

bool has_drag_at(int node, const model::Model& model) {
  return std::ranges::any_of(model.loads(), [node](const auto& batch) {
    const auto* morison = dynamic_cast<const MorisonLoad*>(batch.get());
    return morison != nullptr && morison->has_drag() && morison->acts_on(node);
  });
}

std::string without_current(const PotentialLoad& body, const model::Model& model) {
  const Vec3 place = model::NodeTable::slots(model.nodes().reference(), body.node()).col(0);
  const Sea& sea = body.sea();
  const double depth = sea.site().depth;
  const double speed = sea.current().at(std::clamp(sea.height(place), -depth, 0.0)).norm();
  if (speed == 0.0 || has_drag_at(body.node(), model)) return {};
  return fmt::format(
      "{}: the current of its sea, {:.3g} m/s, does not act on the body, since linear potential "
      "flow has no drag; a load 'Morison' on its node brings it, with 'Drag', and with 'Buoyancy' "
      "and 'Pull' = false and 'Added Mass' = 0 where the files have them",
      body.effect().quoted(), speed);
}

std::string without_level(const PotentialLoad& body, const model::Model& model) {
  const Sea& sea = body.sea();
  const double level = sea.site().level;
  const Vec3 place = model::NodeTable::slots(model.nodes().reference(), body.node()).col(0);
  const double height = sea.height(place);
  if (level == 0.0 || std::abs(height) <= 1e-6 * std::abs(level)) return {};
  return fmt::format(
      "{}: 'Level' of its sea, {:g} m, neither lifts nor lowers the body: it floats as in its "
      "files, with the node, {:.4g} m {} still water, where their origin is; let it start at the "
      "height where it floats",
      body.effect().quoted(), level, std::abs(height), height > 0.0 ? "above" : "below");
}

}  // namespace

std::vector<std::string> left_out_of_bodies(const model::Model& model) {
  std::vector<std::string> sentences;
  for (const auto& batch : model.loads()) {
    const auto* body = dynamic_cast<const PotentialLoad*>(batch.get());
    if (body == nullptr) continue;
    for (std::string sentence : {without_current(*body, model), without_level(*body, model)}) {
      if (!sentence.empty()) sentences.push_back(std::move(sentence));
    }
  }
  return sentences;
}

}  // namespace culm::water
