/// Points that a history watches.
#pragma once

#include <culm/model/build_context.hpp>

#include <optional>
#include <string>

namespace culm::simulation {

/// A point fixed to a node, seen from space or from an observer who moves with another node: at its
/// position, with its directors as axes.
struct Place {
  int node = -1;
  Vec3 offset = Vec3::Zero();  ///< in the directors of the node [m]
  int frame = -1;              ///< node of the observer; space if negative

  /// Position in space.
  Vec3 position(const model::Coordinates& q) const;
  /// Position as the observer sees it.
  Vec3 seen_position(const model::Coordinates& q) const;
  /// Its rate; zero in statics, which have no velocity.
  Vec3 seen_velocity(const model::State& state) const;
  /// Directors of the node as the observer sees them. @pre both nodes have triads
  Mat3 seen_directors(const model::Coordinates& q) const;
  /// Angular velocity of the node as the observer sees it [rad/s]; zero in statics. @pre as above
  Vec3 seen_spin(const model::State& state) const;
};

/// Angular velocity of a node with a triad, in space: half the sum of d_k x d(d_k)/dt; zero in
/// statics.
Vec3 spin(int node, const model::State& state);

/// "Offset", from the node to the point.
Field offset_field(const std::string& name = "Offset");
/// "Frame", the node of the observer.
Field frame_field();

/// The only node that a parameter names; nothing, and an issue, if there is none.
std::optional<int> read_node(const Options& options, const std::string& parameter,
                             model::BuildContext& context);
/// Whether a node has a triad; an issue says if it does not.
bool has_triad(int node, const std::string& parameter, const Options& options,
               model::BuildContext& context);
/// The point of "Node" with "Offset" and "Frame", as far as they are declared; nothing, and an
/// issue, if a node is missing or the observer's has no triad.
std::optional<Place> read_place(const Options& options, bool has_offset, bool has_frame,
                                model::BuildContext& context);

}  // namespace culm::simulation
