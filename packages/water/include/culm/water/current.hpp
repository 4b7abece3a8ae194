/// Steady currents.
#pragma once

#include <culm/base/schema.hpp>
#include <culm/math/types.hpp>

#include <vector>

namespace culm::water {

/// A horizontal velocity that depends on the depth alone.
class Current {
 public:
  /// None.
  Current() = default;
  /// The same at all depths, or by (1 + z / depth)^exponent.
  Current(Vec3 velocity, double exponent, double depth);
  /// By a table, linear in between and held outside. @param depths  below still water, rising [m]
  Current(Vec3 direction, std::vector<double> depths, std::vector<double> speeds);

  /// @param z  height over still water; above it as at it [m]
  Vec3 at(double z) const;

 private:
  Vec3 velocity_ = Vec3::Zero();  // at the surface, or the direction of a table
  double exponent_ = 0.0, depth_ = 1.0;
  std::vector<double> depths_, speeds_;
};

/// Types of the list "Current": Uniform, Power Law, Table.
Variants current_types();
/// @param direction  of the waves, which holds where the current has none of its own
/// @param up         unit vector
Current read_current(const Options& options, const Vec3& direction, const Vec3& up, double depth);

}  // namespace culm::water
