/// What the types of supports share: rows, and reading the deck.
#pragma once

#include <culm/joint/anchor.hpp>
#include <culm/joint/prescribed.hpp>
#include <culm/model/build_context.hpp>

#include <functional>
#include <optional>
#include <string>

namespace culm::joint {

/// A constraint of one point without rows.
model::Constraint support_of(const Anchor& anchor);

/// Adds sum_s alpha_s (q_s - q_s,0) = 0: three linear rows.
void add_vector_rows(const model::SlotSum& alpha, const Anchor& anchor,
                     model::Constraint& constraint);

/// Adds that the body axis which is `axis` in the reference stays there: u(axis) . e = 0 for two
/// directions e normal to it.
void add_axis_rows(const Vec3& axis, const Anchor& anchor, model::Constraint& constraint);

/// Makes the first row h(q) - u(t).
void drive_constant(const Prescribed& motion, model::Constraint& constraint);
/// Makes the first three rows h(q) - u(t).
void drive_constants(const Translation& motion, model::Constraint& constraint);

/// 0, 1 or 2 when n is a coordinate axis, in either sense. Supports along such an axis take away
/// unknowns of the node, which are components in space.
std::optional<std::size_t> coordinate_axis(const Vec3& n);

/// Whether a point is a node: only then supports can take away unknowns.
bool is_node(const Anchor& anchor, const Vec3& offset);

/// The two rotations that a fixed axis excludes: increments of rotations are vectors in space.
std::bitset<6> rotations_across(std::size_t axis);

/// Which nodes a type of support can hold.
enum class Holds {
  triads,  ///< those of beams and bodies
  all,     ///< those of shells as well
};

/// Adds the constraint that `make` returns for each node of parameter "Node", or for the point of a
/// beam that it names; an issue names a node of a shell that the type cannot hold.
void add_per_anchor(const std::string& type, const Options& options, model::BuildContext& context,
                    Holds holds,
                    const std::function<model::Constraint(const Anchor& anchor)>& make);

/// Parameter "Node" of supports.
Field anchor_field();
/// A schema with parameter "Node" and a direction of any length but zero.
Schema directed_schema(const std::string& type, const std::string& doc,
                       const std::string& direction, const std::string& direction_doc,
                       Field node = anchor_field());
/// A direction of unit length.
Vec3 read_direction(const Options& options, const std::string& parameter);

/// Parameter "Offset" of the point of a node that is held.
Field offset_field();

/// Adds the amount of a prescribed motion and its "Function".
void add_motion(const std::string& amount, const std::string& unit, const std::string& doc,
                Schema& schema);
/// Adds "Translation" in three components and its "Function".
void add_translation(Schema& schema);
/// As read_motion, below.
std::optional<Translation> read_translation(const Options& options, model::BuildContext& context);
/// Nothing, and an issue, if there is no such function or it is not one of time.
std::optional<Prescribed> read_motion(const Options& options, const std::string& amount,
                                      model::BuildContext& context,
                                      const std::string& function = "Function",
                                      model::Follows follows = model::Follows::functions);

}  // namespace culm::joint
