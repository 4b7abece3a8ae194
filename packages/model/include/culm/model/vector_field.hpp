/// Vectors that vary in space and time.
#pragma once

#include <culm/base/registry.hpp>
#include <culm/math/types.hpp>

#include <memory>

namespace culm::model {

/// A vector at each place [m] and time [s]: a wind, a current, a force.
class VectorField {
 public:
  virtual ~VectorField() = default;
  /// May throw InputError where it is not finite.
  virtual Vec3 value(const Vec3& place, double time) const = 0;
  /// Whether it is another one at another time.
  virtual bool varies_in_time() const { return true; }
  /// Column j is the derivative by coordinate j of the place.
  virtual Mat3 gradient(const Vec3& place, double time) const = 0;
};

/// Shared by all that ask for it.
using SharedField = std::shared_ptr<const VectorField>;
using FieldRegistry = Registry<SharedField>;

/// All types of the deck's list "Fields": Uniform, Formula, Grid.
void register_vector_fields(FieldRegistry& registry);

}  // namespace culm::model
