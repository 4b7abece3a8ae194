#include "vector_fields.hpp"

namespace culm::model {

void register_vector_fields(FieldRegistry& registry) {
  register_uniform_field(registry);
  register_formula_field(registry);
  register_grid_field(registry);
}

}  // namespace culm::model
