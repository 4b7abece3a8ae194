/// What contacts cannot do as their deck asks.
#pragma once

#include <culm/model/model.hpp>

#include <string>
#include <vector>

namespace culm::simulation {

bool has_contacts(const model::Model& model);
/// A sentence for each contact whose structure lies too deep in what it should touch.
std::vector<std::string> deep_contacts(const model::Model& model, const model::Coordinates& q);
/// A sentence for each contact that overlooks something for want of points.
std::vector<std::string> coarse_contacts(const model::Model& model, const model::Coordinates& q);
/// A sentence for each contact of which an analysis without time leaves something out.
std::vector<std::string> contacts_at_rest(const model::Model& model);

}  // namespace culm::simulation
