/// Contacts that begin inside each other.
#pragma once

#include <culm/model/model.hpp>

#include <string>
#include <vector>

namespace culm::simulation {

/// A sentence for each contact whose structure lies too deep in what it should touch.
std::vector<std::string> deep_contacts(const model::Model& model, const model::Coordinates& q);

}  // namespace culm::simulation
