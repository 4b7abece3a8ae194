#pragma once

#include <culm/model/build_context.hpp>

namespace culm::joint {

/// Rigid Connection: nodes follow another one rigidly, by elimination. @see Model::add_rigid_link
/// @source formulation 2.2, 6.4 "rigidconnection"
void register_rigid_connection(model::BuilderRegistry& registry);

}  // namespace culm::joint
