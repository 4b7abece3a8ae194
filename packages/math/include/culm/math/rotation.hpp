/// Rotations and triads. A triad is a 3x3 matrix whose columns are the directors d1, d2, d3.
#pragma once

#include <culm/math/types.hpp>

namespace culm {

/// sin t / t and (1 - cos t) / t^2.
struct RotationFactors {
  double sine;
  double cosine;
};
/// @param t2  t^2
RotationFactors rotation_factors(double t2);

/// Rotation about the vector theta [rad] by its length (Rodrigues), accurate for any length.
Mat3 exp_rotation(const Vec3& theta);

/// Rotation vector of R, length in [0, pi]. Inverse of exp_rotation.
Vec3 log_rotation(const Mat3& R);

/// One Newton step of the polar decomposition, D <- D (3 - D^T D) / 2: removes the round-off that
/// repeated multiplicative updates leave in a triad; error squared by each call.
Mat3 polar_correction(const Mat3& D);

/// Nearest rotation to D in the Frobenius norm (polar decomposition by SVD).
Mat3 nearest_rotation(const Mat3& D);

/// How far D is from a right-handed orthonormal triad: max |D^T D - 1|, or 2 if det D < 0.
double triad_defect(const Mat3& D);

/// Right-handed triad with d3 along `axis` and d1 as near to `up` as that allows.
/// @pre `up` is not parallel to `axis`; both nonzero
Mat3 triad_along(const Vec3& axis, const Vec3& up);

/// A unit vector normal to n: the coordinate axis least aligned with n, made normal to it.
Vec3 any_normal(const Vec3& n);

/// Rotation vector between triads through the mean of their directors (Cayley map):
/// tau = Ac^-1 sum_i d_i,mid x (d_i,next - d_i,prev), |tau| = 2 tan(angle / 2).
/// @source formulation 2.4, eq. (2.3)
Vec3 cayley_vector(const Mat3& prev, const Mat3& next);

}  // namespace culm
