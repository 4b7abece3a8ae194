/// Connections between nodes of shells, and from them to nodes with a triad.
#pragma once

#include <culm/model/build_context.hpp>

namespace culm::joint {

/// Directors with a smaller sine of the angle between them count as parallel: the row of the angle
/// has no derivative by their relative rotation where they are. @source formulation 2.5
constexpr double parallel_directors = 0.05;

/// x_A - x_B: three linear rows, between nodes of any kind.
model::Constraint hinge_connection(const model::NodeTable& nodes, int first, int second);
/// x_A - x_B and the angle phi between the directors, (d_A - b d_B) . (d_B - b d_A) with
/// b = tan(pi/4 - phi/2): four rows. The pair in brackets is orthogonal, and directors that change
/// their lengths alike keep the angle. Between parallel directors x_A - x_B and d_A -+ d_B: six
/// linear rows.
/// @param inextensible  holds both lengths as well, 1/2 d . d: two more rows
model::Constraint fold_connection(const model::NodeTable& nodes, int first, int second,
                                  bool inextensible = false);
/// x_A + t_A/2 d_A - (x_B - t_B/2 d_B): three linear rows; the first shell lies below.
model::Constraint layer_connection(const model::NodeTable& nodes, int first, int second,
                                   double first_thickness, double second_thickness);
/// 1/2 d . d: one row.
model::Constraint inextensible_director(const model::NodeTable& nodes, int node);
/// n . d: one row, by elimination along coordinate axes. Held along an edge it keeps the wall from
/// turning in the plane of edge and thickness ("hard" simple support).
/// @param direction  of unit length
model::Constraint director_support(const model::NodeTable& nodes, int node, const Vec3& direction);
/// Lets the shell node move along its director and stretch, not slide across it nor tilt:
/// u(tau_k) . (x_s - x_m) and u(tau_k) . d_s with two vectors tau_k fixed to the master, normal to
/// d_s in the reference: four rows. @source formulation 2.6
model::Constraint soft_transition(const model::NodeTable& nodes, int shell_node, int master);

/// Smooth, Fold, Hinge and Layer Connection, Inextensible Director, Director Support, Soft
/// Transition.
void register_shell_connections(model::BuilderRegistry& registry);

}  // namespace culm::joint
