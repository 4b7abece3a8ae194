/// The types of loads, one source each.
#pragma once

#include <culm/model/build_context.hpp>

namespace culm::load {

void register_force(model::BuilderRegistry& registry);          // Force, Follower Force
void register_moment(model::BuilderRegistry& registry);         // Moment, Follower Moment
void register_line_force(model::BuilderRegistry& registry);     // Line Force, Follower Line Force
void register_line_moment(model::BuilderRegistry& registry);    // Line Moment, Follower Line Moment
void register_line_load(model::BuilderRegistry& registry);      // Line Load, Follower Line Load
void register_field_force(model::BuilderRegistry& registry);    // Field Force
void register_pressure(model::BuilderRegistry& registry);       // Pressure
void register_surface_force(model::BuilderRegistry& registry);  // Surface Force
void register_director_force(model::BuilderRegistry& registry);  // Director Force
void register_gravity(model::BuilderRegistry& registry);         // Gravity
void register_external(model::BuilderRegistry& registry);        // External

void register_rotating_frame(model::BuilderRegistry& registry);  // Rotating Frame
void register_catenary(model::BuilderRegistry& registry);        // Catenary

// … Spring and … Damper, all of them
void register_spring(model::BuilderRegistry& registry);
void register_directed_spring(model::BuilderRegistry& registry);
void register_ground_spring(model::BuilderRegistry& registry);
void register_directed_ground_spring(model::BuilderRegistry& registry);
void register_plane_ground_spring(model::BuilderRegistry& registry);
void register_torsion(model::BuilderRegistry& registry);          // and Torsion Drive
void register_rotation_damper(model::BuilderRegistry& registry);  // and Rotation Damper Local

}  // namespace culm::load
