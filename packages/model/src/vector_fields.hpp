/// The types of fields, one source each.
#pragma once

#include <culm/model/vector_field.hpp>

namespace culm::model {

void register_uniform_field(FieldRegistry& registry);
void register_formula_field(FieldRegistry& registry);
void register_grid_field(FieldRegistry& registry);

}  // namespace culm::model
