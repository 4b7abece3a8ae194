#include "place.hpp"

#include <culm/model/one_director.hpp>

#include <Eigen/Geometry>

#include <span>

namespace culm::simulation {

using model::NodeTable;

Vec3 Place::position(const model::Coordinates& q) const {
  const auto slots = NodeTable::slots(q, node);
  return slots.col(0) + slots.rightCols<3>() * offset;
}

Vec3 Place::seen_position(const model::Coordinates& q) const {
  if (frame < 0) return position(q);
  const auto observer = NodeTable::slots(q, frame);
  return observer.rightCols<3>().transpose() * (position(q) - observer.col(0));
}

Vec3 Place::seen_velocity(const model::State& state) const {
  if (state.velocity.empty()) return Vec3::Zero();
  const Vec3 velocity = position(state.velocity);  // linear in the coordinates, as the position is
  if (frame < 0) return velocity;
  const auto observer = NodeTable::slots(state.next, frame);
  const auto moves = NodeTable::slots(state.velocity, frame);
  return observer.rightCols<3>().transpose() * (velocity - moves.col(0)) +
         moves.rightCols<3>().transpose() * (position(state.next) - observer.col(0));
}

Mat3 Place::seen_directors(const model::Coordinates& q) const {
  const Mat3 directors = NodeTable::slots(q, node).rightCols<3>();
  if (frame < 0) return directors;
  return NodeTable::slots(q, frame).rightCols<3>().transpose() * directors;
}

Vec3 Place::seen_spin(const model::State& state) const {
  if (frame < 0) return spin(node, state);
  const Mat3 axes = NodeTable::slots(state.next, frame).rightCols<3>();
  return axes.transpose() * (spin(node, state) - spin(frame, state));
}

Vec3 spin(int node, const model::State& state) {
  if (state.velocity.empty()) return Vec3::Zero();
  const Mat3 directors = NodeTable::slots(state.next, node).rightCols<3>();
  const Mat3 rates = NodeTable::slots(state.velocity, node).rightCols<3>();
  Vec3 sum = Vec3::Zero();
  for (int k = 0; k < 3; ++k) sum += directors.col(k).cross(rates.col(k));
  return 0.5 * sum;
}

Field offset_field(const std::string& name) {
  return model::vector_field(name, "m", "From the node to the watched point, in its directors.")
      .optional({0.0, 0.0, 0.0});
}

Field frame_field() {
  return text(
             "Frame",
             "Node of an observer who moves with it: the values are what is seen from there, along "
             "the directors of this node; from space if absent.")
      .optional();
}

std::optional<int> read_node(const Options& options, const std::string& parameter,
                             model::BuildContext& context) {
  const std::vector<int> nodes = model::select_nodes(options, parameter, context);
  if (nodes.size() > 1) {
    context.issues.add(options.where(parameter),
                       "names " + std::to_string(nodes.size()) + " nodes, but one is watched");
  }
  return nodes.size() == 1 ? std::optional(nodes.front()) : std::nullopt;
}

bool has_triad(int node, const std::string& parameter, const Options& options,
               model::BuildContext& context) {
  if (context.model.nodes().kind(node) == NodeKind::node12) return true;
  context.issues.add(options.where(parameter), "node '" + context.model.node_name(node) +
                                                   "' is one of a shell and has no triad, by which "
                                                   "its turns are known");
  return false;
}

std::optional<Place> read_place(const Options& options, bool has_offset, bool has_frame,
                                model::BuildContext& context) {
  const std::optional<int> node = read_node(options, "Node", context);
  if (!node) return {};
  Place place{*node, Vec3::Zero(), -1};
  if (has_offset) {
    place.offset = model::vector(options, "Offset");
    model::check_components("Offset", std::span(&*node, 1), options, context);
  }
  if (!has_frame || !options.has("Frame")) return place;
  const std::optional<int> frame = read_node(options, "Frame", context);
  if (!frame || !has_triad(*frame, "Frame", options, context)) return {};
  place.frame = *frame;
  return place;
}

}  // namespace culm::simulation
