/// What joints between two points share: points and vectors fixed to each, and reading the deck.
#pragma once

#include <culm/joint/anchor.hpp>
#include <culm/model/build_context.hpp>

#include <array>
#include <functional>
#include <optional>
#include <string>

namespace culm::joint {

/// Two anchors and a point in the reference that a joint puts on both.
class MarkerPair {
 public:
  /// @param point place of the joint in the reference [m]
  MarkerPair(const Anchor& first, const Anchor& second, const Vec3& point);
  MarkerPair(const model::NodeTable& nodes, int first, int second, const Vec3& point)
      : MarkerPair(Anchor(nodes, first), Anchor(nodes, second), point) {}

  /// Those of the first anchor, then those of the second.
  const std::vector<int>& nodes() const { return nodes_; }
  /// p_1 - p_2 of the joint's point; p_2 - p_1 is its negative.
  model::SlotSum gap() const;
  /// Attached copy of a spatial vector on anchor 0 or 1 of the pair.
  model::SlotSum vector(int anchor, const Vec3& v) const;
  const Eigen::Matrix3Xd& reference() const { return q_; }
  /// Anchor::across() of the first: from where angles between the two are counted, so that they are
  /// the same in each pose also where no joint keeps the axis of one along that of the other.
  Vec3 across(const Vec3& axis) const { return anchors_[0].across(axis); }

  /// A constraint of the two anchors without rows; it keeps the momenta of the model.
  model::Constraint joint() const;
  /// Adds p_1 = p_2: three rows.
  void add_point_rows(model::Constraint& joint) const;
  /// Adds that `axis` of both anchors stays parallel: two rows.
  void add_parallel_rows(const Vec3& axis, model::Constraint& joint) const;
  /// Adds that p_2 - p_1 stays on `axis` of the first anchor: two rows.
  void add_line_rows(const Vec3& axis, model::Constraint& joint) const;
  /// Adds u_1(a) . u_2(b) = a . b: one row.
  void add_angle_row(const Vec3& a, const Vec3& b, model::Constraint& joint) const;

 private:
  /// A sum of slots of one anchor as one of the pair.
  model::SlotSum widened(int anchor, const model::SlotSum& sum, double factor) const;

  std::array<Anchor, 2> anchors_;
  std::vector<int> nodes_;
  Vec3 point_;
  Eigen::Matrix3Xd q_;
};

/// Adds a joint type with parameters "First", "Second" and "Position".
void register_pair_joint(model::BuilderRegistry& registry, const std::string& type,
                         const std::string& doc, model::Constraint (*make)(const MarkerPair& pair));
/// Adds a joint type that has an "Axis" as well, given to `make` as a unit vector.
void register_axis_joint(model::BuilderRegistry& registry, const std::string& type,
                         const std::string& doc,
                         model::Constraint (*make)(const MarkerPair& pair, const Vec3& axis));

/// Parameters "First", "Second" and "Position".
Schema pair_schema(const std::string& type, const std::string& doc);
/// Adds a direction of any length but zero.
void add_direction(const std::string& name, const std::string& doc, Schema& schema);
/// Nodes that "First" and "Second" name, where points between nodes are not allowed; nothing, and
/// issues, if the deck names no pair.
std::optional<std::array<int, 2>> select_two_nodes(const Options& options,
                                                   model::BuildContext& context);
/// Adds the constraint that `make` returns for the pair of the deck; nothing, and issues, if the
/// deck names no pair.
void add_joint(const std::string& type, const Options& options, model::BuildContext& context,
               const std::function<model::Constraint(const MarkerPair& pair)>& make);

}  // namespace culm::joint
